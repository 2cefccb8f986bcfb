// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/beside_real_lens.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tiltcal
{

namespace
{

/// `told` widened by the farthest of `others`; a focus at infinity is no distance to compare.
void Widen(const std::vector<double>& others, Estimate& told)
{
	double farthest = 0;
	for (const double other : others)
		if (std::isfinite(other) && std::isfinite(told.value))
			farthest = std::max(farthest, std::abs(other - told.value));
	told.sigma = std::hypot(told.sigma, farthest);
}

template<typename Number>
std::vector<double> OfEach(const std::vector<const RealLens*>& lenses, Number number)
{
	std::vector<double> numbers;
	for (const RealLens* lens : lenses)
		numbers.push_back(number(*lens));
	return numbers;
}

}

void WidenByRealLens(Calibration& c)
{
	if (!c.real_lens || !c.real_lens->used)
		return;
	std::vector<const RealLens*> lenses{ &*c.real_lens };
	if (c.scene_lens && c.scene_lens->used)
		lenses.push_back(&*c.scene_lens);
	const std::vector<double> f = OfEach(lenses, [](const RealLens& l) { return l.focal_length_mm.value; });
	const auto focus = [&](size_t s) { return OfEach(lenses, [s](const RealLens& l) { return l.states[s].best_focus_mm; }); };
	for (Solution* told : { &c.solution, &c.render })
	{
		Widen(f, told->focal_length);
		Widen(OfEach(lenses, [](const RealLens& l) { return l.opening_on_axis_mm.value; }), told->aperture_diameter);
		Widen(OfEach(lenses, [](const RealLens& l) { return l.states[0].image_distance_mm.value / l.pupil_magnification.value; }), told->w_mm);
		Widen(focus(0), told->focus_distance);
		for (size_t s = 0; s < told->states.size(); ++s)
		{
			Widen(f, told->states[s].focal_length);
			Widen(focus(s), told->states[s].focus_distance);
		}
	}
}

}
