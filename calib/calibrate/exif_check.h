// SPDX-License-Identifier: AGPL-3.0-or-later
//
// EXIF of a whole calibration: whether the photographs agree, and whether the answer does.

#ifndef TILTCAL_EXIF_CHECK_H
#define TILTCAL_EXIF_CHECK_H

#include <tiltcal/calibration.h>
#include <tiltcal/log.h>
#include "picture/exif.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// What all photographs that say anything of it say alike; the rest is left out.
/// The pitch counts only when every photograph has it. Orientation 1 unless all agree.
PhotographFacts CommonFacts(const std::vector<PhotographFacts>& all);
PhotographFacts CommonFacts(const Task& task);

/// What the photographs of the reference stop, those that say any, say alike.
std::optional<double> FNumberOfReference(const Task& task);

/// Pitch from EXIF, mm, logged; 0.2 % is the most by which photographs may differ. Throws UsageError
/// that asks for the pitch when they do not say it; FileError.
double PitchFromExif(const std::vector<std::string>& files, const Log& log);

/// Logs the facts; warns when photographs of the task disagree, and of orientations that are not applied.
void LogFacts(const Task& task, const Log& log);

/// A sentence for each of f and f-number that lies far from EXIF's, with which to believe and why; usually none.
std::vector<std::string> CompareWithExif(const Calibration& calibration);

/// For calibration.json: the common facts; null when there are none.
nlohmann::ordered_json ExifJson(const Task& task);

/// What EXIF says of focal length and f-number as weak priors, 10 % each (engraved values are rounded, and lenses that
/// focus by moving groups shorten their f at close range): they decide where photographs leave it open, and nothing else.
/// None for a quantity that `given` has.
std::vector<Prior> PriorsFromExif(const Task& task, const std::vector<Prior>& given);

}

#endif
