// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What of a difference between two pictures a smooth movement of the picture, or a smooth change of its sharpness, explains.

#ifndef PAPER_SMOOTH_FIT_H
#define PAPER_SMOOTH_FIT_H

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <array>

namespace paper
{

struct Displacement
{
	Eigen::VectorXd field;    ///< 10 terms for x, 10 for y
	double rms_px = 0;        ///< its length, over the pixels with edges
	double mean_x_px = 0;     ///< its mean there: positive: a is farther right than b
	double mean_y_px = 0;     ///< positive: a is farther down
	int rounds = 0;           ///< of Gauss and Newton until nothing moved by 0.002 px, at most 20
};

/// The polynomial field of third order (1, x, y, xx, ... with x, y from -1 to 1) that moves picture b onto a, both CV_32FC1 of one
/// size: least squares of a(x) - b(x - D(x)) where both have edges, Huber's weights, bounded at 1.5 sigma of these pixels. Both are
/// smoothed alike first, by a Gaussian of 1 px, so that grain is not taken for edges.
Displacement FitDisplacement(const cv::Mat& a, const cv::Mat& b);

/// x and y of the field at a pixel of a picture of `size`.
std::array<double, 2> DisplacementAt(const Displacement& displacement, int column, int row, cv::Size size);

/// A picture moved by the field. Cubic interpolation; it smooths grain a little all the same.
cv::Mat Move(const cv::Mat& picture, const Displacement& displacement);

/// The polynomial of third order c (10 terms) for which b + c (b blurred by a Gaussian of 1 px - b) comes nearest to a where both have
/// edges; Huber's weights. To first order this is a change of the blur that varies smoothly over the picture; c < 0 sharpens.
Eigen::VectorXd FitSharpness(const cv::Mat& a, const cv::Mat& b);

/// picture + c (picture blurred by a Gaussian of 1 px - picture), c held within -1 and 1.
cv::Mat ChangeSharpness(const cv::Mat& picture, const Eigen::VectorXd& c);

}

#endif
