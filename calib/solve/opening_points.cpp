// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/opening_points.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

std::vector<OpeningPoint> MakeRings(Rings rings)
{
	// Gauss's nodes and weights of the square of the radius, between 0 and 1 (Abramowitz and Stegun, 25.4.30).
	struct Node { double at, weight; };
	const std::vector<Node> few{ { 0.5 - 0.5 / std::sqrt(3.0), 0.5 }, { 0.5 + 0.5 / std::sqrt(3.0), 0.5 } };
	const double inner = 0.5 * 0.339981043584856, outer = 0.5 * 0.861136311594053, heavy = 0.5 * 0.652145154862546, light = 0.5 * 0.347854845137454;
	const std::vector<Node> fine{ { 0.5 - outer, light }, { 0.5 - inner, heavy }, { 0.5 + inner, heavy }, { 0.5 + outer, light } };
	const int around = 9;
	std::vector<OpeningPoint> points;
	double turn = 0;
	for (const Node& node : rings == FEW ? few : fine)
	{
		for (int k = 0; k < around; ++k)
		{
			const double a = 2 * M_PI * (k + turn) / around, radius = std::sqrt(node.at);
			points.push_back({ radius * std::cos(a), radius * std::sin(a), node.weight / around });
		}
		turn += 0.5;
	}
	return points;
}

/// Which of OpeningPoints stands for each point of the cover, and the middles of these parts.
struct Parts
{
	std::vector<size_t> of;
	std::vector<OpeningPoint> middle;   ///< weight: how many
};

Parts MakeParts(const std::vector<OpeningPoint>& points)
{
	Parts parts;
	parts.middle.assign(points.size(), { 0, 0, 0 });
	for (const auto& [x, y] : OpeningCover())
	{
		size_t nearest = 0;
		double least = std::numeric_limits<double>::max();
		for (size_t i = 0; i < points.size(); ++i)
			if (const double d = std::hypot(x - points[i].x, y - points[i].y); d < least)
			{
				least = d;
				nearest = i;
			}
		parts.of.push_back(nearest);
		OpeningPoint& m = parts.middle[nearest];
		m = { m.x + x, m.y + y, m.weight + 1 };
	}
	for (OpeningPoint& m : parts.middle)
		m = { m.x / m.weight, m.y / m.weight, m.weight };
	return parts;
}

const Parts& PartsOf(Rings rings)
{
	static const Parts few = MakeParts(OpeningPoints(FEW)), fine = MakeParts(OpeningPoints(FINE));
	return rings == FEW ? few : fine;
}

/// First and second moments of points with weights.
struct Moments
{
	double weight = 0;
	Eigen::Vector2d sum = Eigen::Vector2d::Zero();
	Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();

	void Add(double x, double y, double w)
	{
		const Eigen::Vector2d p(x, y);
		weight += w;
		sum += w * p;
		squares += w * p * p.transpose();
	}
	Eigen::Vector2d Mean() const { return sum / weight; }
	Eigen::Matrix2d Covariance() const { return squares / weight - Mean() * Mean().transpose(); }
};

Moments MomentsOf(const std::vector<OpeningPoint>& points)
{
	Moments m;
	for (const OpeningPoint& p : points)
		m.Add(p.x, p.y, p.weight);
	return m;
}

Moments MomentsOfCover()
{
	Moments m;
	for (const auto& [x, y] : OpeningCover())
		m.Add(x, y, 1);
	return m;
}

/// Moves points to the middle and the covariance of the light that they stand for: few points lie too near to each other where a rim cuts through their parts,
/// and the aperture that fits a blur grows by as much. Points on one line stay as they are.
void MoveTo(const Moments& light, std::vector<OpeningPoint>& points)
{
	// What the cover itself differs by from a disc, of covariance 1/4, is taken off.
	static const Moments cover = MomentsOfCover();
	static const Eigen::Matrix2d to_disc = 0.5 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(cover.Covariance()).operatorInverseSqrt();
	const Moments now = MomentsOf(points);
	const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> from(now.Covariance()), to(to_disc * light.Covariance() * to_disc);
	const double thinnest = 1e-4;
	if (from.eigenvalues()[0] < thinnest || to.eigenvalues()[0] < thinnest)
		return;
	const Eigen::Matrix2d stretch = to.operatorSqrt() * from.operatorInverseSqrt();
	for (OpeningPoint& p : points)
	{
		const Eigen::Vector2d moved = light.Mean() - cover.Mean() + stretch * (Eigen::Vector2d(p.x, p.y) - now.Mean());
		p.x = moved.x();
		p.y = moved.y();
	}
}

