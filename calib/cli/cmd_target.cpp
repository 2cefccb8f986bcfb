// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/file_set.h"
#include "base/files.h"
#include "target/target.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string board, kind = "checkerboard", paper = "auto";
	double square = 0, circle_diameter = 0, margin = 10;
	std::vector<std::string> out;
};

void Run(const Options& o)
{
	for (const std::string& file : o.out)
		CheckTargetSuffix(file);
	const Board target = MakeBoard(ParseTargetKind(o.kind, "--kind"), o.board, o.square, o.circle_diameter, "--kind");
	const TargetPage page = LayOut(target, o.paper, o.margin);
	FileSet set;
	for (const std::string& file : o.out)
	{
		PrepareFolderOf(file);
		WriteTarget(page, file, set);
	}
	set.Commit();
	if (LooksTheSameTurned(target))
		spdlog::warn("this target looks the same when turned by 180 degrees: {}", target.kind == TargetKind::ASYMMETRIC_CIRCLES ? "tiltcal does not read it; choose an odd number of rows, such as 4x11"
			: target.IsCheckerboard() ? "mark its top in the scene, or choose columns + rows odd, such as 12x9" : "mark its top in the scene, or choose asymmetric-circles with an odd number of rows, such as 4x11");
	fmt::print("{} on {} ({:g} x {:g} mm)\n", Describe(target), page.paper, page.width, page.height);
	for (const std::string& file : o.out)
		fmt::print("written to {}\n", file);
}

}

void AddTarget(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("target", "A target to print at true size, and the same target for POV-Ray.");
	c->add_option("--board", o->board, "Columns x rows: squares of a checkerboard such as 12x9, circles of the other kinds such as 4x11")->required();
	c->add_option("--square", o->square, "Side of a square, or spacing of circles, mm; asymmetric: distance of rows, half that of the circles in a row")->required();
	c->add_option("--kind", o->kind, "checkerboard, circles or asymmetric-circles (OpenCV's CALIB_CB_ASYMMETRIC_GRID)")->capture_default_str();
	c->add_option("--circle-diameter", o->circle_diameter, "Diameter of a circle, mm; 0: half the distance of neighbouring centres")->capture_default_str();
	c->add_option("--paper", o->paper, "a5 to a0, letter, legal, tabloid (turned as needed), WxH in mm, or auto: the smallest of a5 to a0 that holds it")->capture_default_str();
	c->add_option("--margin", o->margin, "Rim of the page that stays unprinted, mm")->capture_default_str();
	c->add_option("--out", o->out, "FILE, by its suffix: .pdf or .svg to print, .inc a POV-Ray object; may be repeated")->required();
	c->footer("Example:\n  tiltcal target --board 12x9 --square 25 --paper a3 --out board.pdf --out board.inc\n\n"
		"Print at 100 % and measure the scale bar: 100 mm. Half a square about the pattern stays white.\n"
		"The top left square is black. Turned by 180 degrees, checkerboards whose columns + rows are even, circles,\n"
		"and asymmetric circles with an even number of rows look the same: their two ends cannot be told apart.\n"
		"The .inc declares TiltCal_Target: mm, origin at the first inner corner (or circle's centre), x along the\n"
		"columns, y up the rows, z into the board; and TiltCal_Target_Columns, _Rows, _Square, ...\n"
		"Exit codes: 0 done, 1 refused (does not fit), 2 wrong usage, 3 unwritable file.");
	c->callback([o] { Run(*o); });
}

}
