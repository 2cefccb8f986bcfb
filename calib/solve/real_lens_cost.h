// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What one edge says of a real lens: rays from its place in the picture through points all over the opening, out through the lens
// (lens/aberrations.h) to the board; where they cross the edge's line there is how the light of its image lies.

#ifndef TILTCAL_REAL_LENS_COST_H
#define TILTCAL_REAL_LENS_COST_H

#include "edge/edge_shape.h"
#include "edge/fit_response.h"
#include "lens/aberrations.h"
#include "lens/optics.h"
#include "solve/jet_value.h"
#include "solve/opening_points.h"

#include <ceres/rotation.h>

#include <array>
#include <cmath>
#include <vector>

namespace tiltcal
{

using tilt_lens::Vec3;

/// Numbers of the blocks that a problem has.
namespace real_lens
{

/// Of a state: the lens normal is (NX, NY, 1) normalised, camera frame; image distance from the exit pupil, px; principal point, px.
enum State { NX, NY, W, CX, CY, STATE_SIZE };
/// Of the lens: its power in units of 1/px of image distance (power times pitch), m, radius of the opening as the entrance pupil's in units of r, floor^2 in px^2.
enum Lens { POWER, MAGNIFICATION, OPENING, FLOOR_SQUARED, LENS_SIZE };
/// Of each rim in turn: logarithms of its radius and of its distance, in the units of UnitsOfRim.
enum Rims { LOG_RADIUS, LOG_DISTANCE, RIM_SIZE };
const int MOST_RIMS = 2, RIMS_SIZE = MOST_RIMS * RIM_SIZE;

/// Of radius and distance. The light tells the shape that the rims leave of the opening, and in these units it stays when opening R and pupil magnification m change: before
/// the lens a rim's centre is seen beside the pupil's by Z tan(theta), in radii by Z / R; behind it by X Z / (m w) of m R, that is by Z / (m^2 R).
/// In mm a rim that the axis's rays meet would hold back an opening that the blur wants larger, one behind the lens would cut more as m grows.
template<typename T>
struct UnitsOfRim
{
	T radius, distance;

	UnitsOfRim(const T& opening, const T& m, int side) : radius(side > 0 ? opening : T(opening * m)), distance(side > 0 ? opening : T(opening * m * m)) {}
};

}

inline double Chained(double, const FitResponse::Value& v) { return v.value; }
template<typename T, int N>
inline ceres::Jet<T, N> Chained(const ceres::Jet<T, N>& x, const FitResponse::Value& v) { return ceres::Jet<T, N>(v.value, v.derivative * x.v); }

/// One state's lens, as rays need it.
template<typename T>
struct MountedLens
{
	tilt_lens::RealLens<T> lens;
	Vec3<T> normal;
	tilt_lens::LensBasis<T> basis;
	T w_mm, depth, x, y;      ///< of the picture's place: how far behind the exit pupil, and beside the axis; mm

	MountedLens(const T* state, const T* of_lens, const T* c, double r, double pitch_mm, double u, double v)
	{
		using std::sqrt;
		using namespace real_lens;
		lens.pupil_magnification = of_lens[MAGNIFICATION];
		lens.power = of_lens[POWER] / T(pitch_mm);
		lens.etendue = true;
		for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
			lens.aberrations.c[k] = c[k];
		lens.aberrations.radius = T(r);
		const T one = T(1) / sqrt(state[NX] * state[NX] + state[NY] * state[NY] + T(1));
		normal = { state[NX] * one, state[NY] * one, one };
		basis = tilt_lens::BasisOfLensPlane(normal);
		w_mm = state[W] * T(pitch_mm);
		// The picture's place as it would be before the lens: the sensor is upside down.
		const Vec3<T> seen{ (T(u) - state[CX]) * T(pitch_mm), -(T(v) - state[CY]) * T(pitch_mm), w_mm };
		depth = Dot(seen, normal);
		x = -Dot(seen, basis.a);
		y = -Dot(seen, basis.b);
	}

