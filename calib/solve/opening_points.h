// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Points of the opening that stand for all of its light, and what rims leave of them.

#ifndef TILTCAL_OPENING_POINTS_H
#define TILTCAL_OPENING_POINTS_H

#include "lens/aberrations.h"
#include "lens/optical_vignetting.h"

#include <array>
#include <cmath>
#include <vector>

namespace tiltcal
{

/// In radii of the opening, and the point's share of the light.
struct OpeningPoint
{
	double x, y, weight;
};

/// Rings with Gauss's radii and an odd number of points each, so that even functions along any direction see twice as many; the weights' sum is 1. FEW do for lenses
/// of third order; what the fifth draws of the rim's light wants FINE ones.
enum Rings { FEW = 2, FINE = 4 };
const std::vector<OpeningPoint>& OpeningPoints(Rings rings = FEW);

/// A ray from the opening's point (x, y), exit pupil, to a place of the picture; mm, the frame of lens/aberrations.h.
struct OpeningView
{
	tilt_lens::RealLens<double> lens;
	double radius;          ///< of the opening, exit pupil
	double X, Y, depth;     ///< the place: behind the exit pupil
	Rings rings = FEW;
};

/// A fine even cover of the opening: COVER points in radii of it.
const int COVER = 400;
const std::vector<std::array<double, 2>>& OpeningCover();

/// How far from the axis a ray is in the plane of a rim: before the entrance pupil (distance > 0) by its object side, or behind the exit pupil by its image side.
template<typename T>
inline T HeightAtRim(const tilt_lens::PupilRay<T>& object, const tilt_lens::PupilRay<T>& image, const T& distance)
{
	using std::sqrt;
	const tilt_lens::PupilRay<T>& ray = distance > T(0) ? object : image;
	const T x = ray.x + distance * ray.slope_x, y = ray.y + distance * ray.slope_y;
	return sqrt(x * x + y * y);
}

/// The part of a point of the cover that a rim leaves: from all to nothing over the point's own width, so that the light is a smooth function of the rim.
/// `width`: of the point in the rim's plane.
template<typename T>
inline T PartWithin(const T& height, const T& rim_radius, double width)
{
	const T part = (rim_radius - height) / T(width) + T(0.5);
	return part > T(1) ? T(1) : part < T(0) ? T(0) : part;
}

/// Width of a point of the cover in the plane of a rim at that distance, mm.
double WidthAtRim(const OpeningView& view, double distance);

/// cos(theta_lens) cos(theta_sensor) / r^2 of a point of the exit pupil (in radii of the opening), seen from the place, relative to that of the pupil's middle;
/// of a lens that is not tilted, and as nearly of one that is.
double LightOfPoint(const OpeningView& view, double x, double y);

/// All rays of the cover to one place of the picture.
class OpeningRays
{
public:
	explicit OpeningRays(const OpeningView& view);

	/// OpeningPoints, each moved and lightened by what rims leave of its part of the opening, all of them with the middle and the covariance of the light that
	/// is left; rims as in lens/optical_vignetting.h: before the entrance pupil, or behind the exit pupil. All weights 1 in sum again; the whole opening where the rims leave nothing.
	std::vector<OpeningPoint> Through(const std::vector<tilt_lens::Rim>& rims) const;

private:
	OpeningView view;
	std::vector<tilt_lens::PupilRay<double>> object, image;
};

/// The same, where the rims are not to be moved.
std::vector<OpeningPoint> OpeningThroughRims(const OpeningView& view, const std::vector<tilt_lens::Rim>& rims);

}

#endif
