// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What evenly bright patches say of a real lens and its rims: the light that the sensor gets through what they leave of the opening, of which every point of the
// exit pupil sends
//   dE = L cos(theta_lens) cos(theta_sensor) / r^2 dA
// (Lambert's law, as lens/natural_vignetting.h has it for a small opening).

#ifndef TILTCAL_REAL_LENS_LIGHT_H
#define TILTCAL_REAL_LENS_LIGHT_H

#include "solve/real_lens_cost.h"

#include <tiltcal/task.h>

#include <Eigen/Core>

#include <cmath>
#include <optional>
#include <vector>

namespace tiltcal
{

/// Sides of the rims that there are: 1 before the entrance pupil, -1 behind the exit pupil.
using RimSides = std::vector<int>;

/// Log of the light of one place of the picture, but for a constant. `opening`: its radius as the entrance pupil's. `mounted_double` is `mounted` without derivatives.
template<typename T>
T LogLightThroughRims(const MountedLens<T>& mounted, const MountedLens<double>& mounted_double, const T& opening, const T* rims, const RimSides& sides)
{
	using std::exp;
	using std::log;
	const T radius = opening * mounted.lens.pupil_magnification;
	const double radius_double = ValueOf(radius);
	const OpeningView view{ mounted_double.lens, radius_double, mounted_double.x, mounted_double.y, mounted_double.depth };
	T rim_radius[real_lens::MOST_RIMS], distance[real_lens::MOST_RIMS];
	double width[real_lens::MOST_RIMS];
	for (size_t i = 0; i < sides.size(); ++i)
	{
		const real_lens::UnitsOfRim<T> unit(opening, mounted.lens.pupil_magnification, sides[i]);
		rim_radius[i] = unit.radius * exp(rims[real_lens::RIM_SIZE * i + real_lens::LOG_RADIUS]);
		distance[i] = T(double(sides[i])) * unit.distance * exp(rims[real_lens::RIM_SIZE * i + real_lens::LOG_DISTANCE]);
		width[i] = WidthAtRim(view, ValueOf(distance[i]));
	}
	T open(0);
	for (size_t k = 0; k < OpeningCover().size(); ++k)
	{
		const double x = OpeningCover()[k][0], y = OpeningCover()[k][1], share = LightOfPoint(view, x, y) / COVER;
		const tilt_lens::PupilRay<double> image = tilt_lens::RayToSensor(view.radius * x, view.radius * y, view.X, view.Y, view.depth), object = tilt_lens::ObjectSideRay(view.lens, image);
		double whole = share;
		bool near_a_rim = false;
		for (size_t i = 0; i < sides.size(); ++i)
		{
			const double part = PartWithin(HeightAtRim(object, image, ValueOf(distance[i])), ValueOf(rim_radius[i]), width[i]);
			near_a_rim |= part > 0 && part < 1;
			whole *= part;
		}
		if (!near_a_rim || whole == 0)
		{
			open += T(whole);
			continue;
		}
		// Only these know of the rims.
		const tilt_lens::PupilRay<T> to = tilt_lens::RayToSensor(T(radius * T(x)), T(radius * T(y)), mounted.x, mounted.y, mounted.depth), from = tilt_lens::ObjectSideRay(mounted.lens, to);
		T part(share);
		for (size_t i = 0; i < sides.size(); ++i)
			part *= PartWithin(HeightAtRim(from, to, distance[i]), rim_radius[i], width[i]);
		open += part;
	}
	const T squared = mounted.x * mounted.x + mounted.y * mounted.y + mounted.depth * mounted.depth;
	// The whole opening sends what its middle does, to the fourth order; the shares hold the rest.
	const double least = 1e-3;
	return log(mounted.depth * mounted.w_mm / (squared * squared)) + (open > T(least) ? T(log(open)) : T(std::log(least)));
}

/// The patches of one exposure. Its gain, and the gradient of its lighting where that is its own, are projected out of the residuals.
struct RealLensPatches
{
	struct Patch { double u, v, place[2], log_value, sigma, weight; };
	std::vector<Patch> patches;
	Eigen::MatrixXd basis;           ///< orthonormal columns: what is projected out, in weighted residuals
	double r, pitch_mm;
	RimSides sides;

	/// Log of the light by the lens minus what was measured, gain and gradient not taken out, not weighted.
	template<typename T>
	void See(const T* state, const T* lens, const T* c, const T* rims, const T* gradient, T* seen) const
	{
		double values[real_lens::STATE_SIZE + real_lens::LENS_SIZE + tilt_lens::AberrationTerms], *const lens_double = values + real_lens::STATE_SIZE, *const c_double = lens_double + real_lens::LENS_SIZE;
		for (int k = 0; k < real_lens::STATE_SIZE; ++k)
			values[k] = ValueOf(state[k]);
		for (int k = 0; k < real_lens::LENS_SIZE; ++k)
			lens_double[k] = ValueOf(lens[k]);
		for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
			c_double[k] = ValueOf(c[k]);
		for (size_t i = 0; i < patches.size(); ++i)
		{
			const Patch& p = patches[i];
			const MountedLens<T> mounted(state, lens, c, r, pitch_mm, p.u, p.v);
			const MountedLens<double> mounted_double(values, lens_double, c_double, r, pitch_mm, p.u, p.v);
			seen[i] = LogLightThroughRims(mounted, mounted_double, T(T(r) * lens[real_lens::OPENING]), rims, sides) + gradient[0] * T(p.place[0]) + gradient[1] * T(p.place[1]) - T(p.log_value);
		}
	}

	/// As the fit counts them: weighted, without what is projected out, and beyond 3 sigma as Huber's cost does.
	template<typename T>
	bool operator()(const T* state, const T* lens, const T* c, const T* rims, const T* gradient, T* residual) const
	{
		using std::sqrt;
		See(state, lens, c, rims, gradient, residual);
		const size_t n = patches.size();
		for (size_t i = 0; i < n; ++i)
			residual[i] *= T(patches[i].weight);
		for (int b = 0; b < basis.cols(); ++b)
		{
			T along(0);
			for (size_t i = 0; i < n; ++i)
				along += T(basis(int(i), b)) * residual[i];
			for (size_t i = 0; i < n; ++i)
				residual[i] -= T(basis(int(i), b)) * along;
		}
		const double most = 3;
		for (size_t i = 0; i < n; ++i)
		{
			const T size = residual[i] < T(0) ? T(-residual[i]) : residual[i];
			if (size > T(most))
				residual[i] = (residual[i] < T(0) ? T(-1) : T(1)) * sqrt(T(2 * most) * size - T(most * most));
		}
		return true;
	}
};

/// Of all exposures with their lens's state, in one order: the flat fields where there are any, else the photographs' white squares.
struct RealLensExposure
{
	size_t state;
	std::optional<size_t> photo;     ///< none: a flat field
	bool lit_alike;                  ///< its gradient is that of the photograph of the same number in the other states
	RealLensPatches light;
};
std::vector<RealLensExposure> ExposuresOf(const Task& task, bool shared_poses, double r, const RimSides& sides);

/// Sets the patches' weights, `error` being what the model leaves out of each, and what is projected out.
void Weigh(double error, RealLensExposure& exposure);

}

#endif