std::vector<std::array<double, 2>> MakeCover()
{
	const double golden = M_PI * (3 - std::sqrt(5.0));
	std::vector<std::array<double, 2>> cover;
	for (int k = 0; k < COVER; ++k)
	{
		const double radius = std::sqrt((k + 0.5) / COVER);
		cover.push_back({ radius * std::cos(k * golden), radius * std::sin(k * golden) });
	}
	return cover;
}

}

const std::vector<OpeningPoint>& OpeningPoints(Rings rings)
{
	static const std::vector<OpeningPoint> few = MakeRings(FEW), fine = MakeRings(FINE);
	return rings == FEW ? few : fine;
}

const std::vector<std::array<double, 2>>& OpeningCover()
{
	static const std::vector<std::array<double, 2>> cover = MakeCover();
	return cover;
}

double WidthAtRim(const OpeningView& view, double distance)
{
	const double at_pupil = std::sqrt(M_PI / COVER) * view.radius;
	return distance > 0 ? at_pupil / view.lens.pupil_magnification : at_pupil * std::max(1 + distance / view.depth, 0.05);
}

double LightOfPoint(const OpeningView& view, double x, double y)
{
	const double dx = view.radius * x - view.X, dy = view.radius * y - view.Y, squared = dx * dx + dy * dy + view.depth * view.depth;
	const double middle = view.X * view.X + view.Y * view.Y + view.depth * view.depth;
	return middle * middle / (squared * squared);
}

OpeningRays::OpeningRays(const OpeningView& of) : view(of)
{
	for (const auto& [x, y] : OpeningCover())
	{
		image.push_back(tilt_lens::RayToSensor(view.radius * x, view.radius * y, view.X, view.Y, view.depth));
		object.push_back(tilt_lens::ObjectSideRay(view.lens, image.back()));
	}
}

std::vector<OpeningPoint> OpeningRays::Through(const std::vector<tilt_lens::Rim>& rims) const
{
	const std::vector<OpeningPoint>& all = OpeningPoints(view.rings);
	const Parts& parts = PartsOf(view.rings);
	std::vector<double> width;
	for (const tilt_lens::Rim& rim : rims)
		width.push_back(WidthAtRim(view, rim.distance));
	std::vector<OpeningPoint> left(all.size(), { 0, 0, 0 });
	Moments light;
	for (size_t k = 0; k < image.size(); ++k)
	{
		double open = 1;
		for (size_t i = 0; i < rims.size() && open > 0; ++i)
			open *= PartWithin(HeightAtRim(object[k], image[k], rims[i].distance), rims[i].radius, width[i]);
		const auto& [x, y] = OpeningCover()[k];
		OpeningPoint& l = left[parts.of[k]];
		l = { l.x + open * x, l.y + open * y, l.weight + open };
		light.Add(x, y, open);
	}
	std::vector<OpeningPoint> points;
	double sum = 0;
	for (size_t i = 0; i < left.size(); ++i)
		if (left[i].weight > 0)
		{
			const OpeningPoint &whole = all[i], &m = parts.middle[i], &l = left[i];
			points.push_back({ whole.x + l.x / l.weight - m.x, whole.y + l.y / l.weight - m.y, whole.weight * l.weight / m.weight });
			sum += points.back().weight;
		}
	if (points.empty())
		return all;
	// Where nothing is cut the points stand for all of the light as they are.
	if (light.weight < COVER)
		MoveTo(light, points);
	for (OpeningPoint& p : points)
		p.weight /= sum;
	return points;
}

std::vector<OpeningPoint> OpeningThroughRims(const OpeningView& view, const std::vector<tilt_lens::Rim>& rims)
{
	return rims.empty() ? OpeningPoints(view.rings) : OpeningRays(view).Through(rims);
}

}
