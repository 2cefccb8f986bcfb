// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/files.h"
#include "base/stopwatch.h"
#include "calibrate/measure_all.h"
#include "cli/calibrate_run.h"
#include "cli/watch.h"
#include "effects/effects.h"
#include "model/names.h"
#include "report/write_report.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <cstdio>
#include <ctime>
#include <memory>

namespace tiltcal
{

namespace
{

/// The help of --model, from the models' own words.
std::string ModelHelp()
{
	std::string help = "auto: curved where photographs left out show field curvature, else plane; from there on lens, where aberrations are left over and photographs left out show them";
	for (const ModelWords& words : MODELS)
		help += fmt::format("; {}: {}", words.name, words.meaning);
	return help;
}

void Once(const CalibrateRun& run)
{
	const Stopwatch time;
	std::vector<StateFiles> files;
	size_t count = 0;
	for (const StatePatterns& state : run.states)
	{
		files.push_back({ state.name, ExpandGlobs(state.patterns, state.option), state.f_number });
		count += files.back().files.size();
	}
	const double pitch = run.Pitch(files);
	for (const FieldPattern& field : run.fields)
		ExpandGlobs({ field.pattern }, field.option);
	PrepareFolder(run.words.out);

	std::vector<PackedPicture> pictures(count);
	const Stopwatch stopwatch;
	const std::clock_t processors = std::clock();
	Task task;
	{
		Progress progress("measuring", count);
		std::atomic<size_t> done = 0;
		task = MeasureAll(files, run.board, pitch, run.measure, [&](size_t number, const cv::Mat& grey)
		{
			pictures[number] = Pack(grey);
			progress.Done(++done);
		});
	}
	const double seconds = stopwatch.Seconds();
	spdlog::info("measured in {:.1f} s, {:.2f} processors at work", seconds, double(std::clock() - processors) / CLOCKS_PER_SEC / seconds);
	const Calibration c = run.Solve(std::move(task), 0);
	std::vector<std::vector<const PackedPicture*>> packed;
	size_t n = 0;
	for (const State& state : c.task.states)
	{
		packed.emplace_back();
		for (size_t p = 0; p < state.photos.size(); ++p)
			packed.back().push_back(&pictures[n++]);
	}
	run.Write(c, packed, {});
	fmt::print("{}", SummaryTable(c));
	fmt::print("written to {}\n", run.words.out);
	std::fflush(stdout);   // both may go to one file
	spdlog::info("done in {:.1f} s", time.Seconds());
	RefuseUnlessConverged(c);
}

void Run(const CalibrateWords& words, const std::string& command_line)
{
	const CalibrateRun run(words, command_line);
	if (words.watch.empty())
		Once(run);
	else
		Watch(run);
}

}

void AddCalibrate(CLI::App& app, const std::string& command_line)
{
	auto o = std::make_shared<CalibrateWords>();
	CLI::App* c = app.add_subcommand("calibrate", "Photographs of a checkerboard or a grid of circles in, camera blocks for tilt_lens out.");
	c->add_option("--board", o->board, "Squares of the board, columns x rows, such as 12x9 (squares, not inner corners); of the other targets circles")->required();
	c->add_option("--target", o->target, "checkerboard, circles or asymmetric-circles, as tiltcal target --kind prints them")->capture_default_str();
	c->add_option("--square", o->square, "Side of a square, or spacing of circles, mm; asymmetric: distance of rows, half that of the circles in a row. "
		"VALUE:SIGMA where it is known to SIGMA: then the sigmas of all that grows with the board hold that too")->required();
	c->add_option("--circle-diameter", o->circle_diameter, "Diameter of a circle, mm; 0: half the distance of neighbouring centres. A little more or less does no "
		"harm: it is measured in every photograph")->capture_default_str();
	c->add_option("--pitch", o->pitch, "Distance of pixel centres on the sensor, mm; needed unless EXIF says it (FocalPlaneXResolution)");
	c->add_option("--untilted", o->untilted, "Photographs with the lens untilted: names or quoted patterns");
	c->add_flag("--untilted-free", o->untilted_free, "Do not take the lens of --untilted to be straight: find its tilt too");
	c->add_option("--tilted", o->tilted, "NAME='GLOB': photographs of one tilted state; NAME of letters, digits and _ (- and . become _); may be repeated");
	c->add_option("--state", o->state, "NAME:f_number=N='GLOB': photographs of the state NAME, untilted too, at that f-number; may be repeated, with other f-numbers of one NAME, also in --tilted. "
		"Photographs of one NAME share tilt, image distance and principal point. The diameter at the least f-number is found, and how wide the others open beside it; "
		"photographs without f_number are of the one that EXIF says. NAME='GLOB': as --tilted");
	c->add_option("--model", o->model, ModelHelp())->capture_default_str();
	c->add_option("--transfer", o->transfer, "Transfer curve of 8 and 16 bit pictures: srgb, linear or a gamma; OpenEXR is linear")->capture_default_str();
	c->add_option("--poses", o->poses, "shared: photograph n shows the board in one pose in every state; own: not; auto: see for itself")->capture_default_str();
	c->add_option("--refine", o->refine, "Last step, all numbers together: edges: places and blur widths of the edges; photometric: the brightness across them; "
		"none: geometry first, then blur")->capture_default_str();
	c->add_option("--fix", o->fix, "NAME=VALUE: what is known exactly: focal_length, f_number, image_distance, focus_distance, aperture_diameter "
		"(mm; untilted); blades (their number), blade_rotation (degrees, of a corner: 0 up, 90 right), blade_curvature (0 straight to 1 round); may be repeated");
	c->add_option("--prior", o->prior, "NAME=VALUE:SIGMA: what is known about; the same names but those of blades; may be repeated");
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
	c->add_option("--watch", o->watch, "FOLDER: go on, until Ctrl-C: measure photographs as they arrive there, calibrate anew and draw report.html again, which loads itself. Patterns of "
		"--untilted, --tilted, --state and --flat-field are of files in FOLDER and may match none yet");
	c->footer("Example:\n  tiltcal calibrate --board 12x9 --square 25 --pitch 0.02 --untilted 'target/untilted-*.png' \\\n"
		"      --tilted plus5='target/plus5-*.png' --tilted minus5='target/minus5-*.png' --out calibration\n"
		"Wide open and stopped down together:\n"
		"  tiltcal calibrate --board 12x9 --square 25 --pitch 0.02 --state untilted:f_number=2.8='open/untilted-*.png' \\\n"
		"      --state untilted:f_number=8='small/untilted-*.png' --state plus5:f_number=2.8='open/plus5-*.png' --out calibration\n\n"
		"Photograph the board inclined by 20 to 45 degrees in several directions, with parts before and\n"
		"behind the plane of focus. Lengths are mm, angles degrees, picture measures pixels.\n"
		"Ctrl-C leaves nothing half written. With --watch it ends the watching: exit code 0 where there is a calibration.\n"
		"Circles, dark on white or white on dark, must be larger than their blur: its radius may be 0.6 of theirs. Circles look the same turned\n"
		"by 180 degrees, as many columns as rows by 90: the picture's top left circle is the first. Asymmetric grids need an odd number of rows.\n"
		"Exit codes: 0 done, 1 refused or not converged, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o, command_line] { Run(*o, command_line); });
}

}
