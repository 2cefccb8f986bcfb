// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Rays of a real lens with their derivatives, put together by the chain rule: Jets of all numbers through every ray take many times as long.

#ifndef TILTCAL_MOVING_RAYS_H
#define TILTCAL_MOVING_RAYS_H

#include "solve/real_lens_cost.h"

#include <Eigen/Core>

#include <array>

namespace tiltcal
{

/// By the numbers of a state and the lens's linear part, in this order: of what all rays to one place of the picture share.
const int PLACE_NUMBERS = real_lens::STATE_SIZE + real_lens::LENS_SIZE;
using PlaceJet = ceres::Jet<double, PLACE_NUMBERS>;
using ByPlace = Eigen::Matrix<double, PLACE_NUMBERS, 1>;

/// The same and the aberrations c.
const int RAY_NUMBERS = PLACE_NUMBERS + tilt_lens::AberrationTerms;

/// Rows: x, y and the slopes.
struct MovingRay
{
	tilt_lens::PupilRay<double> image, object;
	Eigen::Matrix<double, 4, PLACE_NUMBERS> image_by;
	Eigen::Matrix<double, 4, RAY_NUMBERS> object_by;
};

/// The rays that arrive at the place (u, v) of the picture.
class MovingRays
{
public:
	MovingRays(const double* state, const double* lens, const double* c, double r, double pitch_mm, double u, double v);

	/// Through the point (x, y) of the opening, in radii of it.
	MovingRay Through(double x, double y) const;

	const MountedLens<PlaceJet>& Mounted() const { return mounted; }
	/// Of the opening as the entrance pupil's, mm.
	const PlaceJet& Opening() const { return opening; }

private:
	MountedLens<PlaceJet> Mount(const double* state, const double* c, double r, double pitch_mm, double u, double v) const;

	std::array<PlaceJet, real_lens::LENS_SIZE> lens;
	PlaceJet opening, radius;
	MountedLens<PlaceJet> mounted;
	tilt_lens::Aberrations<double> aberrations;
};

}

#endif
