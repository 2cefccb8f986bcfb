// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "model/priors.h"
#include "model/state_names.h"
#include "program/program.h"
#include "program/spelling.h"
#include "calibrate/measure_all.h"
#include "model/names.h"
#include "picture/image_io.h"

#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>
#include "calibrate/exif_check.h"
#include "base/stopwatch.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/plain_text.h"
#include "effects/effects.h"
#include "effects/fixed_blades.h"
#include "report/write_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <spdlog/spdlog.h>

#include <chrono>
#include <ctime>
#include <memory>
#include <optional>
#include <utility>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string board, target = "checkerboard", transfer = "srgb", model = "auto", poses = "auto", refine = "edges", effects = "auto", square, out;
	double circle_diameter = 0;
	std::optional<double> pitch;
	std::vector<std::string> untilted, tilted, fix, prior, flat_field;
	bool any_orientation = false, untilted_free = false;
	int edges_per_photo = 0, threads = 0;
};

/// Six edges of each direction reach all quarters of the board (test_spread_order.cpp).
const int FEWEST_EDGES = 12;

const int MOST_THREADS = 1024;

/// --square VALUE or VALUE:SIGMA, mm.
Estimate ParseSquare(const std::string& text)
{
	const size_t colon = text.find(':');
	const std::optional<double> value = FiniteNumber(text.substr(0, colon)), sigma = colon == std::string::npos ? std::optional<double>(0) : FiniteNumber(text.substr(colon + 1));
	if (!value || !(*value > 0) || !sigma || *sigma < 0)
		throw UsageError(fmt::format("--square {}: give VALUE or VALUE:SIGMA in mm, above 0, such as 25 or 25:0.02", text));
	return { *value, *sigma };
}

/// The state's name and pattern of --tilted NAME='GLOB'.
std::pair<std::string, std::string> NameAndPattern(const std::string& option)
{
	const size_t equals = option.find('=');
	if (equals == std::string::npos)
		throw UsageError(fmt::format("--tilted {}: give NAME='GLOB', such as plus5='plus5-*.png'", option));
	const std::string given = option.substr(0, equals), name = WithUnderscores(given);
	if (name != given)
		spdlog::info("state {} is called {}, as POV-Ray's identifiers must be", OneLine(given), name);
	return { name, option.substr(equals + 1) };
}

std::vector<StateFiles> States(const Options& o)
{
	std::vector<StateFiles> states{ { "untilted", ExpandGlobs(o.untilted, "--untilted") } };
	std::vector<std::string> names{ "untilted" };
	for (const std::string& option : o.tilted)
	{
		const auto [name, pattern] = NameAndPattern(option);
		names.push_back(name);
		try
		{
			CheckStateNames(names);
		}
		catch (const Error& e)
		{
			throw UsageError(fmt::format("--tilted {}: {}", option, e.what()));
		}
		states.push_back({ name, ExpandGlobs({ pattern }, "--tilted " + name) });
	}
	return states;
}

struct FieldFile
{
	size_t state;
	std::string file;
};

/// --flat-field NAME=FILE, FILE a name or a pattern.
std::vector<FieldFile> FlatFields(const Options& o, const std::vector<StateFiles>& states)
{
	std::vector<FieldFile> fields;
	for (const std::string& option : o.flat_field)
	{
		const size_t equals = option.find('=');
		const std::string name = WithUnderscores(option.substr(0, equals));
		std::string names;
		size_t state = states.size();
		for (size_t s = 0; s < states.size(); ++s)
		{
			names += (s ? ", " : "") + states[s].name;
			state = states[s].name == name ? s : state;
		}
		if (equals == std::string::npos || state == states.size())
			throw UsageError(fmt::format("--flat-field {}: give NAME=FILE, NAME one of the states {}", option, names));
		for (const std::string& file : ExpandGlobs({ option.substr(equals + 1) }, "--flat-field " + name))
			fields.push_back({ state, file });
	}
	return fields;
}

