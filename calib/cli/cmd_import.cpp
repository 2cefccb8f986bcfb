// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include <tiltcal/calibrate.h>
#include "program/program.h"
#include <tiltcal/error.h>
#include "base/distinct_files.h"
#include "base/files.h"
#include "camera/opencv_yaml.h"
#include "model/state_names.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string in, state, out;
	double pitch = 0;
};

void CheckState(const std::string& name)
{
	try
	{
		CheckStateName(name);
	}
	catch (const Error& e)
	{
		throw UsageError(fmt::format("--state: {}", e.what()));
	}
}

void Run(const Options& o)
{
	CheckPitch(o.pitch);
	CheckDistinct({ { "IN", o.in } }, { { "--out", o.out } });
	const std::string state = WithUnderscores(o.state);
	if (!state.empty())
		CheckState(state);
	double lost_px = 0;
	const StateCamera camera = ReadOpenCv(o.in, o.pitch, state, lost_px);
	PrepareFolderOf(o.out);
	WriteText(o.out, StateCameraJson(camera, o.in));
	// Below this no picture can show it.
	if (lost_px > 0.01)
		spdlog::warn("{}: fx and fy differ; with their mean, pixels at the picture's edge move by up to {:.2f} px", o.in, lost_px);
	if (const std::string fold = FoldWarning(camera); !fold.empty())
		spdlog::warn("{}", fold);
	std::FILE* const report = ReportBeside({ o.out });
	fmt::print(report, "state {}: image distance {:.6g} mm, lens tilt {:.4f} degrees towards {:.2f}\n", camera.state, camera.image_distance_mm,
		camera.lens_tilt_deg, camera.tilt_direction_deg);
	fmt::print(report, "unknown: aperture and plane of focus, which OpenCV's model has not; the camera is a pinhole\nwritten to {}\n", o.out);
}

}

void AddImport(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("import", "A camera calibrated with OpenCV as calibration.json, for pose, export, undistort, project and unproject.");
	c->add_option("IN", o->in, "FILE of OpenCV's calibration: image_width, image_height, camera_matrix, distortion_coefficients")->required();
	c->add_option("--pitch", o->pitch, "Distance of pixel centres on the sensor, mm")->required();
	c->add_option("--state", o->state, "Name for the state; left out: tilted where there are tauX, tauY, else untilted");
	c->add_option("--out", o->out, "FILE calibration.json")->required();
	c->footer("Example:\n  tiltcal import plus5.yml --pitch 0.02 --state plus5 --out imported/calibration.json\n\n"
		"4, 5 or 14 coefficients (CALIB_TILTED_MODEL); k4 to k6 and s1 to s4 must be 0, fx and fy within 0.5 %.\n"
		"OpenCV knows no blur: aperture and focus are null in the result, and cameras made of it are pinholes.\n"
		"Exit codes: 0 done, 1 refused, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
