// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tilt_lens against the mean of pinhole pictures from a stock POV-Ray (pinholes.h).
//
//   oracle CASE --stock POVRAY --ours POVRAY --scene oracle-scene.inc --work DIR
//
// The cases are in oracle_cases.cpp. A case that has a truth of its own leaves it in DIR for the cases that only say the
// same in other words; those need it to be there.
//
// Exit 0: RMS difference in linear RGB within the limits, 1: not, 2: wrong usage or a program failed.
#include "pinholes.h"
#include "support/case_options.h"
#include "support/run_povray.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <stdexcept>

namespace
{

namespace fs = std::filesystem;

// Limits of the RMS difference, those of the project. 1024 frames leave the oracle an error of 0.0007 to 0.0016 of its
// own, and the camera's samples about as much. They catch a mirrored tilt (0.012 to 0.035), but a lens 5 % too wide
// (0.0023) or a shift of 0.1 pixel (0.0029) hides in the noise. Means over 4 x 4 pixels have less of it: right 0.0003
// to 0.0007; too wide 0.0011 to 0.0025, shifted 0.0012 to 0.0016: Camera::cell_limit.
double Limit(int samples) { return samples >= 1024 ? 0.004 : 0.006; }
constexpr int CELL = 4;

// Pixels that look along or behind the lens plane must be black, and are left out with the pixels beside them: stock
// sees something there.
bool BlankUnseen(const Camera& camera, Picture& picture, Picture& truth)
{
	int not_black = 0, unseen = 0;
	for (int y = 0; y < HEIGHT; ++y)
		for (int x = 0; x < WIDTH; ++x)
		{
			const int seen = Seen(camera, x, y);
			if (seen == 1)
				continue;
			const std::size_t at = 3 * std::size_t(y * WIDTH + x);
			for (std::size_t c = at; c < at + 3; ++c)
			{
				not_black += seen == -1 && picture.rgb[c] != 0;
				picture.rgb[c] = truth.rgb[c] = 0;
			}
			unseen += seen == -1;
		}
	if (unseen > 0)
		std::printf("%s: %d pixels empty, of them %d not black\n", camera.name.c_str(), unseen, not_black);
	return not_black == 0 && (unseen > 0) == (camera.name == "grazing");
}

bool Compare(const Camera& camera, Picture truth, const fs::path& scene, const fs::path& work, const std::string& ours, int samples)
{
	std::ofstream(work / "ours.pov") << SceneWithTiltLens(camera, scene, samples);
	RunPovray(ours, work, "ours.pov", "ours.exr", WIDTH, HEIGHT);
	Picture picture = ReadExr((work / "ours.exr").string());
	if (camera.mirrored)
		truth = Mirrored(truth);
	const bool empty_is_black = BlankUnseen(camera, picture, truth);
	const double rms = RmsDifference(picture, truth), limit = Limit(samples);
	const double cell_rms = RmsDifference(Coarser(picture, CELL), Coarser(truth, CELL));
	std::printf("%s: %d samples: RMS difference %.5f (limit %.5f), of %d x %d means %.5f (limit %.5f)\n", camera.name.c_str(),
		samples, rms, limit, CELL, CELL, cell_rms, camera.cell_limit);
	return rms <= limit && cell_rms <= camera.cell_limit && AllFinite(picture) && empty_is_black;
}

}

int main(int argc, char** argv)
try
{
	std::map<std::string, std::string> option = ReadCaseOptions(argc, argv, "--stock POVRAY --ours POVRAY --scene SCENE --work DIR");
	const Camera camera = OracleCamera(argv[1]);
	const fs::path work = fs::path(option["--work"]) / ("oracle-" + camera.name);
	const fs::path truth_file = fs::path(option["--work"]) / ("oracle-" + camera.Truth()) / "truth.bin";
	fs::create_directories(work);
	Picture truth;
	if (camera.truth_of.empty())
	{
		double standard_error = 0;
		truth = MeanOfPinholes(camera, option["--scene"], work, option["--stock"], camera.Frames(), standard_error);
		WriteRaw(truth, truth_file.string());
		std::printf("%s: the oracle's own error about %.5f with %d frames\n", camera.name.c_str(), standard_error, camera.Frames());
	}
	else
		truth = ReadRaw(truth_file.string(), WIDTH, HEIGHT);
	bool good = Compare(camera, truth, option["--scene"], work, option["--ours"], camera.samples);
	if (camera.samples > 256 && camera.truth_of.empty())
		good = Compare(camera, truth, option["--scene"], work, option["--ours"], 256) && good;
	return good ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "oracle: %s\n", error.what());
	return 2;
}
