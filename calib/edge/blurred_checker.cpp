// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/blurred_checker.h"

#include "lens/angles.h"
#include <algorithm>
#include <cmath>
#include <iterator>

namespace tiltcal
{

namespace
{

using tilt_lens::Pi;

/// Length of the part of the chord s.n1 = t1 of the unit disc in s.n2 > t2.
double ChordLength(double t1, double t2, double cosine, double sine)
{
	if (std::abs(t1) >= 1)
		return 0;
	const double half = std::sqrt((1 - t1) * (1 + t1));
	return std::clamp(half - (t2 - t1 * cosine) / sine, 0.0, 2 * half);
}

/// Half-plane s.n > t: its share of the unit disc.
double HalfShare(double t)
{
	if (std::abs(t) >= 1)
		return t < 0 ? 1 : 0;
	return (std::acos(t) - t * std::sqrt((1 - t) * (1 + t))) / Pi;
}

/// - d HalfShare / dt.
double HalfSlope(double t)
{
	return std::abs(t) >= 1 ? 0 : 2 * std::sqrt((1 - t) * (1 + t)) / Pi;
}

}

Wedge WedgeShare(double t1, double t2, double angle)
{
	// Area = 1/2 (arc - t1 L1 - t2 L2): Gauss's theorem for the field s, which is t on the chords and 1 on the rim.
	const double cosine = std::cos(angle), sine = std::max(std::sin(angle), 1e-6);
	const double L1 = ChordLength(t1, t2, cosine, sine), L2 = ChordLength(t2, t1, cosine, sine);
	const double a1 = std::acos(std::clamp(t1, -1.0, 1.0)), a2 = std::acos(std::clamp(t2, -1.0, 1.0));
	const double arc = std::max(0.0, std::min(a1, angle + a2) - std::max(-a1, angle - a2))
		+ std::max(0.0, std::min(a1, angle + a2 - 2 * Pi) - std::max(-a1, angle - a2 - 2 * Pi));
	return { 0.5 * (arc - t1 * L1 - t2 * L2) / Pi, -L1 / Pi, -L2 / Pi };
}

BlurredChecker::BlurredChecker(std::vector<CheckerLine> across_lines, size_t lines_before, std::vector<CheckerLine> along_lines, size_t lines_start)
	: across(std::move(across_lines)), along(std::move(along_lines)), before(lines_before), start(lines_start)
{
	// The edge itself among the lines parallel to it; At() puts it where the parameters say.
	across.insert(across.begin() + static_cast<long>(before), CheckerLine());
	for (const CheckerLine& a : across)
		for (const CheckerLine& b : along)
			angles.push_back(std::acos(std::clamp(a.nx * b.nx + a.ns * b.ns, -1.0, 1.0)));
}

namespace
{

/// A line that the blur reaches: which, where in radii of the blur from the sample, that by the radius, and the sign of its step.
struct Seen
{
	size_t index;
	double t, dt, sign;
};

/// The square wave across lines of one direction: base + sum of sign * (2 half-plane) over those that the blur reaches.
struct Wave
{
	double base;
	Seen seen[8];
	size_t count = 0;

	/// +1 just beyond the line `reference`. `distance` of each from the sample; R: half width of the blur with the pixel's, dR by the radius.
	template<typename Distance>
	Wave(const std::vector<CheckerLine>& lines, size_t reference, double R, double dR, const Distance& distance)
	{
		const auto sign_of = [&](size_t k) { return (k + reference) % 2 == 0 ? 1.0 : -1.0; };
		base = -sign_of(0);
		for (size_t k = 0; k < lines.size() && count < std::size(seen); ++k)
		{
			const double own = std::max(R + lines[k].grow, 0.5), t = -distance(k) / own;
			if (t <= -1)
				base += 2 * sign_of(k);
			else if (t < 1)
				seen[count++] = { k, t, -t / own * dR, sign_of(k) };
		}
	}
};

}

EdgeResponse BlurredChecker::At(const EdgeSample& sample, double offset, double slope, double radius) const
{
	// Variances add: the pixel's is 1/12 in each direction, the disc's R^2/4.
	const double R = std::sqrt(radius * radius + 1.0 / 3);
	const double dR = radius / R;
	const auto beside = [&](const CheckerLine& l) { return l.nx * sample.x + l.ns * sample.s - l.at; };
	const Wave u(across, before, R, dR, [&](size_t k) { return k == before ? sample.x - offset - slope * sample.s : beside(across[k]); });
	// +1 between start and end.
	const Wave v(along, start + 1, R, dR, [&](size_t k) { return beside(along[k]); });

	double mean = u.base * v.base, d_radius = 0, d_own = 0;
	for (size_t i = 0; i < u.count; ++i)
	{
		const double weight = 2 * u.seen[i].sign * v.base, slope_t = -weight * HalfSlope(u.seen[i].t);
		mean += weight * HalfShare(u.seen[i].t);
		d_radius += slope_t * u.seen[i].dt;
		if (u.seen[i].index == before)
			d_own += slope_t;
	}
	for (size_t j = 0; j < v.count; ++j)
	{
		const double weight = 2 * v.seen[j].sign * u.base;
		mean += weight * HalfShare(v.seen[j].t);
		d_radius -= weight * HalfSlope(v.seen[j].t) * v.seen[j].dt;
	}
	for (size_t i = 0; i < u.count; ++i)
		for (size_t j = 0; j < v.count; ++j)
		{
			const Wedge w = WedgeShare(u.seen[i].t, v.seen[j].t, angles[u.seen[i].index * along.size() + v.seen[j].index]);
			const double weight = 4 * u.seen[i].sign * v.seen[j].sign;
			mean += weight * w.share;
			d_radius += weight * (w.d_t1 * u.seen[i].dt + w.d_t2 * v.seen[j].dt);
			if (u.seen[i].index == before)
				d_own += weight * w.d_t1;
		}
	// t = -(x - ..)/R, so d/dx is -1/R of d/dt.
	return { 0.5 * (1 + mean), -0.5 * d_own / R, 0.5 * d_radius };
}

}
