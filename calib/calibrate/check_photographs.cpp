// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/check_photographs.h"

#include "base/robust.h"
#include "edge/soft_radius.h"
#include "model/predict.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Photographs differ in how far the lens's aberrations show in them: the worst of scenes/boxes, whose blur is large, misses by 3.3 times
/// the others' median. One that is not of this state, or not of this board, misses by its own blur or by parts of a square: 9 times there,
/// 20 times and more without aberrations.
const double STANDS_OUT = 5;
/// px; below it nothing in a render is moved or blurred visibly.
const double MATTERS = 0.1;

/// The same pixels give the same numbers, encoded anew they keep their noise and get a little; two exposures of a board that stood still differ by their noise, 1.41 sigma RMS. Half of that.
const double SAME_IN_SIGMAS = 0.7;

bool StandsOut(double rms, double typical) { return rms > STANDS_OUT * typical + MATTERS; }

double RmsOfBlur(const Calibration& c, size_t lens, size_t s, size_t p)
{
	const std::vector<Edge>& edges = c.task.states[s].photos[p].edges;
	double sum = 0;
	for (const Edge& e : edges)
		sum += std::pow(SoftDiameter(PredictedBlurAs(c, lens, s, p, e)) - SoftDiameter(e.blur), 2);
	return edges.empty() ? 0 : std::sqrt(sum / double(edges.size()));
}

/// Median over the others of its state and stop, so that none stands out where all of them are off; of all states where fewer than two
/// others do not say which one is right. 0 where there are none.
template<typename Value>
double TypicalOfOthers(const std::vector<PhotographCheck>& all, const PhotographCheck& own, const Value& value)
{
	std::vector<double> others, of_state;
	for (const PhotographCheck& other : all)
	{
		if (&other == &own)
			continue;
		others.push_back(value(other));
		// What the model leaves out of a blur grows with it.
		if (other.state == own.state && other.stop == own.stop)
			of_state.push_back(value(other));
	}
	if (of_state.size() >= 2)
		others = of_state;
	return others.empty() ? 0 : Median(std::move(others));
}

/// RMS difference of all that was measured, in standard deviations; infinite where something was found in one alone.
double SigmasApart(const Photo& a, const Photo& b)
{
	if (a.corners.size() != b.corners.size() || a.edges.size() != b.edges.size() || a.corners.empty())
		return HUGE_VAL;
	double sum = 0;
	for (size_t k = 0; k < a.corners.size(); ++k)
	{
		const Corner &p = a.corners[k], &q = b.corners[k];
		// A corner that lies a pixel away ends the search for nearly all pairs.
		const double apart = std::hypot(p.x - q.x, p.y - q.y) / std::max(std::max(p.sigma, q.sigma), 1e-6);
		if (p.column != q.column || p.row != q.row || apart > 100)
			return HUGE_VAL;
		sum += 0.5 * apart * apart;
	}
	for (size_t k = 0; k < a.edges.size(); ++k)
		sum += std::pow((a.edges[k].blur - b.edges[k].blur) / std::max(std::max(a.edges[k].blur_sigma, b.edges[k].blur_sigma), 1e-6), 2);
	return std::sqrt(sum / double(a.corners.size() + a.edges.size()));
}

void FindDoubles(const Task& task, std::vector<PhotographCheck>& all)
{
	const auto photo = [&](const PhotographCheck& check) -> const Photo& { return task.states[check.state].photos[check.photo]; };
	for (size_t k = 0; k < all.size(); ++k)
		for (size_t earlier = 0; earlier < k; ++earlier)
			if (SigmasApart(photo(all[k]), photo(all[earlier])) < SAME_IN_SIGMAS)
			{
				all[k].same_as = { all[earlier].state, all[earlier].photo };
				break;
			}
}

/// The state whose plane of focus explains the blur at least twice as well as the own one.
std::optional<size_t> BetterState(const Calibration& c, const PhotographCheck& check)
{
	std::optional<size_t> best;
	double least = check.rms_blur / 2;
	for (size_t s = 0; s < c.solution.states.size(); ++s)
		if (const double rms = RmsOfBlur(c, s, check.state, check.photo); s != check.state && rms < least)
		{
			best = s;
			least = rms;
		}
	return best;
}

}

std::vector<PhotographCheck> CheckPhotographs(const Calibration& c)
{
	std::vector<PhotographCheck> all;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
		{
			PhotographCheck check;
			check.state = s;
			check.photo = p;
			check.stop = c.task.states[s].photos[p].stop;
			check.edges = c.task.states[s].photos[p].edges.size();
			check.rms_places = c.geometry.states[s].photo_rms[p];
			check.rms_blur = RmsOfBlur(c, s, s, p);
			all.push_back(check);
		}
	for (PhotographCheck& check : all)
	{
		check.places_typical = TypicalOfOthers(all, check, [](const PhotographCheck& o) { return o.rms_places; });
		check.blur_typical = TypicalOfOthers(all, check, [](const PhotographCheck& o) { return o.rms_blur; });
		check.odd_places = all.size() > 2 && StandsOut(check.rms_places, check.places_typical);
		check.odd_blur = all.size() > 2 && StandsOut(check.rms_blur, check.blur_typical);
		if (check.odd_blur)
			check.fits_state = BetterState(c, check);
	}
	FindDoubles(c.task, all);
	return all;
}

void ClearByRealLens(const RealLens& lens, std::vector<PhotographCheck>& photographs)
{
	std::vector<PhotographCheck> seen = photographs;
	size_t edge = 0;
	for (PhotographCheck& check : seen)
	{
		double sum = 0;
		for (size_t k = 0; k < check.edges; ++k)
			sum += std::pow(lens.blur_errors_px.at(edge++), 2);
		check.rms_blur = std::sqrt(sum / double(std::max<size_t>(check.edges, 1)));
	}
	for (size_t k = 0; k < seen.size(); ++k)
		if (photographs[k].odd_blur && !StandsOut(seen[k].rms_blur, TypicalOfOthers(seen, seen[k], [](const PhotographCheck& o) { return o.rms_blur; })))
		{
			photographs[k].odd_blur = false;
			photographs[k].fits_state.reset();
		}
}

}
