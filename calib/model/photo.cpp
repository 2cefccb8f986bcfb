// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/photo.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

BlurRatios RatiosOf(const Photo& photo)
{
	std::vector<double> ratios;
	for (const Edge& e : photo.edges)
		if (const double ratio = e.BlurRatio(); std::isfinite(ratio))   // an edge of no length has none
			ratios.push_back(ratio);
	if (ratios.empty())
		return {};
	std::sort(ratios.begin(), ratios.end());
	return { ratios.front(), ratios[ratios.size() / 2], ratios.back() };
}

std::string RatioText(const Photo& photo)
{
	const BlurRatios r = RatiosOf(photo);
	const bool circles = !photo.edges.empty() && photo.edges.front().arc >= 0;
	return fmt::format("blur radius {:.2f} to {:.2f} of a {}, median {:.2f}", r.least, r.most, circles ? "circle's radius" : "square", r.median);
}

std::string CountText(const Photo& photo)
{
	if (!photo.edges.empty() && photo.edges.front().arc >= 0)
		return fmt::format("{} {} circles, {} arcs", photo.corners.size(), photo.bright_circles ? "white" : "dark", photo.edges.size());
	return fmt::format("{} corners, {} edges", photo.corners.size(), photo.edges.size());
}

}
