// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/distinct_files.h"
#include "base/file_set.h"
#include "base/files.h"
#include "camera/opencv_yaml.h"
#include "exchange/colmap.h"
#include "exchange/maps.h"
#include "exchange/scene_files.h"
#include "program/program.h"
#include "program/progress.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <memory>
#include <vector>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string calibration, state, opencv, stmap, overscan = "0", rays, blender, renderman, arnold, colmap;
	double unit_mm = 1000;

	std::vector<std::string> Files() const
	{
		std::vector<std::string> files;
		for (const std::string& file : { opencv, stmap, rays, blender, renderman, arnold, colmap })
			if (!file.empty())
				files.push_back(file);
		return files;
	}
};

void Check(const Options& o)
{
	if (o.Files().empty())
		throw UsageError("nothing to write: give one or more of --opencv, --stmap, --rays, --blender, --renderman, --arnold, --colmap");
	CheckDistinct({ { "--calibration", o.calibration } }, { { "--opencv", o.opencv }, { "--rays", o.rays }, { "--blender", o.blender }, { "--renderman", o.renderman }, { "--arnold", o.arnold },
		{ "--colmap", o.colmap }, { "--stmap", o.stmap.empty() ? "" : o.stmap + "-undistort.exr" }, { "--stmap", o.stmap.empty() ? "" : o.stmap + "-redistort.exr" } });
	if (!(o.unit_mm > 0) || !std::isfinite(o.unit_mm))
		throw UsageError(fmt::format("--unit-mm {}: give the millimetres of a scene unit, such as 1000 for metres", o.unit_mm));
}

void ExportOpenCv(const Options& o, const StateCamera& camera, FileSet& set)
{
	set.Text(o.opencv, OpenCvText(camera, o.opencv));
	const OpenCvCamera c = ToOpenCv(camera);
	fmt::print(ReportBeside(o.Files()), "state {}: f {:.4f} px, centre ({:.4f}, {:.4f}) px", camera.state, c.fx, c.centre[0], c.centre[1]);
	if (camera.IsTilted())
		fmt::print(ReportBeside(o.Files()), ", tauX {:.6f}, tauY {:.6f} (radians)", c.tau_x, c.tau_y);
	fmt::print(ReportBeside(o.Files()), "\n{}: lost: {}\n", o.opencv, LostInOpenCv());
}

void ExportMaps(const Options& o, const StateCamera& camera, FileSet& set)
{
	if (!o.stmap.empty())
	{
		const Margins margins = ParseOverscan(o.overscan, camera);
		auto progress = std::make_unique<Progress>("working out the STMaps");
		const double share = WriteStMaps(camera, margins, o.stmap, set);
		progress.reset();
		fmt::print(ReportBeside(o.Files()), "{0}-undistort.exr, {0}-redistort.exr: photograph {1} x {2}, undistorted {3} x {4}, which shows {5:.1f} % of the photograph\n", o.stmap, camera.width,
			camera.height, camera.width + 2 * margins.x, camera.height + 2 * margins.y, 100 * share);
	}
	if (!o.rays.empty())
	{
		WriteRayMap(camera, o.rays, set);
		fmt::print(ReportBeside(o.Files()), "{}: ray.X, ray.Y, ray.Z{}\n", o.rays, camera.KnowsFocus() ? ", focus.Z (mm)" : "; the plane of focus is unknown");
	}
}

