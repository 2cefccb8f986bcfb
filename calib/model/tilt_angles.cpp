// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/tilt_angles.h"

#include "lens/angles.h"
#include "lens/optics.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const double DEGREES = tilt_lens::DegreesPerRadian;

/// `a` as it reads on the same side of the fold at +-90 degrees as `near`.
TiltAngles Unfold(TiltAngles a, const TiltAngles& near)
{
	const double turns = std::round((a.tilt_direction - near.tilt_direction) / 180);
	a.tilt_direction -= 180 * turns;
	if (turns != 0)
	{
		a.lens_tilt = -a.lens_tilt;
		a.focal_plane_tilt = -a.focal_plane_tilt;
	}
	// A plane parallel to the axis is at 90 degrees and at -90.
	a.focal_plane_tilt -= 180 * std::round((a.focal_plane_tilt - near.focal_plane_tilt) / 180);
	return a;
}

TiltAngles AnglesOf(const StateLens& lens)
{
	return { lens.lens_tilt.value, lens.focal_plane_tilt.value, lens.tilt_direction.value, lens.focus_distance.value, lens.focal_length.value };
}

}

Eigen::Vector2d TiltVector(double lens_tilt_deg, double tilt_direction_deg)
{
	const double direction = tilt_direction_deg * tilt_lens::Pi / 180;
	return lens_tilt_deg * Eigen::Vector2d(std::sin(direction), std::cos(direction));
}

TiltDifference DifferenceOfTilts(const StateLens& from, const StateLens& to, Estimate StateLens::* angle)
{
	const double direction = from.tilt_direction.value;
	const TiltAngles own = AnglesOf(from), other = Unfold(AnglesOf(to), own);
	const auto vector = [angle](const TiltAngles& a) { return TiltVector(angle == &StateLens::focal_plane_tilt ? a.focal_plane_tilt : a.lens_tilt, a.tilt_direction); };
	const Eigen::Vector2d apart = vector(other) - vector(own);
	return { apart.dot(TiltVector(1, direction)), apart.dot(TiltVector(1, direction + 90)) };
}

TiltAngles AnglesFromPlane(const Vec3<double>& q, double w_mm)
{
	const tilt_lens::Lens<double> lens = tilt_lens::LensFromPlane(q, 1 / w_mm);
	TiltAngles a;
	double direction = tilt_lens::TiltDirection(lens.normal);
	double sign = 1;
	const double right_angle = 90 / DEGREES;
	if (direction > right_angle || direction <= -right_angle)
	{
		direction += direction > 0 ? -2 * right_angle : 2 * right_angle;
		sign = -1;
	}
	a.lens_tilt = sign * tilt_lens::AngleFromAxis(lens.normal) * DEGREES;
	a.tilt_direction = direction * DEGREES;
	// tan(focal_plane_tilt) is the slope of the plane towards the direction just found. A lens without tilt at infinity has no plane.
	const double across = -(q.x * std::sin(direction) + q.y * std::cos(direction));
	a.focal_plane_tilt = across == 0 ? 0 : std::atan(across / q.z) * DEGREES;
	a.focus_distance = 1 / q.z;
	a.focal_length = 1 / lens.power;
	return a;
}

void FillStateLens(const Vec3<double>& q, double w_mm, const Eigen::Matrix4d& covariance, StateLens& lens)
{
	const TiltAngles a = AnglesFromPlane(q, w_mm);
	Eigen::Matrix<double, 4, 4> J;
	// Of q's length: q_z is 0 where the focus is at infinity, and so is q of a lens without tilt.
	const double scale = std::max(Length(q), 1e-4 / w_mm);
	for (int k = 0; k < 4; ++k)
	{
		const double step = 1e-4 * (k < 3 ? scale : w_mm);
		const auto moved = [&](double h)
		{
			const Vec3<double> m{ q.x + (k == 0) * h, q.y + (k == 1) * h, q.z + (k == 2) * h };
			return Unfold(AnglesFromPlane(m, w_mm + (k == 3) * h), a);
		};
		const TiltAngles p = moved(step), n = moved(-step);
		J.col(k) << p.lens_tilt - n.lens_tilt, p.focal_plane_tilt - n.focal_plane_tilt,
			p.tilt_direction - n.tilt_direction, p.focal_length - n.focal_length;
		J.col(k) /= 2 * step;
	}
	const Eigen::Matrix4d c = J * covariance * J.transpose();
	const auto sigma = [&](int k) { return std::sqrt(std::max(c(k, k), 0.0)); };
	lens.q = q;
	lens.q_sigma = { std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1)), std::sqrt(covariance(2, 2)) };
	lens.lens_tilt = { a.lens_tilt, sigma(0) };
	lens.focal_plane_tilt = { a.focal_plane_tilt, sigma(1) };
	lens.tilt_direction = { a.tilt_direction, sigma(2) };
	lens.focus_distance = { a.focus_distance, lens.q_sigma.z / (q.z * q.z) };   // steps could reach to the other side of infinity
	lens.focal_length = { a.focal_length, sigma(3) };
}

void TellFocusDistance(StateLens& lens)
{
	if (lens.q.z != 0)
		lens.focus_distance.sigma = lens.q_sigma.z / (lens.q.z * lens.q.z);
}

}
