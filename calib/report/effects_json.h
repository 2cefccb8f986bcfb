// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Effects and the real lens in calibration.json.

#ifndef TILTCAL_EFFECTS_JSON_H
#define TILTCAL_EFFECTS_JSON_H

#include "report/json_parts.h"

namespace tiltcal
{

/// "effects": which are in the camera, and why.
Json EffectsJson(const Calibration& calibration);

/// "vignetting", and "chromatic".
Json VignettingJson(const Calibration& calibration);
Json ChromaticJson(const Calibration& calibration);

/// "real_lens" or "scene_lens".
Json RealLensJson(const Calibration& calibration, const RealLens& lens);

}

#endif