std::vector<std::string> AllFiles(const std::vector<StateFiles>& states)
{
	std::vector<std::string> files;
	for (const StateFiles& s : states)
		files.insert(files.end(), s.files.begin(), s.files.end());
	return files;
}

/// None: to be chosen.
std::optional<Model> ParseModel(const std::string& text)
{
	const std::optional<Model> model = ModelNamed(text);
	std::string all;
	for (const ModelWords& words : MODELS)
		all += fmt::format("{}{} ({})", &words == &MODELS.back() ? " and " : ", ", words.name, words.meaning);
	if (!model && text != "auto")
		throw UsageError(fmt::format("--model {}: there is auto{}", text, all));
	return model;
}

/// The help of --model, from the models' own words.
std::string ModelHelp()
{
	std::string help = "auto: curved where photographs left out show field curvature, else plane; from there on lens, where aberrations are left over and photographs left out show them";
	for (const ModelWords& words : MODELS)
		help += fmt::format("; {}: {}", words.name, words.meaning);
	return help;
}

Poses ParsePoses(const std::string& text)
{
	if (text == "auto")
		return Poses::AUTO;
	if (text == "shared")
		return Poses::SHARED;
	if (text == "own")
		return Poses::OWN;
	throw UsageError(fmt::format("--poses {}: give auto, shared or own", text));
}

Refinement ParseRefinement(const std::string& text)
{
	if (text == "none")
		return Refinement::NONE;
	if (text == "edges")
		return Refinement::EDGES;
	if (text == "photometric")
		return Refinement::PHOTOMETRIC;
	throw UsageError(fmt::format("--refine {}: give none, edges or photometric", text));
}

/// A wrong --fix makes the photographs contradict themselves, which reads like a lack of photographs.
Calibration CalibrateWithPriors(const Task& task, bool priors_from_exif_alone, const CalibrateOptions& options)
{
	try
	{
		return Calibrate(task, options);
	}
	catch (const Error& e)
	{
		if (e.Code() != EXIT_REFUSED || task.priors.empty())
			throw;
		throw Refused(fmt::format("{}; or what {} is wrong: {}", e.what(), priors_from_exif_alone ? "the photographs' EXIF says of the lens" : "--fix or --prior says",
			priors_from_exif_alone ? "give --prior focal_length=.. and --prior f_number=.. yourself" : "try without"));
	}
}

/// The photographs as they were measured, for the overlays: 8 bit, packed as PNG, in the order of states and photographs.
class MeasuredPictures
{
public:
	explicit MeasuredPictures(size_t count) : packed(count) {}

	void Add(size_t number, const cv::Mat& grey)
	{
		cv::imencode(".png", ToDisplay(grey), packed[number], { cv::IMWRITE_PNG_COMPRESSION, 1 });
	}

	cv::Mat Get(const Task& task, size_t state, size_t photo) const
	{
		size_t n = photo;
		for (size_t s = 0; s < state; ++s)
			n += task.states[s].photos.size();
		return cv::imdecode(packed[n], cv::IMREAD_GRAYSCALE);
	}

private:
	std::vector<std::vector<uchar>> packed;
};

/// What is known beforehand, by --fix, --prior and EXIF.
struct Known
{
	std::vector<Prior> priors;
	FixedBlades blades;
};

Known WhatIsKnown(const Options& o)
{
	Known known;
	for (const std::string& text : o.fix)
		if (!TakeBlades(text, known.blades))
			known.priors.push_back(ParseFix(text));
	CheckBlades(known.blades);
	for (const std::string& text : o.prior)
		known.priors.push_back(ParsePrior(text));
	return known;
}

/// What the texts of a calibration call inputs, people know as options.
void SpellAsOptions(Calibration& c)
{
	const auto spell = [](std::string& text) { text = SpelledAsOptions(text); };
	for (Solution* s : { &c.solution, &c.render, &c.paper })
		spell(s->failure);
	if (c.compared)
		for (Solution* s : { &c.compared->rigid, &c.compared->plane, &c.compared->curved })
			spell(s->failure);
	spell(c.vignetting.failure);
	for (FalloffAnswer& answer : c.vignetting.answers)
		spell(answer.second.why);
	spell(c.chromatic.failure);
	for (Effect& e : c.effects)
		for (std::string* text : { &e.failure, &e.why, &e.note })
			spell(*text);
	for (Remark& remark : c.verdict.remarks)
		spell(remark.text);
}

