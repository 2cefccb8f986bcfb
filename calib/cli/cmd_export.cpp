// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "base/files.h"
#include "camera/opencv_yaml.h"

#include <fmt/format.h>

#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string calibration, opencv, state;
};

void Run(const Options& o)
{
	const StateCamera camera = ReadStateCamera(o.calibration, o.state);
	PrepareFolderOf(o.opencv);
	WriteOpenCv(camera, o.opencv);
	const OpenCvCamera c = ToOpenCv(camera);
	fmt::print("state {}: f {:.4f} px, centre ({:.4f}, {:.4f}) px", camera.state, c.fx, c.centre[0], c.centre[1]);
	if (camera.IsTilted())
		fmt::print(", tauX {:.6f}, tauY {:.6f} (radians)", c.tau_x, c.tau_y);
	fmt::print("\nlost: {}\nwritten to {}\n", LostInOpenCv(), o.opencv);
}

}

void AddExport(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("export", "A calibrated state as OpenCV's camera_matrix and distortion_coefficients.");
	c->add_option("--calibration", o->calibration, "FILE calibration.json of tiltcal calibrate or import")->required();
	c->add_option("--opencv", o->opencv, "FILE to write: .yml, .yaml or .xml, as cv::FileStorage")->required();
	c->add_option("--state", o->state, "The state's name; left out: the first, which is the untilted one");
	c->footer("Example:\n  tiltcal export --calibration calibration/calibration.json --state plus5 --opencv plus5.yml\n\n"
		"Lengths in the file are pixels, angles radians. Untilted states have 5 coefficients, tilted ones 14 (OpenCV's\n"
		"CALIB_TILTED_MODEL: tauX, tauY). OpenCV's camera frame is then the lens's, not the sensor's; the file's\n"
		"opencv_from_tiltcal turns one into the other. Pixels agree exactly with cv::projectPoints; blur, aperture,\n"
		"focus and poses are not in the file.\n"
		"Exit codes: 0 done, 1 refused, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
