// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The smooth factor between two pictures of the same scene: exposure and vignetting.

#ifndef TILTCAL_SHADING_H
#define TILTCAL_SHADING_H

#include <opencv2/core.hpp>

#include <vector>

namespace tiltcal
{

/// Sum of coefficients[k] x^i y^j over all i + j <= order, ordered by i + j, then by j,
/// with x, y in [-1, 1] from the picture's left to right and top to bottom pixel centre.
struct Shading
{
	int order = 0;
	std::vector<double> coefficients{ 1.0 };

	/// The factor at pixel (column, row) of a picture of `size`.
	double At(double column, double row, cv::Size size) const;
};

/// Polynomial S of `order` (0: one gain) with A = S B, fitted to the ratio A/B over the
/// whole picture: both (CV_32FC1, linear, same size) are shrunk to about 150 pixels
/// across, and Tukey's biweight leaves out what does not match (edges that are shifted
/// or blurred differently). Clipped (above 0.99) and almost black pixels do not count.
/// Throws Refused when fewer than 10 pixels per coefficient are left.
Shading FitShading(const cv::Mat& a, const cv::Mat& b, int order);

/// b times the shading.
cv::Mat ApplyShading(const cv::Mat& b, const Shading& shading);

}

#endif
