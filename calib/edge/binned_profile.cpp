// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/binned_profile.h"

#include <tiltcal/photo.h>
#include <algorithm>
#include <cmath>
#include <map>

namespace tiltcal
{

std::vector<ProfileBin> BinnedProfile(const std::vector<EdgeSample>& samples, const EdgeFit& fit)
{
	const double width = std::clamp(fit.radius / 16, 0.1, 0.5);
	std::map<long, ProfileBin> bins;
	for (const EdgeSample& s : samples)
	{
		const double x = s.x - fit.offset - fit.slope * s.s;
		const double shade = 1 + fit.shading.x * s.x + fit.shading.s * s.s;
		ProfileBin& bin = bins[std::lround(x / width)];
		bin.x += x;
		bin.value += s.value / shade;
		bin.count += 1;
	}
	std::vector<ProfileBin> profile;
	for (const auto& [place, bin] : bins)
		profile.push_back({ static_cast<float>(bin.x / bin.count), static_cast<float>(bin.value / bin.count), bin.count });
	return profile;
}

}
