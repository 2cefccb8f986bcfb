// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_fit.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using namespace real_lens;

/// From the same numbers with poses of each state's own; none where they do not converge.
std::optional<RealLensNumbers> AboutSharedPoses(const RealLensFit& fit, const std::vector<RealLensEdge>& edges, const Geometry& geometry, RealLensNumbers x)
{
	x.shared_poses = x.lens_held = true;
	for (size_t s = 1; s < x.states.size(); ++s)
	{
		const Vec3<double>& centre = geometry.states[s].lens_centre;
		x.centres[s] = { centre.x, centre.y, centre.z };
	}
	return fit.Minimise(edges, x, false) ? std::optional(x) : std::nullopt;
}

/// Where a fit's answer went beyond what its edges are true about.
const int FURTHER_ROUNDS = 3;

/// Whether edges that are built about an answer misfit as much as those that led to it.
bool IsTrueAbout(const ModelError& before, const ModelError& after) { return after.offset < 1.1 * before.offset && after.blur < 1.1 * before.blur; }

/// The rims where they were before m changed from `m`, in radii of the opening; their own units move those behind the lens with it.
void KeepRims(double m, RealLensNumbers& x)
{
	for (size_t k = 0; k < x.sides.size(); ++k)
	{
		const UnitsOfRim<double> was(1, m, x.sides[k]), is(1, x.lens[MAGNIFICATION], x.sides[k]);
		x.rims[RIM_SIZE * k + LOG_RADIUS] += std::log(was.radius / is.radius);
		x.rims[RIM_SIZE * k + LOG_DISTANCE] += std::log(was.distance / is.distance);
	}
}

/// Rounds, each built about the last one's answer, which knows better what the lens leaves out; so many, and a few more until the last is true about its own. False: none is, or no convergence.
bool GoRounds(RealLensFit& fit, RealLensNumbers& x, std::vector<RealLensEdge>& edges, int rounds)
{
	const auto learn = [&]
	{
		fit.error = ErrorOf(fit.Residuals(edges, x));
		fit.LearnLight(x);
	};
	bool done = false;
	learn();
	for (int round = 0; round < rounds + FURTHER_ROUNDS && !done; ++round)
	{
		const bool last = round + 1 >= rounds;
		const double m = x.lens[MAGNIFICATION];
		if (!fit.Minimise(edges, x, !last))
			return false;
		const ModelError led = ErrorOf(fit.Residuals(edges, x));
		if (fit.rims_know_pupils)
			KeepRims(m, x);
		edges = fit.EdgesAbout(x);
		learn();
		done = last && IsTrueAbout(led, fit.error);
	}
	return done;
}

std::optional<RealLensAnswer> Answer(const RealLensFit& fit, const std::vector<RealLensEdge>& edges, const Geometry& geometry, RealLensNumbers x)
{
	RealLensAnswer answer;
	answer.error = fit.error;
	answer.residuals = fit.Residuals(edges, x);
	const std::optional<RealLensFit::Judged> judged = fit.Judge(edges, x);
	if (!judged)
		return std::nullopt;
	answer.judged = *judged;
	answer.numbers = x;
	if (geometry.shared_poses)
		answer.about_shared_poses = AboutSharedPoses(fit, edges, geometry, x);
	return answer;
}

/// What the powers of the slopes make of a term.
double SlopesOfTerm(int k, double slope) { return std::pow(slope, 2 * tilt_lens::AberrationPowers[k][0] + tilt_lens::AberrationPowers[k][1]); }

bool Divides(int third, int fifth)
{
	bool divides = true;
	for (int i = 0; i < 3; ++i)
		divides &= tilt_lens::AberrationPowers[third][i] <= tilt_lens::AberrationPowers[fifth][i];
	return divides;
}

}

std::array<double, tilt_lens::AberrationTerms> LikelyFifthOrder(const std::array<double, tilt_lens::AberrationTerms>& c, double slope)
{
	std::array<double, tilt_lens::AberrationTerms> likely{};
	for (int k = tilt_lens::ThirdOrderTerms; k < tilt_lens::AberrationTerms; ++k)
	{
		double squares = 0;
		int count = 0;
		for (int j = 0; j < tilt_lens::ThirdOrderTerms; ++j)
			if (Divides(j, k))
			{
				squares += std::pow(c[size_t(j)] * SlopesOfTerm(j, slope), 2);
				++count;
			}
		likely[size_t(k)] = std::sqrt(squares / count) / SlopesOfTerm(k, slope);
	}
	return likely;
}

std::optional<RealLensAnswer> SolveRealLens(const Task& task, const Geometry& geometry, const Solution& thin, const std::vector<tilt_lens::Rim>& rims)
{
	const bool is_behind = std::any_of(rims.begin(), rims.end(), [](const tilt_lens::Rim& rim) { return rim.distance < 0; });
	for (const bool rims_know_pupils : is_behind ? std::vector<bool>{ true, false } : std::vector<bool>{ false })
	{
		RealLensNumbers x = StartOfRealLens(task, geometry, thin, rims);
		for (int k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
			x.free[size_t(k)] = true;
		x.magnification_free = true;
		RealLensFit fit{ task };
		fit.rims_know_pupils = rims_know_pupils;
		std::vector<RealLensEdge> edges = fit.EdgesAbout(x);
		if (GoRounds(fit, x, edges, 4))
			return Answer(fit, edges, geometry, x);
	}
	return std::nullopt;
}

std::optional<RealLensAnswer> SolveSceneLens(const Task& task, const Geometry& geometry, const RealLensNumbers& six)
{
	RealLensNumbers x = six;
	x.free.fill(true);
	RealLensFit fit{ task, FINE };
	fit.rims_about = x.rims;
	if (!x.sides.empty())
		fit.exposures = ExposuresOf(task, geometry.shared_poses, x.r, x.sides);
	x.rims_free = !fit.exposures.empty();
	fit.likely_c = LikelyFifthOrder(x.c, 0.5 * std::hypot(task.width, task.height) / x.states[0][W]);
	std::vector<RealLensEdge> edges = fit.EdgesAbout(x);
	if (!GoRounds(fit, x, edges, 5))
		return std::nullopt;
	std::optional<RealLensAnswer> answer = Answer(fit, edges, geometry, x);
	// The same units: what this lens leaves out.
	const RealLensFit before{ task, FEW, fit.error };
	RealLensNumbers y = six;
	const std::optional<RealLensFit::Judged> judged = before.Judge(before.EdgesAbout(y), y);
	if (answer && judged)
		answer->held_out_before = judged->held_out;
	return answer;
}

}
