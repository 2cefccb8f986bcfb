// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/blurred_checker.h"

#include "lens/angles.h"
#include <algorithm>
#include <cmath>

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

EdgeResponse BlurredChecker::At(const EdgeSample& sample, double offset, double slope, double radius) const
{
	// Variances add: the pixel's is 1/12 in each direction, the disc's R^2/4.
	const double R = std::sqrt(radius * radius + 1.0 / 3);
	const double dR = radius / R;
	const auto place = [&](const CheckerLine& l, double distance, double& t, double& dt)
	{
		const double own = std::max(R + l.grow, 0.5);
		t = -distance / own;
		dt = -t / own * dR;   // by `radius`
	};
	struct Seen { size_t index; double t, dt, sign; };
	Seen u[8], v[8];
	size_t nu = 0, nv = 0;
	// Each square wave is base + sum of sign * (2 half-plane); +1 just beyond the edge, +1 between start and end.
	const auto sign_of = [](size_t k, size_t reference) { return (k + reference) % 2 == 0 ? 1.0 : -1.0; };
	double base_u = -sign_of(0, before), base_v = -sign_of(0, start + 1);
	for (size_t k = 0; k < across.size() && nu < 8; ++k)
	{
		const CheckerLine& l = across[k];
		const double distance = k == before ? sample.x - offset - slope * sample.s : l.nx * sample.x + l.ns * sample.s - l.at;
		double t, dt;
		place(l, distance, t, dt);
		if (t <= -1)
			base_u += 2 * sign_of(k, before);
		else if (t < 1)
			u[nu++] = { k, t, dt, sign_of(k, before) };
	}
	for (size_t k = 0; k < along.size() && nv < 8; ++k)
	{
		const CheckerLine& l = along[k];
		double t, dt;
		place(l, l.nx * sample.x + l.ns * sample.s - l.at, t, dt);
		if (t <= -1)
			base_v += 2 * sign_of(k, start + 1);
		else if (t < 1)
			v[nv++] = { k, t, dt, sign_of(k, start + 1) };
	}

	double mean = base_u * base_v, d_radius = 0, d_own = 0;
	for (size_t i = 0; i < nu; ++i)
	{
		const double weight = 2 * u[i].sign * base_v, slope_t = -weight * HalfSlope(u[i].t);
		mean += weight * HalfShare(u[i].t);
		d_radius += slope_t * u[i].dt;
		if (u[i].index == before)
			d_own += slope_t;
	}
	for (size_t j = 0; j < nv; ++j)
	{
		const double weight = 2 * v[j].sign * base_u;
		mean += weight * HalfShare(v[j].t);
		d_radius -= weight * HalfSlope(v[j].t) * v[j].dt;
	}
	for (size_t i = 0; i < nu; ++i)
		for (size_t j = 0; j < nv; ++j)
		{
			const Wedge w = WedgeShare(u[i].t, v[j].t, angles[u[i].index * along.size() + v[j].index]);
			const double weight = 4 * u[i].sign * v[j].sign;
			mean += weight * w.share;
			d_radius += weight * (w.d_t1 * u[i].dt + w.d_t2 * v[j].dt);
			if (u[i].index == before)
				d_own += weight * w.d_t1;
		}
	// t = -(x - ..)/R, so d/dx is -1/R of d/dt.
	return { 0.5 * (1 + mean), -0.5 * d_own / R, 0.5 * d_radius };
}

}
