// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/denoise_cost.h"

#include "lens/denoise.h"
#include "tiltcost/pilot_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace tiltcost
{

namespace
{

/// Bands have margins, which count as much in these as in any; narrow pictures are over too soon to be timed, and wide ones cost no more for a pixel.
const int Rows = 2 * tilt_lens::DenoiseBand, Narrow = 640, Wide = 1920;

/// CPU seconds of the empty picture; `word`: denoise or nothing.
double EmptyPictureSeconds(const std::string& povray, int width, const char* word, const tiltcal::TemporaryFolder& folder)
{
	Job job;
	job.povray = povray;
	job.scene = folder.File("empty.pov");
	std::ofstream(job.scene) << fmt::format("#version 3.7;\nglobal_settings {{ assumed_gamma 1 }}\nbackground {{ rgb 0.3 }}\n"
		"camera {{ tilt_lens {{ aperture_diameter 0.1 {} }} location -z look_at 0 focal_point 0 blur_samples 2 }}\n", word);
	job.options = {FileWord(job.scene, true), fmt::format("+W{}", width), fmt::format("+H{}", Rows), "+WT1"};
	const std::string log = folder.File("log-empty");
	const tiltcal::ProcessResult result = tiltcal::RunProcess({PilotCommand(job, folder), "", {}, "", log});
	CheckPilotRender(job, result, Contents(log));
	return result.cpu;
}

}

double DenoiseSecondsPerPixel(const std::string& povray, int width, const tiltcal::TemporaryFolder& folder)
{
	width = std::clamp(width, Narrow, Wide);
	const double without = EmptyPictureSeconds(povray, width, "", folder), with = EmptyPictureSeconds(povray, width, "denoise", folder);
	return std::max(0.0, with - without) / (double(width) * Rows);
}

}