	/// The ray, camera frame (origin at the centre of the entrance pupil), that comes through the point (px, py) of the exit pupil, mm.
	void Ray(const T& px, const T& py, Vec3<T>& origin, Vec3<T>& direction) const
	{
		const tilt_lens::PupilRay<T> out = tilt_lens::ObjectSideRay(lens, tilt_lens::RayToSensor(px, py, x, y, depth));
		origin = out.x * basis.a + out.y * basis.b;
		direction = out.slope_x * basis.a + out.slope_y * basis.b + normal;
	}
};

/// Where the ray meets the board (its pose, R its rotation by columns, seen from a lens centre that lies at `centre` in the ray's frame), in board coordinates x and y, mm.
template<typename T>
inline std::array<T, 2> OnBoard(const T* pose, const T* R, const T* centre, const Vec3<T>& origin, const Vec3<T>& direction)
{
	const Vec3<T> from{ origin.x + centre[0] - pose[3], origin.y + centre[1] - pose[4], origin.z + centre[2] - pose[5] };
	const auto along = [&](int axis, const Vec3<T>& v) { return R[3 * axis] * v.x + R[3 * axis + 1] * v.y + R[3 * axis + 2] * v.z; };
	const T reach = -along(2, from) / along(2, direction);
	return { along(0, from) + reach * along(0, direction), along(1, from) + reach * along(1, direction) };
}

/// Place (px, across the edge, bright side positive), soft blur diameter and shape by the lens, minus what was measured.
struct RealLensEdge
{
	/// Place, soft diameter and, where it was measured, the shape.
	static constexpr int SEEN = 2 + SHAPES;
	using Seen = std::array<double, SEEN>;

	double X, Y;                     ///< board, mm
	bool along_columns;              ///< the edge is a line of constant Y, else of constant X
	double u, v, nx, ny;             ///< in the picture: place and unit normal, dark to bright, y down
	double r, pitch_mm;
	FitResponse response;
	double soft_of_disc = 0;         ///< what the opening's few points make of the disc that was fitted, beyond what it is
	double soft_by_floor = 0;        ///< soft diameter per px^2 of floor^2
	double floor_in_response = 0;    ///< px^2, of floor^2, that `response` has already
	std::vector<OpeningPoint> points;
	std::vector<double> px_per_mm;   ///< how far the crossing lies in the picture per mm on the board, of every point
	/// The points are those that these rims leave; what other rims do to place and soft diameter, to first order.
	std::array<double, real_lens::RIMS_SIZE> at_rims{};
	std::array<std::array<double, real_lens::RIMS_SIZE>, SEEN> by_rims{};
	std::optional<EdgeShape> shape{};   ///< as measured, with what the opening's few points make of the shape of a disc

	/// On the board, mm from the edge's line, of the ray through a point of the opening.
	template<typename T>
	T FromLine(const MountedLens<T>& mounted, const T* pose, const T* R, const T* centre, const T* lens, const OpeningPoint& p) const
	{
		const T radius = T(r) * lens[real_lens::OPENING] * lens[real_lens::MAGNIFICATION];
		Vec3<T> origin, direction;
		mounted.Ray(radius * T(p.x), radius * T(p.y), origin, direction);
		const std::array<T, 2> at = OnBoard(pose, R, centre, origin, direction);
		return along_columns ? at[1] - T(Y) : at[0] - T(X);
	}

	int CountOfSeen() const { return shape ? SEEN : 2; }

	template<typename T>
	bool See(const T* state, const T* pose, const T* centre, const T* lens, const T* c, const T* rims, T* seen) const
	{
		T R[9];
		ceres::AngleAxisToRotationMatrix(pose, R);
		const MountedLens<T> mounted(state, lens, c, r, pitch_mm, u, v);
		std::vector<T> crossing;
		crossing.reserve(points.size());
		T middle(0);
		for (size_t k = 0; k < points.size(); ++k)
		{
			crossing.push_back(-FromLine(mounted, pose, R, centre, lens, points[k]) * T(px_per_mm[k]));
			middle += T(points[k].weight) * crossing.back();
		}
		T place = middle, soft(0), shapes[SHAPES];
		for (int i = 0; shape && i < SHAPES; ++i)
			shapes[i] = T(-shape->value[size_t(i)]);
		for (size_t k = 0; k < points.size(); ++k)
		{
			const T x = crossing[k] - middle;
			place += T(points[k].weight) * Chained(x, response.Place(ValueOf(x)));
			soft += T(points[k].weight) * Chained(x, response.Soft(ValueOf(x)));
			for (int i = 0; shape && i < SHAPES; ++i)
				shapes[i] += T(points[k].weight) * Chained(x, response.ShapeOf(Shape(i), ValueOf(x)));
		}
		seen[0] = place;
		seen[1] = soft - T(soft_of_disc) + T(soft_by_floor) * (lens[real_lens::FLOOR_SQUARED] - T(floor_in_response));
		for (int i = 2; i < CountOfSeen(); ++i)
			seen[i] = shapes[i - 2];
		for (size_t i = 0; i < size_t(CountOfSeen()); ++i)
			for (size_t k = 0; k < at_rims.size(); ++k)
				seen[i] += T(by_rims[i][k]) * (rims[k] - T(at_rims[k]));
		return true;
	}
};

}

#endif