void ExportScenes(const Options& o, const StateCamera& camera, FileSet& set)
{
	const auto write = [&](const std::string& file, const std::string& text, const std::string& lost)
	{
		set.Text(file, text);
		fmt::print(ReportBeside(o.Files()), "{}: not in it: {}\n", file, lost);
	};
	if (!o.blender.empty())
		write(o.blender, BlenderScript(camera, o.unit_mm), "the tilt of focus (the plane of focus is an object), distortion (--stmap), field curvature, rims" + LostBlades(camera, MOST_BLENDER_BLADES));
	if (!o.renderman.empty())
		write(o.renderman, RenderManText(camera, o.unit_mm), "distortion (--stmap), field curvature, rims, blades");
	if (!o.arnold.empty())
		write(o.arnold, ArnoldText(camera, o.unit_mm), "the tilt of focus, distortion (--stmap), field curvature, rims" + LostBlades(camera, camera.blades.count));
	if (o.colmap.empty())
		return;
	const ColmapCamera c = ToColmap(camera);
	write(o.colmap, ColmapText(camera), fmt::format("aperture and focus; its pixels are within {:.2g} px RMS of tiltcal's, {:.2g} px at worst", c.rms_px, c.worst_px));
}

void Run(const Options& o)
{
	Check(o);
	const StateCamera camera = ReadStateCamera(o.calibration, o.state);
	for (const std::string& file : o.Files())
		PrepareFolderOf(file == o.stmap ? file + "-undistort.exr" : file);
	FileSet set;
	ExportMaps(o, camera, set);
	ExportScenes(o, camera, set);
	// After all that may be refused.
	if (!o.opencv.empty())
		ExportOpenCv(o, camera, set);
	set.Commit();
	if (const std::string fold = FoldWarning(camera); !fold.empty())
		spdlog::warn("{}", fold);
}

}

void AddExport(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("export", "A calibrated state for other programs: OpenCV, STMaps, Blender, RenderMan, Arnold, COLMAP.");
	c->add_option("--calibration", o->calibration, "FILE calibration.json of tiltcal calibrate or import")->required();
	c->add_option("--state", o->state, "The state's name; left out: the first, which is the untilted one");
	c->add_option("--opencv", o->opencv, "FILE to write: .yml, .yaml or .xml, as cv::FileStorage");
	c->add_option("--stmap", o->stmap, "STEM: writes STEM-undistort.exr and STEM-redistort.exr for Nuke, Fusion, Flame, Blender");
	c->add_option("--overscan", o->overscan, "Of the STMaps: percent by which the undistorted picture is larger on each side, or auto: all of the photograph")->capture_default_str();
	c->add_option("--rays", o->rays, "FILE.exr: every pixel's direction (ray.X, ray.Y, ray.Z) and depth in focus (focus.Z, mm)");
	c->add_option("--blender", o->blender, "FILE.py: a script that makes the camera and its plane of focus");
	c->add_option("--renderman", o->renderman, "FILE.rib: PxrCamera, its plane of focus by three points");
	c->add_option("--arnold", o->arnold, "FILE.ass: persp_camera");
	c->add_option("--colmap", o->colmap, "FILE cameras.txt: FULL_OPENCV");
	c->add_option("--unit-mm", o->unit_mm, "Of Blender's, RenderMan's and Arnold's scenes: millimetres of a unit")->capture_default_str();
	c->footer("Examples:\n  tiltcal export --calibration calibration/calibration.json --state plus5 --opencv plus5.yml\n"
		"  tiltcal export --calibration calibration/calibration.json --state plus5 --stmap plus5 --overscan auto --blender plus5.py\n\n"
		"OpenCV: lengths are pixels, angles radians. Untilted states have 5 coefficients, tilted ones 14 (OpenCV's\n"
		"CALIB_TILTED_MODEL: tauX, tauY). OpenCV's camera frame is then the lens's, not the sensor's; the file's\n"
		"opencv_from_tiltcal turns one into the other. Pixels agree exactly with cv::projectPoints; blur, aperture,\n"
		"focus and poses are not in the file.\n"
		"STMaps: R and G are x and y from 0 to 1, from the left and bottom edge of the picture that is looked up; -1 is outside.\n"
		"The others say in the file what it cannot hold. COLMAP's camera of a tilted state is the nearest one; how near is printed.\n"
		"Exit codes: 0 done, 1 refused, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
