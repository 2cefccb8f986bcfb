// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/tone_exponent.h"

#include "edge/edge_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

const double RADIUS = 20;   // px: a pixel is little beside it
const double MOST = 4;      // of an exponent, and of what it is divided by

}

double ShiftOfExponent(double exponent, double dark, double reach)
{
	std::vector<EdgeSample> samples;
	const double most = reach * RADIUS;
	for (double x = -most; x <= most; x += 0.5)
		for (const double s : { -1.0, 0.0, 1.0 })
			samples.push_back({ x, s, std::pow(dark + (1 - dark) * PixelEdgeResponse(x, RADIUS, 1, 0).value, exponent) });
	const EdgeFit fit = FitEdge(samples, LoneEdge(1, 0), {}, RADIUS);
	return fit.valid ? fit.offset / RADIUS : std::numeric_limits<double>::quiet_NaN();
}

double ExponentOfShift(double shift, double dark_value, double reach)
{
	const auto excess = [&](double log_exponent)
	{
		const double exponent = std::exp(log_exponent);
		return ShiftOfExponent(exponent, std::pow(dark_value, 1 / exponent), reach) - shift;
	};
	double low = -std::log(MOST), high = std::log(MOST);
	if (!(excess(low) <= 0 && excess(high) >= 0))
		return std::numeric_limits<double>::quiet_NaN();
	for (int i = 0; i < 20; ++i)
	{
		const double middle = 0.5 * (low + high);
		(excess(middle) > 0 ? high : low) = middle;
	}
	return std::exp(0.5 * (low + high));
}

}
