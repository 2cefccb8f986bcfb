// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/check_focus.h"

#include "model/lens_model.h"
#include "solve/solve_joint.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace tiltcal
{

namespace
{

/// Ten for each of a plane's three numbers.
const size_t LEAST_EDGES = 30;

/// The solution's planes, each free of the others, as the rigid model's are not.
Unknowns FreePlanes(const Solution& s, LensModel model)
{
	Unknowns x = UnknownsOf(s);
	for (size_t k = 0; k < s.states.size(); ++k)
		x.state[k] = StateOfPlane(model, s.states[k].q, s.w_mm.value);
	x.untilted_free = true;
	return x;
}

bool IsOdd(const Calibration& c, size_t state, size_t photo)
{
	return std::any_of(c.photographs.begin(), c.photographs.end(), [&](const PhotographCheck& p) { return p.state == state && p.photo == photo && p.odd_blur; });
}

/// Sum of squares with the plane of `x`; where the fit to these edges has an answer, `x` has its plane then.
double Squares(const Calibration& c, LensModel model, size_t state, const std::vector<Observation>& edges, Unknowns& x)
{
	const std::vector<Prior> none;
	const BlurFit fit{ model, edges, c.solution.w_mm.value, 0, none, c.task.stops };
	const auto squares = [&](const Unknowns& of)
	{
		double sum = 0;
		for (const Observation& o : edges)
			sum += std::pow(fit.Residual(o, of), 2);
		return sum;
	};
	const double before = squares(x);
	Unknowns found = x;
	if (!fit.Minimise(found, Free::ONE_STATE, state))
		return before;
	const double after = squares(found);
	if (after < before)
		x = found;
	return std::min(before, after);
}

}

FocusCheck CheckFocus(const Calibration& c)
{
	const Solution& s = c.solution;
	const LensModel model = HasFreePlanes(s.lens) ? s.lens : LensModel::PLANE;
	std::vector<std::map<size_t, std::vector<Observation>>> states(c.task.states.size());
	for (const Observation& o : Observe(c.task, c.geometry))
		if (!IsOdd(c, o.state, o.photo))
			states[o.state][o.photo].push_back(o);
	double edges = 0, together = 0, apart = 0;
	size_t seen = 0;
	for (size_t k = 0; k < states.size(); ++k)
	{
		std::vector<Observation> all;
		for (auto at = states[k].begin(); at != states[k].end();)
			if (at->second.size() < LEAST_EDGES)
				at = states[k].erase(at);
			else
			{
				all.insert(all.end(), at->second.begin(), at->second.end());
				++at;
			}
		if (all.empty())
			continue;
		// The untilted lens may be tilted a little: that is another finding.
		Unknowns shared = FreePlanes(s, model);
		together += Squares(c, model, k, all, shared);
		for (const auto& [photo, observations] : states[k])
		{
			Unknowns own = shared;
			apart += Squares(c, model, k, observations, own);
		}
		edges += double(all.size());
		seen += states[k].size();
	}
	if (seen < 3)
		return {};
	return { true, std::sqrt(together / edges), std::sqrt(apart / edges) };
}

}
