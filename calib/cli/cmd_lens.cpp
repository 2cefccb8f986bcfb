// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/file_set.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/plain_text.h"
#include "model/state_names.h"
#include "prescription/glass_camera.h"
#include "program/progress.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

namespace tiltcal
{

namespace
{

const double MOST_TILT = 60;   // degrees
const int MOST_PIXELS = 1000000;

struct Options
{
	std::string prescription, size = "1800x1200", focus = "infinity", out;
	std::optional<double> focal_length, scale, f_number, back;
	double pitch = 0.02, pivot = 0;
	int terms = tilt_lens::AberrationTerms;
	std::vector<std::string> states;
};

double Positive(const std::string& option, double value)
{
	if (!(value > 0) || !std::isfinite(value))
		throw UsageError(fmt::format("{} {:g}: give a number above 0", option, value));
	return value;
}

/// A distance in mm before the entrance pupil, or `infinity`.
double ParseFocus(const std::string& option, const std::string& text)
{
	if (text == "infinity" || text == "inf")
		return INFINITY;
	const std::optional<double> value = FiniteNumber(text);
	if (!value || !(*value > 0))
		throw UsageError(fmt::format("{} {}: give a distance in mm above 0, or infinity", option, OneLine(text)));
	return *value;
}

Sensor ParseSensor(const Options& o)
{
	const size_t x = o.size.find('x');
	const std::optional<double> width = FiniteNumber(o.size.substr(0, x)), height = FiniteNumber(x == std::string::npos ? "" : o.size.substr(x + 1));
	const auto is_count = [](const std::optional<double>& n) { return n && *n >= 2 && *n <= MOST_PIXELS && *n == std::floor(*n); };
	if (!is_count(width) || !is_count(height))
		throw UsageError(fmt::format("--size {}: give WIDTHxHEIGHT in pixels, such as 1800x1200", OneLine(o.size)));
	return { int(*width), int(*height), Positive("--pitch", o.pitch) };
}

/// The glass at its size and opening.
Prescription TakeGlass(const Options& o)
{
	if (o.focal_length && o.scale)
		throw UsageError("--focal-length and --scale both say how large the lens is: give one of them");
	Prescription glass = ReadPrescription(o.prescription);
	double scale = o.scale ? Positive("--scale", *o.scale) : 1;
	if (o.focal_length)
		scale = Positive("--focal-length", *o.focal_length) / std::abs(ParaxialOf(glass).focal_length);
	glass = glass.Scaled(scale);
	if (ParaxialOf(glass).focal_length < 0)
		throw Refused(fmt::format("{}: its focal length is below 0: a diverging lens draws no picture", o.prescription));
	return o.f_number ? StoppedTo(glass, Positive("--f-number", *o.f_number)) : glass;
}

/// NAME[:key=value,...]
GlassState ParseState(const Options& o, const Prescription& glass, const std::string& text)
{
	const size_t colon = text.find(':');
	GlassState state;
	state.name = WithUnderscores(text.substr(0, colon));
	CheckStateName(state.name);
	double back = o.back ? *o.back : 0;      // 0: by the focus
	double focus = ParseFocus("--focus", o.focus);
	std::string by;                          // what says it for this state
	for (size_t at = colon; at < text.size();)
	{
		const size_t end = std::min(text.find(',', at + 1), text.size()), equals = text.find('=', at);
		const std::string key = text.substr(at + 1, std::min(equals, end) - at - 1), value = equals < end ? text.substr(equals + 1, end - equals - 1) : "";
		const std::optional<double> number = FiniteNumber(value);
		at = end;
		if ((key == "focus" && by == "back") || (key == "back" && by == "focus"))
			throw UsageError(fmt::format("--state {}: focus and back both say where the sensor is: give one of them", OneLine(text)));
		by = key == "focus" || key == "back" ? key : by;
		if (key == "focus")
		{
			focus = ParseFocus("--state " + state.name + ": focus", value);
			back = 0;
		}
		else if (key != "tilt" && key != "direction" && key != "back")
			throw UsageError(fmt::format("--state {}: '{}' is unknown; give NAME:tilt=5,direction=0,focus=618 or back=35.7 in place of focus", OneLine(text), OneLine(key)));
		else if (!number)
			throw UsageError(fmt::format("--state {}: {} needs a number, such as {}=5", OneLine(text), key, key));
		else if (key == "back")
			back = Positive("--state " + state.name + ": back", *number);
		else
			(key == "tilt" ? state.tilt_deg : state.direction_deg) = *number;
	}
	if (!(std::abs(state.tilt_deg) <= MOST_TILT))
		throw UsageError(fmt::format("--state {}: a tilt of {:g} degrees is beyond {:g}", OneLine(text), state.tilt_deg, MOST_TILT));
	state.pivot = glass.StopHeight() + o.pivot;
	state.back_distance = back > 0 ? back : FocusedBackDistance(glass, ParaxialOf(glass), focus);
	return state;
}

GlassTask MakeTask(const Options& o)
{
	if (o.terms != tilt_lens::ThirdOrderTerms && o.terms != tilt_lens::AberrationTerms)
		throw UsageError(fmt::format("--terms {}: there are 6 (third order) and 16 (with the fifth)", o.terms));
	if (o.back)
		Positive("--back", *o.back);
	GlassTask task;
	task.sensor = ParseSensor(o);
	task.glass = TakeGlass(o);
	task.terms = o.terms;
	std::vector<std::string> names;
	for (const std::string& text : o.states.empty() ? std::vector<std::string>{ "untilted" } : o.states)
	{
		task.states.push_back(ParseState(o, task.glass, text));
		names.push_back(task.states.back().name);
	}
	CheckStateNames(names);
	return task;
}

std::string CameraFile(const std::string& folder, const std::string& state) { return Join(folder, "camera-" + state + ".inc"); }

/// A calibration's cameras are left alone, and those of an earlier run named.
void CheckFolder(const std::string& folder, const GlassTask& task)
{
	namespace fs = std::filesystem;
	std::error_code none;
	if (fs::exists(Join(folder, "calibration.json"), none))
		throw UsageError(fmt::format("--out {}: holds a calibration, whose cameras have such names; give another folder", folder));
	for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
	{
		const std::string file = entry.path().filename().string();
		const bool mine = std::any_of(task.states.begin(), task.states.end(), [&](const GlassState& state) { return BaseName(CameraFile(folder, state.name)) == file; });
		if (!mine && file.rfind("camera-", 0) == 0 && entry.path().extension() == ".inc")
			spdlog::warn("{}: not of this run; remove it, or it will be taken for this lens's", OneLine(entry.path().string()));
	}
}

void Run(const Options& o)
{
	const GlassTask task = MakeTask(o);
	if (!o.out.empty())
	{
		PrepareFolder(o.out);
		CheckFolder(o.out, task);
	}
	auto progress = std::make_unique<Progress>("tracing the glass, fitting the camera");
	const GlassCameras made = MakeGlassCameras(task);
	progress.reset();
	const std::string report = GlassReport(made);
	fmt::print("{}", report);
	if (o.out.empty())
		return;
	FileSet set;
	set.Text(Join(o.out, "lens.txt"), report);
	for (size_t s = 0; s < task.states.size(); ++s)
		set.Text(CameraFile(o.out, task.states[s].name), GlassInc(made, s));
	set.Commit();
	fmt::print("written to {}\n", o.out);
}

}

void AddLens(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("lens", "A camera from a lens prescription, as patents print them, without a photograph.");
	c->add_option("prescription", o->prescription, "FILE: a line a surface, front to rear: radius, distance to the next, index n_d, clear diameter, mm; the stop is a row of its own")->required();
	c->add_option("--focal-length", o->focal_length, "Scales the whole table to this focal length, mm; left out: as printed");
	c->add_option("--scale", o->scale, "Scales the whole table by this factor, instead");
	c->add_option("--f-number", o->f_number, "Closes the stop to this f-number; left out: the table's own stop");
	CLI::Option* focus = c->add_option("--focus", o->focus, "What is sharpest on the axis, mm before the entrance pupil, or infinity")->capture_default_str();
	c->add_option("--back", o->back, "From the last surface to the sensor, untilted, mm, instead of --focus")->excludes(focus);
	c->add_option("--size", o->size, "WIDTHxHEIGHT of the picture, px")->capture_default_str();
	c->add_option("--pitch", o->pitch, "Side of a pixel on the sensor, mm")->capture_default_str();
	c->add_option("--pivot", o->pivot, "Where on its axis the lens tilts, mm from the stop towards the scene")->capture_default_str();
	c->add_option("--state", o->states, "NAME[:tilt=DEGREES,direction=DEGREES,focus=MM,back=MM]: how the lens stands; may be repeated; left out: untilted");
	c->add_option("--terms", o->terms, "6: third-order aberrations, 16: the fifth order too")->capture_default_str();
	c->add_option("--out", o->out, "Folder for camera-STATE.inc and lens.txt; left out: the report alone");
	c->footer("Example:\n  tiltcal lens double-gauss.txt --focal-length 45 --f-number 2.8 --focus 618 --state untilted --state plus5:tilt=5 --out lens\n\n"
		"Rays are traced through the glass from pixels all over the picture; the camera's aberrations, opening and rims are\n"
		"fitted to them, for all states together. The report says how far the camera's rays are from the glass's. Tilts and\n"
		"directions are as everywhere: the plane of focus recedes towards the direction, 0 up, 90 right.\n"
		"The .inc declares the macros TiltCal_STATE(Location, Look_At, Sky) and TiltCal_STATE_Body, as tiltcal calibrate's do.\n"
		"Spheres and planes only; one wavelength (the d line).\n"
		"Exit codes: 0 done, 1 refused (no focus, no ray comes through), 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