void Run(const Options& o, const std::string& command_line)
{
	const Stopwatch time;
	const Estimate square = ParseSquare(o.square);
	Board board = MakeBoard(ParseTargetKind(o.target, "--target"), o.board, square.value, o.circle_diameter, "--target");
	board.square_sigma_mm = square.sigma;
	MeasureOptions measure;
	measure.transfer = ParseTransfer(o.transfer);
	measure.any_orientation = o.any_orientation;
	measure.edges_per_photo = o.edges_per_photo;
	CalibrateOptions options;
	measure.threads = options.threads = o.threads;
	options.model = ParseModel(o.model);
	options.scene_lens = o.edges_per_photo == 0;
	options.poses = ParsePoses(o.poses);
	options.refinement = ParseRefinement(o.refine);
	options.effects = ParseEffects(o.effects);
	measure.log = options.log = ProgramLog();
	if (o.pitch)
		CheckPitch(*o.pitch);
	if (o.threads < 0 || o.threads > MOST_THREADS)
		throw UsageError(fmt::format("--threads {}: give 0 for all processors, or 1 to {}", o.threads, MOST_THREADS));
	if (o.edges_per_photo != 0 && o.edges_per_photo < FEWEST_EDGES)
		throw UsageError(fmt::format("--edges-per-photo {}: give 0 for all edges, or at least {}", o.edges_per_photo, FEWEST_EDGES));
	const std::vector<StateFiles> states = States(o);
	const Known known = WhatIsKnown(o);
	const double pitch = o.pitch ? *o.pitch : PitchFromExif(AllFiles(states), options.log);
	const std::vector<FieldFile> fields = FlatFields(o, states);
	PrepareFolder(o.out);

	MeasuredPictures pictures(AllFiles(states).size());
	const Stopwatch stopwatch;
	const std::clock_t processors = std::clock();
	Task task = MeasureAll(states, board, pitch, measure, [&](size_t number, const cv::Mat& grey) { pictures.Add(number, grey); });
	const double seconds = stopwatch.Seconds();
	spdlog::info("measured in {:.1f} s, {:.2f} processors at work", seconds, double(std::clock() - processors) / CLOCKS_PER_SEC / seconds);
	task.priors = known.priors;
	task.blades = known.blades;
	task.untilted_free = o.untilted_free;
	for (const FieldFile& field : fields)
		AddFlatField(task, field.state, field.file, measure);
	for (const Prior& prior : PriorsFromExif(task, known.priors))
	{
		spdlog::info("EXIF says {} {:g}: taken as known to 10 %", prior.Name(), prior.value);
		task.priors.push_back(prior);
	}
	Calibration c = CalibrateWithPriors(task, known.priors.empty(), options);
	SpellAsOptions(c);
	for (const std::string& words : CompareWithExif(c))
		options.log.Warn(words);
	const RunNotes notes{ o.refine, command_line, fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))) };
	WriteEverything(c, notes, [&](size_t s, size_t p) { return pictures.Get(c.task, s, p); }, o.out);
	fmt::print("{}", SummaryTable(c));
	fmt::print("written to {}\n", o.out);
	spdlog::info("done in {:.1f} s", time.Seconds());
}

}

