// Calibrates from photographs and prints the tilts: tilts FOLDER, of the demo's photographs.
#include <tiltcal/calibrate.h>
#include <tiltcal/camera.h>
#include <tiltcal/error.h>

#include <cstdio>
#include <string>

int main(int, char** argv)
try
{
	std::vector<tiltcal::StateFiles> states{ { "untilted", {} }, { "plus5", {} }, { "minus5", {} } };
	for (tiltcal::StateFiles& state : states)
		for (int k = 1; k <= 6; ++k)
			state.files.push_back(argv[1] + ("/" + state.name) + "-" + std::to_string(k) + ".jpg");
	const tiltcal::Task task = tiltcal::MeasureAll(states, tiltcal::ParseBoard("12x9", 25), 0.02);
	// Half of the time is the lens for scenes at other distances than the boards'.
	tiltcal::CalibrateOptions options;
	options.scene_lens = false;
	const tiltcal::Calibration calibration = tiltcal::Calibrate(task, options);
	for (size_t s = 0; s < states.size(); ++s)
	{
		const tiltcal::StateCamera camera = tiltcal::CameraOfState(calibration, s);
		const tiltcal::Estimate tilt = calibration.TiltOf(s).lens_tilt;
		std::printf("%s tilt %.4f +- %.4f degrees\n", camera.state.c_str(), tilt.value, tilt.sigma);
		const tiltcal::Vec3<double> P = 700.0 * tiltcal::Unproject(camera, { 300, 200 }).value();
		const tiltcal::Point pixel = *tiltcal::Project(camera, P);
		std::printf("%s sees (300, 200) at (%.6f, %.6f), blurred by %.3f px\n", camera.state.c_str(), pixel[0], pixel[1], tiltcal::BlurWidth(camera, P));
	}
	std::printf("%s", tiltcal::CameraBlockOf(tiltcal::CameraOfState(calibration, 1), {}).c_str());
}
catch (const tiltcal::Error& e)
{
	std::fprintf(stderr, "%s\n", e.what());
	return e.Code();
}
