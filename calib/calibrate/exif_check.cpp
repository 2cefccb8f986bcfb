// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/exif_check.h"

#include "model/told_state.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tiltcal
{

namespace
{

/// Engraved focal lengths are rounded by some per cent and marked f-numbers stand thirds of a stop
/// (12 %) apart. Beyond these the numbers speak of different things.
const double FAR_FOCAL_LENGTH = 0.06, FAR_F_NUMBER = 0.2;

const double SAME_PITCH = 0.002;

std::vector<PhotographFacts> FactsOf(const Task& task)
{
	std::vector<PhotographFacts> all;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			all.push_back(photo.facts);
	return all;
}

bool Same(double a, double b) { return std::abs(a - b) <= 1e-6 * std::abs(a); }
bool Same(const std::string& a, const std::string& b) { return a == b; }

bool IsSaid(const std::optional<double>& value) { return value.has_value(); }
bool IsSaid(const std::string& value) { return !value.empty(); }
double Value(const std::optional<double>& value) { return *value; }
const std::string& Value(const std::string& value) { return value; }

/// The field where all that say it agree, else empty.
template<typename Field>
Field Common(const std::vector<PhotographFacts>& all, Field PhotographFacts::* field)
{
	Field common{};
	for (const PhotographFacts& facts : all)
	{
		if (!IsSaid(facts.*field))
			continue;
		if (IsSaid(common) && !Same(Value(common), Value(facts.*field)))
			return {};
		common = facts.*field;
	}
	return common;
}

std::optional<double> CommonPitch(const std::vector<PhotographFacts>& all)
{
	for (const PhotographFacts& facts : all)
		if (!facts.pitch_mm || std::abs(*facts.pitch_mm / *all[0].pitch_mm - 1) > SAME_PITCH)
			return {};
	return all.empty() ? std::nullopt : all[0].pitch_mm;
}

/// Warns when `say` (empty: nothing said) differs between photographs, with an example of each.
template<typename Say>
void WarnOfDifference(const Task& task, const Log& log, const char* what, const char* consequence, const Say& say)
{
	std::map<std::string, std::string> first;   // what is said: by which file
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			if (const std::string said = say(photo.facts); !said.empty())
				first.emplace(said, photo.file);
	if (first.size() < 2)
		return;
	std::string list;
	for (const auto& [said, file] : first)
		list += fmt::format("{}{} ({})", list.empty() ? "" : ", ", said, file);
	log.Warn(fmt::format("EXIF: the photographs have different {}: {}; {}", what, list, consequence));
}

std::string Number(const std::optional<double>& value, const char* unit) { return value ? fmt::format("{:.4g}{}", *value, unit) : ""; }

}

PhotographFacts CommonFacts(const std::vector<PhotographFacts>& all)
{
	PhotographFacts common;
	common.focal_length_mm = Common(all, &PhotographFacts::focal_length_mm);
	common.f_number = Common(all, &PhotographFacts::f_number);
	common.pitch_mm = CommonPitch(all);
	common.make = Common(all, &PhotographFacts::make);
	common.model = Common(all, &PhotographFacts::model);
	common.lens = Common(all, &PhotographFacts::lens);
	if (!all.empty() && std::all_of(all.begin(), all.end(), [&](const PhotographFacts& f) { return f.orientation == all[0].orientation; }))
		common.orientation = all[0].orientation;
	return common;
}

PhotographFacts CommonFacts(const Task& task) { return CommonFacts(FactsOf(task)); }

std::optional<NominalFNumber> FNumberOfReference(const Task& task)
{
	std::vector<PhotographFacts> all;
	bool told = false, by_exif = false;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			if (photo.stop == 0)
			{
				all.push_back(photo.facts);
				told = told || photo.f_number;
				by_exif = by_exif || photo.facts.f_number;
				if (photo.f_number)
					all.back().f_number = photo.f_number;
			}
	const std::optional<double> value = CommonFacts(all).f_number;
	return value ? std::optional<NominalFNumber>({ *value, told, by_exif }) : std::nullopt;
}

double PitchFromExif(const std::vector<std::string>& files, const Log& log)
{
	std::vector<PhotographFacts> all;
	for (const std::string& file : files)
	{
		all.push_back(ReadFacts(file));
		if (!all.back().pitch_mm)
			throw UsageError(fmt::format("`pitch` is required: {} does not say it (EXIF FocalPlaneXResolution, in a picture neither scaled nor cropped, that FocalLengthIn35mmFilm does not contradict); "
				"give the distance of pixel centres on the sensor in mm, such as 0.00655", file));
	}
	const std::optional<double> pitch = CommonPitch(all);
	if (!pitch)
		throw UsageError("`pitch` is required: the photographs' EXIF (FocalPlaneXResolution) differs; give the distance of pixel centres on the sensor in mm");
	log.Info(fmt::format("pitch {:.6f} mm from EXIF (FocalPlaneXResolution)", *pitch));
	return *pitch;
}

void LogFacts(const Task& task, const Log& log)
{
	const PhotographFacts common = CommonFacts(task);
	if (const std::string text = Describe(common); !text.empty())
		log.Info("EXIF: " + text);
	WarnOfDifference(task, log, "cameras", "a calibration is of one sensor", [](const PhotographFacts& f) { return f.model.empty() ? "" : f.make + " " + f.model; });
	WarnOfDifference(task, log, "lenses", "a calibration is of one lens", [](const PhotographFacts& f) { return f.lens; });
	WarnOfDifference(task, log, "focal lengths", "a calibration is of one setting of zoom and focus", [](const PhotographFacts& f) { return Number(f.focal_length_mm, " mm"); });
	if (task.stops.empty())
		WarnOfDifference(task, log, "f-numbers", "the aperture is taken to be one for all of them", [](const PhotographFacts& f) { return Number(f.f_number, ""); });
	bool turned = false;
	for (const PhotographFacts& facts : FactsOf(task))
		turned = turned || facts.orientation != 1;
	if (turned)
		log.Info("EXIF orientation is not applied: a calibration is in sensor coordinates, so viewers show these photographs turned against it");
	WarnOfDifference(task, log, "orientations", "this is not applied, but was the camera turned between them, and the board not?",
		[](const PhotographFacts& f) { return fmt::format("{}", f.orientation); });
}

void WarnOfOtherSetting(const Task& task, const std::string& flat_field, const PhotographFacts& facts, const Log& log)
{
	const PhotographFacts common = CommonFacts(task);
	const std::optional<NominalFNumber> nominal = FNumberOfReference(task);
	const auto warn = [&](const std::string& what) { log.Warn(fmt::format("`flat_field` {}: EXIF says {}: vignetting is of one setting; photograph it at that of the board's", flat_field, what)); };
	if (facts.f_number && nominal && !IsSameFNumber(*facts.f_number, nominal->value))
		warn(fmt::format("f/{:.3g}, the photographs{} are of f/{:.3g}", *facts.f_number, task.stops.empty() ? "" : " at the widest stop", nominal->value));
	if (facts.focal_length_mm && common.focal_length_mm && !Same(*facts.focal_length_mm, *common.focal_length_mm))
		warn(fmt::format("{:g} mm, the photographs {:g} mm", *facts.focal_length_mm, *common.focal_length_mm));
	if (!facts.model.empty() && !common.model.empty() && facts.model != common.model)
		warn(fmt::format("{}, the photographs {}", facts.model, common.model));
}

std::vector<std::string> CompareWithExif(const Calibration& c)
{
	std::vector<std::string> words;
	const PhotographFacts facts = CommonFacts(c.task);
	const Estimate &focal_length = c.RealLensIsUsed() ? c.real_lens->focal_length_mm : c.solution.focal_length, &aperture = c.RealLensIsUsed() ? c.real_lens->aperture_diameter_mm : c.solution.aperture_diameter;
	const double f = focal_length.value, d = aperture.value;
	if (c.task.pitch_from_exif)
		words.push_back(fmt::format("the pixel pitch, {:.6f} mm, is EXIF's (FocalPlaneXResolution), as of a sensor of {:.1f} x {:.1f} mm: makers round it by some per cent, and some write that of another sensor. "
			"All lengths of the lens are proportional to it, and their sigmas do not hold that: compare with the data sheet's sensor, and give `pitch`", c.task.pitch_mm, c.task.width * c.task.pitch_mm, c.task.height * c.task.pitch_mm));
	if (facts.focal_length_mm && f > 0 && std::abs(f / *facts.focal_length_mm - 1) > FAR_FOCAL_LENGTH + 3 * focal_length.sigma / f)
		words.push_back(fmt::format("focal length f {:.2f} +- {:.2f} mm, EXIF {:g} mm (engraved, rounded, for infinity; to compare with f, not with the image distance w {:.2f} mm). "
			"Believe f if `pitch` is right and the photographs were not scaled, for f is proportional to the pitch; many lenses also shorten f when focused near. Else EXIF may be of another lens",
			f, focal_length.sigma, *facts.focal_length_mm, c.solution.w_mm.value));
	if (const std::optional<NominalFNumber> nominal = FNumberOfReference(c.task); nominal && f > 0 && d > 0)
	{
		const double number = f / d, relative = std::hypot(focal_length.sigma / f, aperture.sigma / d);
		if (std::abs(std::log(number / nominal->value)) > FAR_F_NUMBER + 3 * relative)
			words.push_back(fmt::format("f-number f/d {:.2f} +- {:.2f}, {} {:.3g} (the marked stop, rounded). Believe d {:.2f} mm for rendering: it is what blurred these photographs; "
				"but a wrong `transfer`, `pitch` or `square` shows here too{}", number, number * relative, nominal->told ? "told" : "EXIF", nominal->value, d,
				nominal->told ? "" : ", and a lens with its own aperture ring writes no f-number that is true"));
	}
	return words;
}

nlohmann::ordered_json ExifJson(const Task& task)
{
	const PhotographFacts facts = CommonFacts(task);
	nlohmann::ordered_json json;
	if (facts.focal_length_mm)
		json["focal_length_mm"] = *facts.focal_length_mm;
	if (facts.f_number)
		json["f_number"] = *facts.f_number;
	if (facts.pitch_mm)
		json["pixel_pitch_mm"] = *facts.pitch_mm;
	if (!facts.make.empty())
		json["make"] = facts.make;
	if (!facts.model.empty())
		json["model"] = facts.model;
	if (!facts.lens.empty())
		json["lens"] = facts.lens;
	if (!json.is_null())
		json["orientation_not_applied"] = facts.orientation;
	return json;
}

std::vector<Prior> PriorsFromExif(const Task& task, const std::vector<Prior>& given)
{
	const PhotographFacts facts = CommonFacts(task);
	std::vector<Prior> priors;
	const auto add = [&](Quantity quantity, const std::optional<double>& value)
	{
		const bool known = std::any_of(given.begin(), given.end(), [&](const Prior& p) { return p.quantity == quantity; });
		if (value && *value > 0 && !known)
			priors.push_back({ quantity, *value, 0.1 * *value });
	};
	add(Quantity::FOCAL_LENGTH, facts.focal_length_mm);
	// What is told corrects EXIF; it alone is for telling stops apart (--prior says what is known).
	const std::optional<NominalFNumber> nominal = FNumberOfReference(task);
	add(Quantity::F_NUMBER, nominal && nominal->by_exif ? std::optional(nominal->value) : std::nullopt);
	return priors;
}

}
