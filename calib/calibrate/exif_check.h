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

struct NominalFNumber
{
	double value;
	bool told;      ///< with the photographs; else EXIF's
	bool by_exif;   ///< EXIF says one too, maybe another
};

/// At which the photographs of the reference stop were taken, as told or else as EXIF says; those that say any say it alike.
std::optional<NominalFNumber> FNumberOfReference(const Task& task);

/// Pitch from EXIF, mm, logged; 0.2 % is the most by which photographs may differ. Throws UsageError
/// that asks for the pitch when they do not say it; FileError.
double PitchFromExif(const std::vector<std::string>& files, const Log& log);

/// Logs the facts; warns when photographs of the task disagree, and of orientations that are not applied.
void LogFacts(const Task& task, const Log& log);

/// Warns where EXIF of a flat field is not of the photographs' camera, focal length or (widest) f-number.
void WarnOfOtherSetting(const Task& task, const std::string& flat_field, const PhotographFacts& facts, const Log& log);

/// A sentence where the pitch is EXIF's, and for each of f and f-number that lies far from what EXIF says or was told, with which to believe and why; usually none.
std::vector<std::string> CompareWithExif(const Calibration& calibration);

/// For calibration.json: the common facts; null when there are none.
nlohmann::ordered_json ExifJson(const Task& task);

/// What EXIF says of focal length and f-number (corrected by the one that was told with the photographs) as weak priors, 10 % each (engraved values are rounded, and lenses that
/// focus by moving groups shorten their f at close range): they decide where photographs leave it open, and nothing else.
/// None for a quantity that `given` has.
std::vector<Prior> PriorsFromExif(const Task& task, const std::vector<Prior>& given);

}

#endif
