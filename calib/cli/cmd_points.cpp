// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/distinct_files.h"
#include "base/files.h"
#include "exchange/point_lists.h"

#include <fmt/format.h>

#include <functional>
#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string calibration, state, points, out;
};

CLI::App* AddList(CLI::App& app, const std::string& name, const std::string& what, const std::string& header,
	const std::function<std::string(const StateCamera&, const std::string&)>& make)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand(name, what);
	c->add_option("POINTS", o->points, fmt::format("FILE.csv with the header {}; -: standard input", header))->required();
	c->add_option("--calibration", o->calibration, "FILE calibration.json of tiltcal calibrate or import")->required();
	c->add_option("--state", o->state, "The state's name; left out: the first, which is the untilted one");
	c->add_option("--out", o->out, "FILE.csv; left out: standard output");
	c->callback([o, make]
	{
		CheckDistinct({ { "--calibration", o->calibration }, { "POINTS", o->points } }, { { "--out", o->out } });
		const std::string text = make(ReadStateCamera(o->calibration, o->state), o->points);
		if (o->out.empty())
			return fmt::print("{}", text);
		PrepareFolderOf(o->out);
		WriteText(o->out, text);
	});
	return c;
}

const char* const FRAME = "Camera frame: origin in the lens centre, x right, y up, z forward, mm, on a sensor that stays put when the lens tilts.\n"
	"Pixels: (0, 0) is the centre of the top left one, v down. The thin lens that the calibration found, with its distortion.\n"
	"Exit codes: 0 done, 1 refused, 2 wrong usage, 3 unreadable or unwritable file.";

}

void AddProject(CLI::App& app)
{
	AddList(app, "project", "Where a camera sees points, and how blurred.", "x,y,z", ProjectedPoints)
		->footer(fmt::format("Example:\n  tiltcal project points.csv --calibration calibration/calibration.json --state plus5\n\n"
			"Gives x,y,z,u_px,v_px,blur_px: the pixel, and the diameter of the blur disc; empty for points that are not in front of the lens\n"
			"or beyond what its distortion is known for. The blur of an imported camera is unknown, and empty.\n{}", FRAME));
}

void AddUnproject(CLI::App& app)
{
	AddList(app, "unproject", "What pixels see: directions, and where on them is in focus.", "u_px,v_px", UnprojectedPixels)
		->footer(fmt::format("Example:\n  tiltcal unproject pixels.csv --calibration calibration/calibration.json --state plus5\n\n"
			"Gives u_px,v_px,x,y,z,focus_z_mm: a unit direction, and the depth z of the point in focus on it; inf: none, < 0: only behind the lens;\n"
			"empty where the distortion has no inverse.\n{}", FRAME));
}

}
