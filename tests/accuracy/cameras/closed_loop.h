// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From a simulated camera's photographs to the calibrator's answer, held against the truth.

#ifndef CLOSED_LOOP_H
#define CLOSED_LOOP_H

#include "camera_light.h"
#include "simulated_camera.h"

#include <tiltcal/calibrate.h>

#include <cmath>
#include <string>
#include <vector>

namespace cameras
{

/// One number, in its own standard deviations.
struct Deviation
{
	std::string name;
	double truth = 0, found = 0, sigma = 0;
	/// A sigma of 0 promises the truth.
	double InSigmas() const { return sigma > 0 ? (found - truth) / sigma : found == truth ? 0 : std::copysign(HUGE_VAL, found - truth); }
};

struct Answer
{
	std::string refusal;                 ///< empty: there is an answer
	tiltcal::Calibration calibration;
	std::vector<Deviation> deviations;
	std::vector<std::string> not_told;   ///< what the camera has and the answer leaves out, as not significant
	double tilt_error = 0;               ///< greatest length of a difference of tilt vectors, degrees
};

/// The photographs of a camera without what light brings, in linear light.
struct Negatives
{
	Camera camera;
	std::vector<std::vector<cv::Mat>> pictures;   ///< by state and photograph
};

Negatives Photograph(const Camera& camera, unsigned seed);

/// Develops into `folder`, measures and calibrates. `choice`: what the calibrator is asked.
Answer CloseTheLoop(const Negatives& negatives, const Light& light, unsigned seed, const std::string& folder, const tiltcal::CalibrateOptions& choice = {});

}

#endif
