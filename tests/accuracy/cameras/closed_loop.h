// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From a simulated camera's photographs to the calibrator's answer, held against the truth.

#ifndef CLOSED_LOOP_H
#define CLOSED_LOOP_H

#include "camera_light.h"
#include "simulated_camera.h"

#include <tiltcal/calibrate.h>

#include <string>
#include <vector>

namespace cameras
{

/// One number, in its own standard deviations.
struct Deviation
{
	std::string name;
	double truth = 0, found = 0, sigma = 0;
	/// A sigma of 0 promises the truth, and one that is no number promises nothing that could be kept.
	double InSigmas() const;
};

struct Answer
{
	std::string refusal;                 ///< empty: there is an answer
	bool photographed = true;            ///< false: no board could be photographed, `refusal` says why
	tiltcal::Calibration calibration;
	std::vector<Deviation> deviations;
	std::vector<std::string> not_told;   ///< numbers that the calibration did not find, with why: they count neither as inside nor as outside
	double tilt_error = 0;               ///< greatest length of a difference of tilt vectors, degrees
};

/// The photographs of a camera without what light brings, in linear light.
struct Negatives
{
	Camera camera;
	std::vector<std::vector<cv::Mat>> pictures;   ///< by state and photograph
	std::vector<std::vector<cv::Mat>> stopped;    ///< the same at Camera::stopped_to, or none
};

Negatives Photograph(const Camera& camera, unsigned seed);

/// Develops into `folder`: the files by state, as the calibrator takes them. `seed`: of the noise.
std::vector<tiltcal::StateFiles> DevelopAll(const Negatives& negatives, const Light& light, unsigned seed, const std::string& folder);

/// Measures these files and calibrates. `measure`: but for the transfer, which is the light's.
Answer CalibrateFiles(const Negatives& negatives, const Light& light, const std::vector<tiltcal::StateFiles>& files, tiltcal::MeasureOptions measure = {}, const tiltcal::CalibrateOptions& choice = {});

/// Develops into `folder`, measures and calibrates. `choice`: what the calibrator is asked.
Answer CloseTheLoop(const Negatives& negatives, const Light& light, unsigned seed, const std::string& folder, const tiltcal::CalibrateOptions& choice = {});

}

#endif
