// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The board's plane in a picture: (column, row) to pixels, smooth and near the measured features.

#ifndef TILTCAL_GRID_MAP_H
#define TILTCAL_GRID_MAP_H

#include <tiltcal/photo.h>
#include "measure/corner_grid.h"

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <vector>

namespace tiltcal
{

/// A homography, and on top of it a polynomial of the pixel's place that takes up the lens's distortion: cubic from 25 features
/// on, else quadratic. Least squares over all features.
class GridMap
{
public:
	explicit GridMap(const std::vector<Corner>& features);

	Vec2 Pixel(const Vec2& place) const;

	/// Inverse of Pixel.
	Vec2 Place(const Vec2& pixel) const;

	/// d pixel / d place.
	Eigen::Matrix2d Jacobian(const Vec2& place) const;

private:
	Eigen::VectorXd Terms(const Vec2& pixel) const;

	cv::Matx33d pixels_from_places, places_from_pixels;
	Vec2 middle{ 0, 0 };
	double scale = 1;
	int order = 0;
	Eigen::MatrixX2d bend;
};

}

#endif
