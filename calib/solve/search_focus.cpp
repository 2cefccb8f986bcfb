// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/search_focus.h"

#include "lens/angles.h"
#include "model/lens_model.h"
#include "model/projection.h"
#include <tiltcal/error.h>
#include "solve/solve_lens.h"

#include <fmt/format.h>
#include "lens/optics.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

struct Candidate
{
	Unknowns x;
	double cost;
};

/// Costs are half chi-squares of errors that are not independent: 20 rather than the 5
/// that would be 3 sigma.
const double SAME_COST = 20;

/// Of a q to which a plane is compared: near infinity both are small, and so is a difference that shows.
const double LEAST_SHARE = 0.2;

double DifferenceOf(const BlurFit& fit, const Vec3<double>& a, const Vec3<double>& b) { return Length(a - b) / std::max(Length(b), LEAST_SHARE * fit.Nearness()); }

/// Adds a candidate, where its fit converged.
void Keep(Candidate& candidate, const std::optional<double>& cost, std::vector<Candidate>& candidates)
{
	if (!cost)
		return;
	candidate.cost = *cost;
	candidates.push_back(candidate);
}

/// Throws Refused where there is none.
void SortByCost(std::vector<Candidate>& candidates, const std::string& state)
{
	if (candidates.empty())
		throw Refused(fmt::format("state {}: the blur fit did not converge", state));
	std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
}

/// The best one different from the best, if it explains the blur as well; else null.
const Candidate* Rival(const BlurFit& fit, const std::vector<Candidate>& candidates, size_t state)
{
	const Candidate& best = candidates.front();
	for (const Candidate& other : candidates)
		if (DifferenceOf(fit, fit.Plane(other.x, state), fit.Plane(best.x, state)) > 0.05 && other.cost - best.cost < SAME_COST)
			return &other;
	return nullptr;
}

/// Tilting a lens does not change its power: the relative change that q asks for.
double PowerChange(const BlurFit& fit, const Unknowns& x, size_t state)
{
	const auto power = [&](size_t s) { return tilt_lens::LensFromPlane(fit.Plane(x, s), 1 / fit.w_mm).power; };
	return std::abs(power(state) / power(0) - 1);
}

/// Two planes of focus explain the blur of one board equally well, q and its mirror image
/// in the board: |1 - q.P| is the same. The focal length tells them apart when it can.
/// `by_power` says that it had to.
Unknowns Choose(const BlurFit& fit, const std::vector<Candidate>& candidates, size_t state, const std::string& name, bool& by_power)
{
	const Candidate* best = &candidates.front();
	const Candidate* rival = Rival(fit, candidates, state);
	by_power = rival != nullptr;
	if (!rival)
		return best->x;
	if (PowerChange(fit, rival->x, state) < PowerChange(fit, best->x, state))
		std::swap(best, rival);
	const double change = PowerChange(fit, best->x, state);
	if (fit.model == LensModel::RIGID || change > 0.01 || PowerChange(fit, rival->x, state) < 3 * change)
		throw Refused(fmt::format("state {}: the blur fits two different planes of focus equally well. "
			"Photograph the board in more poses, inclined in several directions, partly before and partly behind the plane of focus", name));
	return best->x;
}

/// The planes of a state's boards as vectors m with m.P = 1.
std::vector<Vec3<double>> BoardPlanes(const Geometry& g, size_t state)
{
	std::vector<Vec3<double>> planes;
	for (const Pose& pose : g.states[state].poses)
	{
		const Vec3<double> o = CameraFromBoard(pose.data(), 0, 0), x = CameraFromBoard(pose.data(), 1, 0), y = CameraFromBoard(pose.data(), 0, 1);
		planes.push_back(tilt_lens::PlaneThroughPoint(Cross(x - o, y - o), o));
	}
	return planes;
}

/// Planes of focus of every direction and slope, around the untilted state's distance.
std::vector<Candidate> Starts(const BlurFit& fit, const Unknowns& x, size_t state)
{
	// RIGID: the distance follows from the tilt.
	const std::vector<double> distances = fit.model == LensModel::RIGID ? std::vector<double>{ 1.0 } : std::vector<double>{ 0.6, 0.8, 1.0, 1.25 };
	std::vector<Candidate> starts;
	const double k = fit.Plane(x, 0).z, least = LEAST_SHARE * fit.Nearness();
	for (const double distance : distances)
		for (const double slope : { 0.0, 0.3, 0.7, 1.3, 2.5, 5.0 })
			for (int direction = 0; direction < (slope > 0 ? 12 : 1); ++direction)
			{
				Candidate c{ x, 0 };
				const auto m = tilt_lens::FocalPlaneDirection(std::atan(slope), direction * tilt_lens::Pi / 6);
				// Planes through infinity tilt too: all of them would be one where k is 0.
				Vec3<double> q = tilt_lens::PlaneAtDistance(m, std::max(k * distance, least));
				q.z = k * distance;
				c.x.state[state] = StateOfPlane(fit.model, q, fit.w_mm);
				size_t n = 0;
				for (const Observation& o : fit.observations)
					if (o.state == state && n++ % 5 == 0)
						c.cost += std::min(std::abs(fit.Residual(o, c.x)), 20.0);
				starts.push_back(c);
			}
	SortByCost(starts, "");
	starts.resize(std::min<size_t>(starts.size(), 12));
	return starts;
}

}

void SearchUntilted(const BlurFit& fit, const Task& task, const Geometry& geometry, Unknowns& x)
{
	std::vector<DepthBlur> data;
	for (const Observation& o : fit.observations)
		if (o.state == 0)
			data.push_back({ o.P.z, std::max(o.blur, 0.0), x.stops.Ratio(o.stop) });
	std::vector<Candidate> candidates;
	for (const UntiltedGuess& guess : ScanUntilted(data, geometry.w_px))
	{
		Candidate c{ x, 0 };
		c.x.d = guess.diameter;
		c.x.power = guess.inverse_focus + 1 / fit.w_mm;
		c.x.state[0] = StateOfPlane(fit.model, { 0, 0, guess.inverse_focus }, fit.w_mm);
		Keep(c, fit.Minimise(c.x, Free::UNTILTED, 0), candidates);
	}
	SortByCost(candidates, task.states[0].name);
	if (Rival(fit, candidates, 0))
		throw Refused(fmt::format("state {}: the blur fits two focus distances equally well. "
			"Photograph boards that lie partly before and partly behind the plane of focus", task.states[0].name));
	x = candidates.front().x;
}

bool SearchTilted(const BlurFit& fit, const Task& task, const Geometry& geometry, size_t state, Unknowns& x)
{
	std::vector<Candidate> candidates;
	for (Candidate& c : Starts(fit, x, state))
		Keep(c, fit.Minimise(c.x, Free::ONE_STATE, state), candidates);
	const std::string& name = task.states[state].name;
	SortByCost(candidates, name);
	const Vec3<double> found = fit.Plane(candidates.front().x, state);
	for (const Vec3<double>& board : BoardPlanes(geometry, state))
	{
		Candidate mirrored = candidates.front();
		mirrored.x.state[state] = StateOfPlane(fit.model, 2.0 * board - found, fit.w_mm);
		Keep(mirrored, fit.Minimise(mirrored.x, Free::ONE_STATE, state), candidates);
	}
	SortByCost(candidates, name);
	bool by_power = false;
	x = Choose(fit, candidates, state, name, by_power);
	return by_power;
}

}
