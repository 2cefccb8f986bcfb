// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/next_photographs.h"

#include "calibrate/candidates.h"
#include "calibrate/coverage.h"
#include "calibrate/next_words.h"
#include "calibrate/optimal_design.h"

#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tiltcal
{

namespace
{

const size_t MOST_SUGGESTED = 3;
/// A part of the picture where no board was says nothing of the light and the distortion there, which no sigma here holds.
const double WORTH_OF_NEW_THIRDS = 0.5;

/// Its own states' photographs of a pose; empty where one of them cannot be taken.
std::vector<Photo> PhotosOf(const Calibration& c, const NextPhotograph& look)
{
	std::vector<Photo> photos;
	for (const size_t s : look.states)
	{
		Candidate one = Expect(c, s, look.pose);
		if (one.photo.edges.empty())
			return {};
		photos.push_back(std::move(one.photo));
	}
	return photos;
}

std::vector<size_t> AllStates(const Calibration& c)
{
	std::vector<size_t> all;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		all.push_back(s);
	return all;
}

/// Of many states: every so many-th.
const size_t MOST_CANDIDATES = 1500;

void Gather(const Calibration& c, std::vector<NextPhotograph>& looks, std::vector<std::vector<Photo>>& photos)
{
	const bool shared = c.geometry.shared_poses;
	std::vector<std::pair<size_t, Candidate>> all;
	for (size_t s = 0; s < (shared ? 1 : c.task.states.size()); ++s)
		for (Candidate& candidate : CandidatesOf(c, s))
			all.emplace_back(s, std::move(candidate));
	const size_t step = all.size() / MOST_CANDIDATES + 1;
	for (size_t k = 0; k < all.size(); k += step)
	{
		const size_t s = all[k].first;
		Candidate& candidate = all[k].second;
		candidate.look.states = shared ? AllStates(c) : std::vector<size_t>{ s };
		std::vector<Photo> own = shared ? PhotosOf(c, candidate.look) : std::vector<Photo>{ std::move(candidate.photo) };
		if (own.empty())
			continue;
		looks.push_back(std::move(candidate.look));
		photos.push_back(std::move(own));
	}
}

bool IsMissing(const ExpectedSigma& s, double ExpectedSigma::* which) { return s.*which > s.wanted; }

/// Where in the picture its corners will be, the outermost squares left out.
Thirds ThirdsOf(const Calibration& c, const NextPhotograph& look)
{
	Task one;
	one.width = c.task.width;
	one.height = c.task.height;
	one.states.resize(1);
	one.states[0].photos.resize(1);
	for (const Point& p : look.outline_px)
		one.states[0].photos[0].corners.push_back({ 0, 0, 0.8 * p[0] + 0.2 * look.middle_px[0], 0.8 * p[1] + 0.2 * look.middle_px[1], 0 });
	return SeenThirds(one);
}

/// The part of the empty thirds that are reached.
double NewThirds(const Thirds& seen, const Thirds& reached)
{
	double empty = 0, filled = 0;
	for (size_t k = 0; k < seen.size(); ++k)
	{
		empty += !seen[k];
		filled += !seen[k] && reached[k];
	}
	return empty > 0 ? filled / empty : 0;
}

/// A state with too few photographs comes first.
bool IsOfAPoorState(const Calibration& c, const NextPhotograph& look, const std::vector<NextPhotograph>& taken)
{
	for (const size_t s : look.states)
	{
		size_t photos = c.task.states[s].photos.size();
		for (const NextPhotograph& t : taken)
			photos += size_t(std::count(t.states.begin(), t.states.end(), s));
		if (photos < LEAST_PHOTOGRAPHS)
			return true;
	}
	return false;
}

/// The one that is to follow those taken: of a state with too few if there is one, else what is best for sigmas and empty thirds.
std::optional<size_t> BestBeside(const std::vector<size_t>& taken, const Calibration& c, const Design& design, const std::vector<NextPhotograph>& photographs, const Thirds& reached)
{
	std::optional<size_t> best;
	double least = HUGE_VAL;
	bool best_is_poor = false;
	for (size_t k = 0; k < design.Count(); ++k)
	{
		// Two of one pose see the same errors of the model.
		if (std::count(taken.begin(), taken.end(), k))
			continue;
		std::vector<size_t> with = taken;
		with.push_back(k);
		const std::optional<double> badness = design.Badness(with);
		const bool poor = IsOfAPoorState(c, design.Look(k), photographs);
		if (!badness || (best_is_poor && !poor))
			continue;
		const double value = *badness * (1 - WORTH_OF_NEW_THIRDS * NewThirds(reached, ThirdsOf(c, design.Look(k))));
		if (value < least || (poor && !best_is_poor))
		{
			best = k;
			least = value;
			best_is_poor = poor;
		}
	}
	return best;
}

}

NextPhotographs FindNextPhotographs(const Calibration& c)
{
	NextPhotographs out;
	std::vector<NextPhotograph> looks;
	std::vector<std::vector<Photo>> photos;
	Gather(c, looks, photos);
	Design design(c);
	design.Prepare(std::move(looks), std::move(photos));
	if (!design.SigmasWith({}, out.sigmas))
		return out;
	out.known = true;
	const Thirds seen = SeenThirds(c.task);
	out.missing = WhatIsMissing(c, out.sigmas, seen, LEAST_PHOTOGRAPHS);
	std::vector<size_t> taken;
	Thirds reached = seen;
	while (taken.size() < MOST_SUGGESTED)
	{
		const std::optional<size_t> best = BestBeside(taken, c, design, out.photographs, reached);
		if (!best)
			break;
		taken.push_back(*best);
		NextPhotograph next = design.Look(*best);
		design.SigmasWith(taken, next.sigmas);
		next.text = HowToTake(c, next);
		const Thirds own = ThirdsOf(c, next);
		for (size_t k = 0; k < reached.size(); ++k)
			reached[k] = reached[k] || own[k];
		out.sigmas = next.sigmas;
		out.photographs.push_back(std::move(next));
		// One shows what there is to gain where nothing is missing.
		if (out.missing.empty() || std::none_of(out.sigmas.begin(), out.sigmas.end(), [](const ExpectedSigma& s) { return IsMissing(s, &ExpectedSigma::then); }))
			break;
	}
	return out;
}

NextPhotograph PhotographOfPose(const Calibration& c, const std::vector<size_t>& states, const Pose& pose)
{
	NextPhotograph look = Expect(c, states.at(0), pose).look;
	look.states = states;
	return look;
}

std::vector<ExpectedSigma> ExpectSigmas(const Calibration& c, const std::vector<NextPhotograph>& photographs)
{
	std::vector<std::vector<Photo>> photos;
	for (const NextPhotograph& look : photographs)
	{
		photos.push_back(PhotosOf(c, look));
		if (photos.back().empty())
			throw Refused(fmt::format("{}: the board would not lie in the picture, or be blurred or small beyond measuring", look.text));
	}
	Design design(c);
	design.Prepare(photographs, std::move(photos));
	std::vector<size_t> all;
	for (size_t k = 0; k < photographs.size(); ++k)
		all.push_back(k);
	std::vector<ExpectedSigma> out;
	design.SigmasWith(all, out);
	return out;
}

}