void AddCalibrate(CLI::App& app, const std::string& command_line)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("calibrate", "Photographs of a checkerboard or a grid of circles in, camera blocks for tilt_lens out.");
	c->add_option("--board", o->board, "Squares of the board, columns x rows, such as 12x9 (squares, not inner corners); of the other targets circles")->required();
	c->add_option("--target", o->target, "checkerboard, circles or asymmetric-circles, as tiltcal target --kind prints them")->capture_default_str();
	c->add_option("--square", o->square, "Side of a square, or spacing of circles, mm; asymmetric: distance of rows, half that of the circles in a row. "
		"VALUE:SIGMA where it is known to SIGMA: then the sigmas of all that grows with the board hold that too")->required();
	c->add_option("--circle-diameter", o->circle_diameter, "Diameter of a circle, mm; 0: half the distance of neighbouring centres. A little more or less does no "
		"harm: it is measured in every photograph")->capture_default_str();
	c->add_option("--pitch", o->pitch, "Distance of pixel centres on the sensor, mm; needed unless EXIF says it (FocalPlaneXResolution)");
	c->add_option("--untilted", o->untilted, "Photographs with the lens untilted: names or quoted patterns")->required();
	c->add_flag("--untilted-free", o->untilted_free, "Do not take the lens of --untilted to be straight: find its tilt too");
	c->add_option("--tilted", o->tilted, "NAME='GLOB': photographs of one tilted state; NAME of letters, digits and _ (- and . become _); may be repeated");
	c->add_option("--model", o->model, ModelHelp())->capture_default_str();
	c->add_option("--transfer", o->transfer, "Transfer curve of 8 and 16 bit pictures: srgb, linear or a gamma; OpenEXR is linear")->capture_default_str();
	c->add_option("--poses", o->poses, "shared: photograph n shows the board in one pose in every state; own: not; auto: see for itself")->capture_default_str();
	c->add_option("--refine", o->refine, "Last step, all numbers together: edges: places and blur widths of the edges; photometric: the brightness across them; "
		"none: geometry first, then blur")->capture_default_str();
	c->add_option("--fix", o->fix, "NAME=VALUE: what is known exactly: focal_length, f_number, image_distance, focus_distance, aperture_diameter "
		"(mm; untilted); blades (their number), blade_rotation (degrees, of a corner: 0 up, 90 right), blade_curvature (0 straight to 1 round); may be repeated");
	c->add_option("--prior", o->prior, "NAME=VALUE:SIGMA: what is known about; the same names; may be repeated");
	c->add_option("--flat-field", o->flat_field, "NAME=FILE: photograph of an evenly lit plain surface in the state NAME (untilted included); may be repeated. "
		"Vignetting is then told by these instead of the board's white squares");
	c->add_option("--effects", o->effects, "What the camera blocks simulate: auto: what is significant and predicts photographs left out better; all: all that can be estimated; "
		"none; or some of " + EffectNames() + ", separated by commas: exactly these")->capture_default_str();
	c->add_option("--edges-per-photo", o->edges_per_photo, "Measure only N edges of every photograph, spread evenly over the board and both directions: "
		"faster, less accurate, and a real lens by six numbers alone. 0: all")->capture_default_str();
	c->add_option("--threads", o->threads, "Work on so many photographs at once, and solve on so many threads; 0: all processors. What is measured in the photographs does "
		"not depend on it, what is solved in its last digits")->capture_default_str();
	c->add_flag("--any-orientation", o->any_orientation, "Accept a board that stands upside down (a mirrored picture looks the same)");
	c->add_option("--out", o->out, "Folder for calibration.json, camera-<state>.inc, overlays, report.txt and report.html (all on one page); created if missing")->required();
	c->footer("Example:\n  tiltcal calibrate --board 12x9 --square 25 --pitch 0.02 --untilted 'target/untilted-*.png' \\\n"
		"      --tilted plus5='target/plus5-*.png' --tilted minus5='target/minus5-*.png' --out calibration\n\n"
		"Photograph the board inclined by 20 to 45 degrees in several directions, with parts before and\n"
		"behind the plane of focus. Lengths are mm, angles degrees, picture measures pixels.\n"
		"Circles, dark on white or white on dark, must be larger than their blur: its radius may be 0.6 of theirs. Circles look the same turned\n"
		"by 180 degrees, as many columns as rows by 90: the picture's top left circle is the first. Asymmetric grids need an odd number of rows.\n"
		"Exit codes: 0 done, 1 refused or not converged, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o, command_line] { Run(*o, command_line); });
}

}
