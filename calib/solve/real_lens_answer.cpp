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

/// As of the other effects, in sigmas.
const double SIGNIFICANT = 2;

/// Where a fit's answer went beyond what its edges are true about.
const int FURTHER_ROUNDS = 3;

/// Whether edges that are built about an answer misfit as much as those that led to it.
bool IsTrueAbout(const EdgeScatter& before, const EdgeScatter& after) { return after.offset < 1.1 * before.offset && after.blur < 1.1 * before.blur; }

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
	bool done = false;
	fit.LearnErrors(edges, x);
	for (int round = 0; round < rounds + FURTHER_ROUNDS && !done; ++round)
	{
		const bool last = round + 1 >= rounds;
		const double m = x.lens[MAGNIFICATION];
		if (!fit.Minimise(edges, x, !last))
			return false;
		const EdgeScatter led = ScatterOf(fit.Residuals(edges, x));
		if (fit.rims_know_pupils)
			KeepRims(m, x);
		edges = fit.EdgesAbout(x);
		fit.LearnErrors(edges, x);
		done = last && IsTrueAbout(led, fit.scatter);
	}
	return done;
}

RealLensAnswer AnswerOf(const RealLensFit& fit, const std::vector<RealLensEdge>& edges, const Geometry& geometry, const RealLensNumbers& x, const RealLensFit::Judged& judged)
{
	RealLensAnswer answer;
	answer.error = fit.error;
	answer.scatter = fit.scatter;
	if (std::any_of(edges.begin(), edges.end(), [](const RealLensEdge& edge) { return edge.shape.has_value(); }))
		answer.shape_scatter = fit.shape_scatter;
	answer.residuals = fit.Residuals(edges, x);
	answer.judged = judged;
	answer.numbers = x;
	if (geometry.shared_poses)
		answer.about_shared_poses = AboutSharedPoses(fit, edges, geometry, x);
	return answer;
}

/// Six numbers that were fitted.
struct Solved
{
	RealLensFit fit;
	std::vector<RealLensEdge> edges;
	RealLensNumbers x;

	/// Minus the logarithm of the likelihood of places and blurs is their number times that of this, but for a constant.
	double Misfit() const { return fit.scatter.offset * fit.scatter.blur; }
};

