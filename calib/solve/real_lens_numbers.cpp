// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_fit.h"

#include <cmath>

namespace tiltcal
{

using namespace real_lens;

std::vector<tilt_lens::Rim> RealLensNumbers::Rims() const
{
	std::vector<tilt_lens::Rim> all;
	for (size_t k = 0; k < sides.size(); ++k)
	{
		const UnitsOfRim<double> unit(r * lens[OPENING], lens[MAGNIFICATION], sides[k]);
		all.push_back({ unit.radius * std::exp(rims[RIM_SIZE * k + LOG_RADIUS]), sides[k] * unit.distance * std::exp(rims[RIM_SIZE * k + LOG_DISTANCE]) });
	}
	return all;
}

RealLensNumbers RealLensNumbers::AtStop(size_t stop) const
{
	RealLensNumbers seen = *this;
	seen.lens[OPENING] *= stops.Ratio(stop);
	// Their units are the opening's.
	for (double& rim : seen.rims)
		rim -= stops.Log(stop);
	return seen;
}

std::vector<RealLensNumbers> RealLensNumbers::AtEveryStop() const
{
	std::vector<RealLensNumbers> all;
	for (size_t stop = 0; stop <= stops.Further(); ++stop)
		all.push_back(AtStop(stop));
	return all;
}

Eigen::VectorXd RealLensNumbers::InARow() const
{
	std::vector<double> all;
	const auto add = [&all](const auto& block) { all.insert(all.end(), block.begin(), block.end()); };
	add(lens);
	add(c);
	add(rims);
	for (const auto& state : states)
		add(state);
	for (const double* stop : stops.Blocks())
		all.push_back(*stop);
	return Eigen::Map<const Eigen::VectorXd>(all.data(), long(all.size()));
}

RealLensNumbers StartOfRealLens(const Task& task, const Geometry& geometry, const Solution& thin, const std::vector<tilt_lens::Rim>& rims)
{
	RealLensNumbers x;
	x.r = 0.5 * thin.aperture_diameter.value;
	x.stops = StopRatios(thin.stop_ratios);
	for (size_t k = 0; k < rims.size() && k < size_t(MOST_RIMS); ++k)
	{
		x.sides.push_back(rims[k].distance > 0 ? 1 : -1);
		x.rims[RIM_SIZE * k + LOG_RADIUS] = std::log(rims[k].radius / x.r);
		x.rims[RIM_SIZE * k + LOG_DISTANCE] = std::log(std::abs(rims[k].distance) / x.r);
	}
	x.gradients.assign(std::max<size_t>(1, task.states[0].photos.size()), { 0, 0 });
	double power = 0;
	for (size_t s = 0; s < task.states.size(); ++s)
	{
		const StateGeometry& state = geometry.states[s];
		const Vec3<double> n = state.lens_normal;
		x.states.push_back({ n.x / n.z, n.y / n.z, geometry.w_px, state.principal_point[0], state.principal_point[1] });
		x.poses.push_back(state.poses);
		x.centres.push_back({ 0, 0, 0 });
		power += 1 / thin.states[s].focal_length.value / double(task.states.size());
	}
	x.lens = { power * task.pitch_mm, 1, 1, thin.psf_floor_squared.value };
	// What the thin lens's own do to its rays, to first order: x (1 + k1 tan^2), and R = v - kappa S with kappa + C tan^2.
	x.c[tilt_lens::Distortion] = -geometry.distortion[0] * x.r;
	x.c[tilt_lens::Curvature] = -0.5 * thin.field_curvature.value * x.r * x.r;
	return x;
}

}
