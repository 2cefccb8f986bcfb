// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/grid_map.h"

#include <tiltcal/photo.h>
#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>

namespace tiltcal
{

namespace
{

Vec2 Through(const cv::Matx33d& H, const Vec2& p)
{
	const cv::Vec3d q = H * cv::Vec3d(p.x(), p.y(), 1);
	return { q[0] / q[2], q[1] / q[2] };
}

}

GridMap::GridMap(const std::vector<Corner>& features)
{
	std::vector<cv::Point2d> places, pixels;
	for (const Corner& c : features)
	{
		places.emplace_back(c.column, c.row);
		pixels.emplace_back(c.x, c.y);
		middle += Vec2(c.x, c.y) / double(features.size());
	}
	pixels_from_places = cv::Matx33d(cv::findHomography(places, pixels));
	places_from_pixels = pixels_from_places.inv();
	for (const Corner& c : features)
		scale = std::max(scale, (Vec2(c.x, c.y) - middle).norm());
	order = features.size() >= 25 ? 3 : 2;
	const long n = long(features.size());
	Eigen::MatrixXd A(n, (order + 1) * (order + 2) / 2);
	Eigen::MatrixX2d b(n, 2);
	for (long k = 0; k < n; ++k)
	{
		const Corner& c = features[size_t(k)];
		const Vec2 straight = Through(pixels_from_places, Vec2(c.column, c.row));
		A.row(k) = Terms(straight).transpose();
		b.row(k) = (Vec2(c.x, c.y) - straight).transpose();
	}
	bend = A.colPivHouseholderQr().solve(b);
}

Eigen::VectorXd GridMap::Terms(const Vec2& pixel) const
{
	const Vec2 p = (pixel - middle) / scale;
	Eigen::VectorXd terms((order + 1) * (order + 2) / 2);
	terms.head<6>() << 1, p.x(), p.y(), p.x() * p.x(), p.x() * p.y(), p.y() * p.y();
	if (order == 3)
		terms.tail<4>() << p.x() * p.x() * p.x(), p.x() * p.x() * p.y(), p.x() * p.y() * p.y(), p.y() * p.y() * p.y();
	return terms;
}

Vec2 GridMap::Pixel(const Vec2& place) const
{
	const Vec2 straight = Through(pixels_from_places, place);
	return straight + bend.transpose() * Terms(straight);
}

Vec2 GridMap::Place(const Vec2& pixel) const
{
	// The bend is small and smooth: a few steps of fixed-point iteration.
	Vec2 straight = pixel;
	for (int k = 0; k < 6; ++k)
		straight = pixel - bend.transpose() * Terms(straight);
	return Through(places_from_pixels, straight);
}

Eigen::Matrix2d GridMap::Jacobian(const Vec2& place) const
{
	const double h = 1e-3;
	Eigen::Matrix2d J;
	J << (Pixel(place + Vec2(h, 0)) - Pixel(place - Vec2(h, 0))) / (2 * h), (Pixel(place + Vec2(0, h)) - Pixel(place - Vec2(0, h))) / (2 * h);
	return J;
}

}