std::optional<Solved> SolveWith(const Task& task, RealLensNumbers x, bool rims_know_pupils)
{
	for (int k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
		x.free[size_t(k)] = true;
	x.magnification_free = true;
	RealLensFit fit{ task };
	fit.rims_know_pupils = rims_know_pupils;
	std::vector<RealLensEdge> edges = fit.EdgesAbout(x);
	if (!GoRounds(fit, x, edges, 4))
		return std::nullopt;
	return Solved{ fit, std::move(edges), std::move(x) };
}

bool IsBehind(const tilt_lens::Rim& rim) { return rim.distance < 0; }

/// Light hardly tells a lone rim before the lens from one behind it, and a thin lens's edges go by what its aberrations do to them: both are tried. Of two, the second's side was told beside the first's.
std::vector<std::vector<tilt_lens::Rim>> SidesOf(const std::vector<tilt_lens::Rim>& rims)
{
	std::vector<std::vector<tilt_lens::Rim>> all{ rims };
	if (rims.size() == 1)
		all.push_back({ { rims[0].radius, -rims[0].distance } });
	return all;
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

/// The steepest slope, before the lens, of the light of any state's corners, through the middle of its pupil.
double SlopeOfCorners(const Task& task, const RealLensNumbers& x)
{
	double steepest = 0;
	for (const auto& state : x.states)
		for (const double u : { 0., task.width - 1. })
			for (const double v : { 0., task.height - 1. })
			{
				const MountedLens<double> corner(state.data(), x.lens.data(), x.c.data(), x.r, task.pitch_mm, u, v);
				steepest = std::max(steepest, corner.lens.pupil_magnification * std::hypot(corner.x, corner.y) / corner.depth);
			}
	return steepest;
}

/// Of the numbers that are free and are not significant, the one that is least.
std::optional<int> LeastSignificant(const RealLensFit::Judged& judged, const RealLensNumbers& x)
{
	double least = SIGNIFICANT;
	std::optional<int> term;
	for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
		if (x.free[size_t(k)])
			if (const double sigmas = std::abs(x.c[size_t(k)]) / std::sqrt(judged.Variance(LENS_SIZE + k)); sigmas < least)
			{
				least = sigmas;
				term = k;
			}
	return term;
}

/// Holds the numbers that are not significant at 0, one after the other, each time fitted anew. None: no convergence, or singular.
std::optional<RealLensFit::Judged> KeepSignificant(RealLensFit& fit, std::vector<RealLensEdge>& edges, RealLensNumbers& x)
{
	for (;;)
	{
		std::optional<RealLensFit::Judged> judged = fit.Judge(edges, x);
		const std::optional<int> idle = judged ? LeastSignificant(*judged, x) : std::nullopt;
		if (!idle)
			return judged;
		x.free[size_t(*idle)] = false;
		x.c[size_t(*idle)] = 0;
		if (!GoRounds(fit, x, edges, 1))
			return std::nullopt;
	}
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
	std::optional<Solved> best;
	for (const std::vector<tilt_lens::Rim>& sides : SidesOf(rims))
		for (const bool rims_know_pupils : { true, false })
		{
			if (rims_know_pupils && std::none_of(sides.begin(), sides.end(), IsBehind))
				continue;
			std::optional<Solved> solved = SolveWith(task, StartOfRealLens(task, geometry, thin, sides), rims_know_pupils);
			if (solved && (!best || solved->Misfit() < best->Misfit()))
				best.emplace(std::move(*solved));
		}
	if (!best)
		return std::nullopt;
	const std::optional<RealLensFit::Judged> judged = best->fit.Judge(best->edges, best->x);
	return judged ? std::optional(AnswerOf(best->fit, best->edges, geometry, best->x, *judged)) : std::nullopt;
}

std::optional<RealLensAnswer> SolveSceneLens(const Task& task, const Geometry& geometry, const RealLensNumbers& six)
{
	RealLensNumbers x = six;
	x.free.fill(true);
	// The one number of the fifth order that no image shows: P^3 moves the pupil alone. Edges would take for it how the opening itself shifts with the field, and
	// where no board was it grows with the fifth power of the slope: rims cut black corners by it.
	x.free[tilt_lens::Fifth_PPP] = false;
	RealLensFit fit{ task, FINE };
	fit.shapes = true;
	fit.rims_about = x.rims;
	if (!x.sides.empty())
		fit.exposures = ExposuresOf(task, geometry.shared_poses, x.r, x.sides);
	x.rims_free = !fit.exposures.empty();
	fit.likely_c = LikelyFifthOrder(x.c, SlopeOfCorners(task, x));
	std::vector<RealLensEdge> edges = fit.EdgesAbout(x);
	if (!GoRounds(fit, x, edges, 5))
		return std::nullopt;
	const std::optional<RealLensFit::Judged> judged = KeepSignificant(fit, edges, x);
	if (!judged)
		return std::nullopt;
	RealLensAnswer answer = AnswerOf(fit, edges, geometry, x, *judged);
	// The same units: what this lens leaves out.
	const RealLensFit before{ task, FEW, fit.error };
	RealLensNumbers y = six;
	const std::vector<RealLensEdge> about_six = before.EdgesAbout(y);
	// In these units it stands a little elsewhere: what is left out can be predicted from a minimum alone.
	if (before.Minimise(about_six, y, false))
		if (const std::optional<RealLensFit::Judged> of_six = before.Judge(about_six, y))
			answer.held_out_before = of_six->held_out;
	return answer;
}

}
