// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What of a difference between two pictures a smooth movement of the picture, or a smooth change of its sharpness, explains.

#ifndef PAPER_SMOOTH_FIT_H
#define PAPER_SMOOTH_FIT_H

#include <opencv2/core.hpp>

namespace paper
{

struct Displacement
{
	cv::Mat picture;          ///< b, moved
	double rms_px = 0;        ///< length of the displacement, over the pixels with edges
	double mean_x_px = 0;     ///< its mean there: positive: a is farther right than b
	double mean_y_px = 0;     ///< positive: a is farther down
	int rounds = 0;           ///< of Gauss and Newton until nothing moved by 0.002 px, at most 20
};

/// The polynomial field of third order (10 terms each for x and y) that moves picture b onto a, both CV_32FC1 of one size:
/// least squares of a(x) - b(x - D(x)), Huber's weights, bounded at 1.5 sigma of the pixels with edges.
Displacement FitDisplacement(const cv::Mat& a, const cv::Mat& b);

/// b + c (b blurred by a Gaussian of 1 px - b), c the polynomial of third order that brings it nearest to a; Huber's weights.
/// To first order this is a change of the blur that varies smoothly over the picture; c < 0 sharpens.
cv::Mat FitSharpness(const cv::Mat& a, const cv::Mat& b);

}

#endif
