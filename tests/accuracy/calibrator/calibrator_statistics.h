// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef CALIBRATOR_STATISTICS_H
#define CALIBRATOR_STATISTICS_H

#include "calibrator_runs.h"

#include <array>
#include <string>
#include <vector>

namespace calibrator_cost
{

/// Found minus true tilt as a vector: (right, up) components in degrees, from lens_tilt and its
/// direction; a wrong direction counts as much as a wrong tilt.
using TiltError = std::array<double, 2>;
TiltError ErrorOf(double lens_tilt, double tilt_direction, double true_tilt);

/// Errors of one effort and model.
struct Row
{
	std::string data, vary, model;
	Effort effort;
	int draws = 0, answers = 0;   ///< the rest was refused
	double rms = 0;               ///< length of the error, over draws and states, degrees
	double bias = 0;              ///< length of the mean error, RMS over the states, degrees
	double scatter = -1;          ///< standard deviation about the mean, degrees; -1: unknown
	Preparation preparation;      ///< CPU seconds, mean of a draw
	double solving = 0;

	double Seconds() const { return preparation.detection + preparation.measuring + solving; }
};

/// `errors`: draw, then tilted state. Fills answers, rms, bias and scatter.
/// Draws that overlap (`share` of what exists is in each) scatter less than new photographs
/// would: the variance is divided by 1 - share, as for samples without replacement, and
/// `existing` (0: without end) is the number of different draws. With share = 1 scatter is left.
void Summarise(const std::vector<std::vector<TiltError>>& errors, double share, double existing, Row& row);

}

#endif
