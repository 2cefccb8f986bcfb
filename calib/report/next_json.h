// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_NEXT_JSON_H
#define TILTCAL_NEXT_JSON_H

#include <tiltcal/calibration.h>

#include <nlohmann/json.hpp>

namespace tiltcal
{

/// `next_photographs` of calibration.json.
nlohmann::ordered_json NextPhotographsJson(const Calibration& calibration);

}

#endif
