// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_NEXT_JSON_H
#define TILTCAL_NEXT_JSON_H

#include "report/json_parts.h"

namespace tiltcal
{

/// `next_photographs` of calibration.json.
Json NextPhotographsJson(const Calibration& calibration);

}

#endif
