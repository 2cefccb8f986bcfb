// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "program/program.h"
#include <tiltcal/error.h>
#include "base/distinct_files.h"
#include "base/file_set.h"
#include "base/files.h"
#include "picture/image_io.h"
#include "camera/pose_photo.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string calibration, state, points, photo, transfer = "srgb", overlay, out;
	double unit_mm = 1;
	int window = 9;
	bool real_lens = false, thin_lens = false;
};

void Report(const Options& o, const PhotoPose& solved, const std::string& inc, FileSet& set)
{
	const std::string text = PhotoPoseText(solved);
	if (solved.pose.outliers > 0)
		spdlog::warn("{}: {} of {} points are far off and hardly count; measure again line {} ({:.2f} px)", o.points, solved.pose.outliers, solved.points.size(),
			solved.points[solved.pose.worst].line, solved.pose.residuals[solved.pose.worst].norm());
	if (!o.out.empty())
		set.Text(o.out, inc);
	set.Commit();
	if (o.out.empty())
	{
		// stdout is the block alone, so that it can be piped into a file.
		fmt::print(stderr, "{}", text);
		fmt::print("{}", inc);
		return;
	}
	fmt::print(ReportBeside({ o.out }), "{}written to {}\n", text, o.out);
}

void Run(const Options& o)
{
	if (!(o.unit_mm > 0) || !std::isfinite(o.unit_mm))
		throw UsageError(fmt::format("--unit-mm {}: give the millimetres of a scene unit, such as 1000 for metres", o.unit_mm));
	if (o.photo.empty() && !o.overlay.empty())
		throw UsageError("--overlay: needs --photo, which it is drawn on");
	CheckDistinct({ { "--calibration", o.calibration }, { "--points", o.points }, { "--photo", o.photo } }, { { "--out", o.out }, { "--overlay", o.overlay } });
	const StateCamera camera = ReadStateCamera(o.calibration, o.state);
	const bool through_real = o.real_lens || (!o.thin_lens && TakesRealLens(o.calibration));
	const std::optional<StateCamera> real = through_real ? ReadRealLensCamera(o.calibration, camera.state) : std::nullopt;
	if (o.real_lens && !real)
		throw UsageError(fmt::format("--real-lens: {} has no real lens for its answer: calibrate with --model lens", o.calibration));
	if (const std::string fold = FoldWarning(real ? *real : camera); !fold.empty())
		spdlog::warn("{}", fold);
	const std::vector<PosePoint> points = ReadPosePoints(o.points);
	for (const std::string& file : { o.out, o.overlay })
		if (!file.empty())
			PrepareFolderOf(file);
	PhotoPose solved;
	cv::Mat photo;
	if (o.photo.empty())
		solved = { SolvePose(camera, points, o.points), points, {}, {}, {} };
	else
	{
		photo = ReadLinear(o.photo, ParseTransfer(o.transfer));
		solved = SolvePoseInPhoto(camera, photo, points, o.window, o.points, o.unit_mm);
	}
	if (real)
	{
		spdlog::info("through the real lens, for scenes with TiltCal_Real_Lens = 1{}", o.real_lens ? "" : ", as the .inc files have it; --thin-lens for the other");
		solved.pose = SolvePose(*real, solved.points, o.points, o.unit_mm);
	}
	FileSet set;
	if (!o.overlay.empty())
		set.Text(o.overlay, PngOf(DrawPosePoints(photo, solved)));
	Report(o, solved, PoseInc(real ? *real : camera, solved.pose, o.unit_mm), set);
}

}

void AddPose(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("pose", "Places a calibrated camera in a scene by points of known place, as a camera block.");
	c->add_option("--calibration", o->calibration, "FILE calibration.json of tiltcal calibrate or import")->required();
	c->add_option("--state", o->state, "The state's name; left out: the first, which is the untilted one");
	c->add_option("--points", o->points, "FILE.csv with the header u_px,v_px,x,y,z: pixel of the photograph, point of the scene; with --photo the pixel may be missing (,,x,y,z)")->required();
	c->add_option("--photo", o->photo, "FILE the photograph: points that are crossings of edges (of a floor's tiles, of a pattern) are measured in it, and those "
		"without a pixel are looked for");
	c->add_option("--window", o->window, "N pixels to each side in which a crossing is measured; less than the distance to the next one, more than the blur")
		->capture_default_str()->check(CLI::Range(3, 100));
	CLI::Option* real = c->add_flag("--real-lens", o->real_lens, "Through the real lens, where the calibration has one: for scenes that declare TiltCal_Real_Lens = 1; left out: as the "
		"calibration's .inc files do where a scene says nothing");
	c->add_flag("--thin-lens", o->thin_lens, "Through the thin lens: for scenes that declare TiltCal_Real_Lens = 0")->excludes(real);
	c->add_option("--transfer", o->transfer, "Of an 8- or 16-bit photograph: srgb, linear or a gamma")->capture_default_str();
	c->add_option("--overlay", o->overlay, "FILE.png for the photograph with the points and how far off they are; needs --photo");
	c->add_option("--unit-mm", o->unit_mm, "Millimetres of a scene unit, such as 1000 for metres")->capture_default_str();
	c->add_option("--out", o->out, "FILE.inc for the camera block; left out: stdout, and the report goes to stderr");
	c->footer("Example:\n  tiltcal pose --calibration calibration/calibration.json --state plus5 --points points.csv --unit-mm 1000 --out camera.inc\n"
		"  tiltcal pose --calibration calibration/calibration.json --points corners-of-tiles.csv --photo kitchen.jpg --overlay points.png --out pose.inc\n\n"
		"Pixel centres are at integers, (0, 0) top left, v downwards. The scene is left-handed as POV-Ray's; points in\n"
		"one plane cannot show that it is not. At least 4 points not on one line, 6 for sigmas (of the points' scatter\n"
		"alone; scene units and degrees), best spread over the picture and in depth. With --photo it is enough to click on four,\n"
		"to within --window pixels: crossings without a pixel are found where those four say, hidden ones are left out.\n"
		"The file declares TiltCal_Pose_Location, TiltCal_Pose_Look_At and TiltCal_Pose_Sky too: with an untilted photograph's\n"
		"pose, TiltCal_<state>_Body of the calibration's .inc files is the camera of every other state on the same tripod.\n"
		"Exit codes: 0 done, 1 refused (points do not tell one camera), 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
