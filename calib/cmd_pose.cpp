// SPDX-License-Identifier: AGPL-3.0-or-later

#include "commands.h"

#include "error.h"
#include "files.h"
#include "pose.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string calibration, state, points, out;
	double unit_mm = 1;
};

void Run(const Options& o)
{
	if (!(o.unit_mm > 0) || !std::isfinite(o.unit_mm))
		throw UsageError(fmt::format("--unit-mm {}: give the millimetres of a scene unit, such as 1000 for metres", o.unit_mm));
	const StateCamera camera = ReadStateCamera(o.calibration, o.state);
	const std::vector<PosePoint> points = ReadPosePoints(o.points);
	if (!o.out.empty())
		PrepareFolderOf(o.out);
	const CameraPose pose = SolvePose(camera, points, o.points);
	const std::string inc = PoseInc(camera, pose, o.unit_mm);
	if (o.out.empty())
	{
		// stdout is the block alone, so that it can be piped into a file.
		fmt::print(stderr, "{}", PoseText(pose, points));
		fmt::print("{}", inc);
		return;
	}
	WriteText(o.out, inc);
	fmt::print("{}written to {}\n", PoseText(pose, points), o.out);
}

}

void AddPose(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("pose", "Places a calibrated camera in a scene by points of known place, as a camera block.");
	c->add_option("--calibration", o->calibration, "FILE calibration.json of tiltcal calibrate or import")->required();
	c->add_option("--state", o->state, "The state's name; left out: the first, which is the untilted one");
	c->add_option("--points", o->points, "FILE.csv with the header u_px,v_px,x,y,z: pixel of the photograph, point of the scene")->required();
	c->add_option("--unit-mm", o->unit_mm, "Millimetres of a scene unit, such as 1000 for metres")->capture_default_str();
	c->add_option("--out", o->out, "FILE.inc for the camera block; left out: stdout, and the report goes to stderr");
	c->footer("Example:\n  tiltcal pose --calibration calibration/calibration.json --state plus5 --points points.csv --unit-mm 1000 --out camera.inc\n\n"
		"Pixel centres are at integers, (0, 0) top left, v downwards. The scene is left-handed as POV-Ray's; points in\n"
		"one plane cannot show that it is not. At least 4 points not on one line, 6 for sigmas (of the points' scatter\n"
		"alone; scene units and degrees), best spread over the picture and in depth.\n"
		"Exit codes: 0 done, 1 refused (points do not tell one camera), 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
