// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_TILT_ANGLES_H
#define TILTCAL_TILT_ANGLES_H

#include <tiltcal/calibration.h>

#include <Eigen/Core>

namespace tiltcal
{

/// The numbers that people read, from the plane of focus and the image distance.
/// Directions are folded into (-90, 90] and the tilts carry the sign, so that a lens
/// tilted by -5 degrees "up" is reported as -5 at 0, not as 5 at 180.
struct TiltAngles
{
	double lens_tilt = 0, focal_plane_tilt = 0, tilt_direction = 0;   ///< degrees
	double focus_distance = 0, focal_length = 0;                      ///< mm; may be infinite
};

/// A tilt as a vector, degrees: right and up of where the plane of focus recedes to. Differences of tilts are its own.
Eigen::Vector2d TiltVector(double lens_tilt_deg, double tilt_direction_deg);

/// From a tilt of `from` to that of `to`, degrees: along the direction of `from`, and aside, 90 degrees on. `angle`: lens_tilt or focal_plane_tilt. By their vectors:
/// a tilt of -1 degree towards 10 is one of 1 degree towards 190; and a plane of focus at 89 degrees is 2 from one at -89.
struct TiltDifference
{
	double along, aside;
};
TiltDifference DifferenceOfTilts(const StateLens& from, const StateLens& to, Estimate StateLens::* angle);

/// By the vector lens equation n/f = q + e_z/w (optics.h). q in 1/mm, w in mm.
TiltAngles AnglesFromPlane(const Vec3<double>& q, double w_mm);

/// The sigma of the focus distance as that of 1/U says; where the focus is at infinity it stays.
void TellFocusDistance(StateLens& lens);

/// Fills q, its sigmas and every derived estimate of `lens`. `covariance` is that of
/// (q_x, q_y, q_z, w); first-order propagation by central differences.
void FillStateLens(const Vec3<double>& q, double w_mm, const Eigen::Matrix4d& covariance, StateLens& lens);

}

#endif
