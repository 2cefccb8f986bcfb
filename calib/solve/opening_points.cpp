// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/opening_points.h"

#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

std::vector<OpeningPoint> Rings()
{
	// Gauss's nodes of the square of the radius.
	const double nodes[] = { 0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0) };
	const int around = 9;
	std::vector<OpeningPoint> points;
	for (int ring = 0; ring < 2; ++ring)
		for (int k = 0; k < around; ++k)
		{
			const double a = 2 * M_PI * (k + 0.5 * ring) / around, radius = std::sqrt(nodes[ring]);
			points.push_back({ radius * std::cos(a), radius * std::sin(a), 0.5 / around });
		}
	return points;
}

/// A fine cover of the disc, each point with the one of OpeningPoints that stands for it, and the middles of these parts.
struct Cover
{
	struct Small { double x, y; size_t part; };
	std::vector<Small> all;
	std::vector<OpeningPoint> middle;   ///< weight: how many
};

Cover MakeCover()
{
	const int n = 400;
	const double golden = M_PI * (3 - std::sqrt(5.0));
	Cover cover;
	cover.middle.assign(OpeningPoints().size(), { 0, 0, 0 });
	for (int k = 0; k < n; ++k)
	{
		const double radius = std::sqrt((k + 0.5) / n), x = radius * std::cos(k * golden), y = radius * std::sin(k * golden);
		size_t part = 0;
		double least = std::numeric_limits<double>::max();
		for (size_t i = 0; i < OpeningPoints().size(); ++i)
			if (const double d = std::hypot(x - OpeningPoints()[i].x, y - OpeningPoints()[i].y); d < least)
			{
				least = d;
				part = i;
			}
		cover.all.push_back({ x, y, part });
		OpeningPoint& m = cover.middle[part];
		m = { m.x + x, m.y + y, m.weight + 1 };
	}
	for (OpeningPoint& m : cover.middle)
		m = { m.x / m.weight, m.y / m.weight, m.weight };
	return cover;
}

bool Passes(const OpeningView& view, const std::vector<tilt_lens::Rim>& rims, double x, double y)
{
	const tilt_lens::PupilRay<double> image = tilt_lens::RayToSensor(view.radius * x, view.radius * y, view.X, view.Y, view.depth);
	for (const tilt_lens::Rim& rim : rims)
	{
		double at_x, at_y;
		if (rim.distance > 0)
		{
			const tilt_lens::PupilRay<double> object = tilt_lens::ObjectSideRay(view.lens, image);
			at_x = object.x + rim.distance * object.slope_x;
			at_y = object.y + rim.distance * object.slope_y;
		}
		else
		{
			at_x = image.x + rim.distance * image.slope_x;
			at_y = image.y + rim.distance * image.slope_y;
		}
		if (std::hypot(at_x, at_y) > rim.radius)
			return false;
	}
	return true;
}

}

const std::vector<OpeningPoint>& OpeningPoints()
{
	static const std::vector<OpeningPoint> points = Rings();
	return points;
}

std::vector<OpeningPoint> OpeningThroughRims(const OpeningView& view, const std::vector<tilt_lens::Rim>& rims)
{
	if (rims.empty())
		return OpeningPoints();
	static const Cover cover = MakeCover();
	std::vector<OpeningPoint> left(OpeningPoints().size(), { 0, 0, 0 });
	for (const Cover::Small& small : cover.all)
		if (Passes(view, rims, small.x, small.y))
		{
			OpeningPoint& l = left[small.part];
			l = { l.x + small.x, l.y + small.y, l.weight + 1 };
		}
	std::vector<OpeningPoint> points;
	double sum = 0;
	for (size_t i = 0; i < left.size(); ++i)
		if (left[i].weight > 0)
		{
			const OpeningPoint &whole = OpeningPoints()[i], &m = cover.middle[i], &l = left[i];
			points.push_back({ whole.x + l.x / l.weight - m.x, whole.y + l.y / l.weight - m.y, whole.weight * l.weight / m.weight });
			sum += points.back().weight;
		}
	if (points.empty())
		return OpeningPoints();
	for (OpeningPoint& p : points)
		p.weight /= sum;
	return points;
}

}
