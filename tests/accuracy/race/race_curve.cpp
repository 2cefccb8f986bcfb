// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

void RacePoint::Add(double cpu, double start_up, double share)
{
	const double net = NetTime(cpu, start_up);
	if (times.empty() || net * share < Time())
		at_floor = net > cpu - start_up;
	times.push_back(net * share);
}

double RacePoint::Time() const
{
	return *std::min_element(times.begin(), times.end());
}

double RacePoint::Spread() const
{
	return *std::max_element(times.begin(), times.end()) / Time() - 1;
}

double RacePoint::Rms() const
{
	return std::min({rms_truth, rms_shifted, rms_limit});
}

double NetTime(double cpu, double start_up)
{
	return std::max(cpu - start_up, start_up / 3);
}

std::vector<CurvePoint> Hull(std::vector<CurvePoint> points)
{
	std::sort(points.begin(), points.end(),
		[](const CurvePoint& a, const CurvePoint& b) { return a.time != b.time ? a.time < b.time : a.error < b.error; });
	std::vector<CurvePoint> hull;
	for (const CurvePoint& point : points)
	{
		if (!hull.empty() && point.error >= hull.back().error)
			continue;
		const auto above = [&] {
			const CurvePoint &a = hull[hull.size() - 2], &b = hull.back();
			const double ab = std::log(b.error / a.error) / std::log(b.time / a.time);
			return ab >= std::log(point.error / a.error) / std::log(point.time / a.time);
		};
		while (hull.size() >= 2 && above())
			hull.pop_back();
		hull.push_back(point);
	}
	return hull;
}

static double Slope(const CurvePoint& a, const CurvePoint& b)
{
	return std::log(b.error / a.error) / std::log(b.time / a.time);
}

TimeAt TimeToReach(const std::vector<CurvePoint>& hull, double error, bool generous)
{
	if (hull.empty())
		throw std::runtime_error("a curve without points");
	if (error >= hull.front().error)
		return {hull.front().time, true, hull.front().at_floor};
	for (std::size_t i = 1; i < hull.size(); ++i)
		if (error >= hull[i].error)
			return {hull[i - 1].time * std::exp(std::log(error / hull[i - 1].error) / Slope(hull[i - 1], hull[i])), true, hull[i - 1].at_floor || hull[i].at_floor};
	double slope = -0.5;
	if (hull.size() >= 2)
	{
		const double last = Slope(hull[hull.size() - 2], hull.back());
		slope = generous ? std::min(last, slope) : std::max(last, slope);
	}
	return {hull.back().time * std::exp(std::log(error / hull.back().error) / slope), false, hull.back().at_floor};
}
