// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What one run of paper.cmake leaves in its folder, and where.
//
//   demo/                    demo.cmake's: calibration/, render-STATE.exr, profiles/STATE-MATCH.json
//   models/MODEL/            calibrations of the same photographs by other models
//   noise/STATE.SUFFIX       photographs of the mean of demo's and seed1's renders: noise, 8 bit, compression and nothing else
//   seed1/STATE.exr          the demo's renders with another seed
//   curve/SAMPLES-SEED.exr   rows 600 to 719 of the state plus5, and their logs
//   closed/                  photos/ of boards rendered, calibration/ of these, STATE.exr through it, profiles/
//   effects/                 effect-shares.cmake's: SET/STATE.json
//   paper-method/            the boxes through the paper's calibration: STATE-gain.json
//   steps.txt                seconds and name of every step
//   results.json, difference-STATE.png, noise-STATE.png, report.html   what comes of it

#ifndef PAPER_RUN_H
#define PAPER_RUN_H

#include <string>
#include <vector>

namespace paper
{

const char* const STATES[] = { "untilted", "plus5", "minus5" };

/// The first row that the curve's renders have, and the one after the last.
const int CURVE_ROWS[] = { 600, 720 };

struct Run
{
	std::string out;
	std::string photos;
	std::string camera;
	std::string suffix = "jpg";
	int samples = 0;
	int board_samples = 0;
	int effect_samples = 0;
	std::vector<int> curve;
};

}

#endif
