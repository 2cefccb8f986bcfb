// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/moving_rays.h"

#include <algorithm>

namespace tiltcal
{

namespace
{

using namespace real_lens;
using tilt_lens::AberrationTerms;
using tilt_lens::PupilRay;

PupilRay<double> ValueOf(const PupilRay<PlaceJet>& ray) { return { ray.x.a, ray.y.a, ray.slope_x.a, ray.slope_y.a }; }

template<size_t Size>
std::array<PlaceJet, Size> Numbered(const double* values, int first)
{
	std::array<PlaceJet, Size> numbers;
	for (size_t k = 0; k < Size; ++k)
		numbers[k] = PlaceJet(values[k], first + int(k));
	return numbers;
}

Eigen::Matrix<double, 4, PLACE_NUMBERS> DerivativeOf(const PupilRay<PlaceJet>& ray)
{
	Eigen::Matrix<double, 4, PLACE_NUMBERS> rows;
	rows << ray.x.v.transpose(), ray.y.v.transpose(), ray.slope_x.v.transpose(), ray.slope_y.v.transpose();
	return rows;
}

}

MovingRays::MovingRays(const double* state, const double* of_lens, const double* c, double r, double pitch_mm, double u, double v)
	: lens(Numbered<LENS_SIZE>(of_lens, STATE_SIZE)), opening(r * lens[OPENING]), radius(opening * lens[MAGNIFICATION]), mounted(Mount(state, c, r, pitch_mm, u, v))
{
	std::copy_n(c, AberrationTerms, aberrations.c);
	aberrations.radius = r;
}

MountedLens<PlaceJet> MovingRays::Mount(const double* state, const double* c, double r, double pitch_mm, double u, double v) const
{
	PlaceJet held[AberrationTerms];
	std::transform(c, c + AberrationTerms, held, [](double constant) { return PlaceJet(constant); });
	return { Numbered<STATE_SIZE>(state, 0).data(), lens.data(), held, r, pitch_mm, u, v };
}

MovingRay MovingRays::Through(double x, double y) const
{
	const PupilRay<PlaceJet> image = tilt_lens::RayToSensor(PlaceJet(radius * x), PlaceJet(radius * y), mounted.x, mounted.y, mounted.depth);
	const PupilRay<PlaceJet> linear = tilt_lens::BeforeLinearLens(mounted.lens.pupil_magnification, mounted.lens.power, image);
	const PupilRay<double> before = ValueOf(linear);
	double J[4][4];
	tilt_lens::AberrationJacobian(aberrations, before, J);
	PupilRay<double> by_c[AberrationTerms];
	tilt_lens::AberrateByCoefficients(aberrations, before, by_c);

	MovingRay ray;
	ray.image = ValueOf(image);
	ray.image_by = DerivativeOf(image);
	// Etendue's part: of S, b, m and the power, in six numbers rather than in all.
	using RayJet = ceres::Jet<double, 6>;
	const PupilRay<double> upright = tilt_lens::Aberrate<true>(aberrations, before);
	const PupilRay<RayJet> oblique = tilt_lens::ObliquePupil(RayJet(mounted.lens.pupil_magnification.a, 4), RayJet(mounted.lens.power.a, 5),
		PupilRay<RayJet>{ RayJet(upright.x, 0), RayJet(upright.y, 1), RayJet(upright.slope_x, 2), RayJet(upright.slope_y, 3) });
	ray.object = { oblique.x.a, oblique.y.a, upright.slope_x, upright.slope_y };
	// J is of (S/r, b).
	const Eigen::Vector4d unit(aberrations.radius, aberrations.radius, 1, 1);
	const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> of_pupil(&J[0][0]);
	ray.object_by.leftCols<PLACE_NUMBERS>() = unit.asDiagonal() * of_pupil * unit.cwiseInverse().asDiagonal() * DerivativeOf(linear);
	for (int k = 0; k < AberrationTerms; ++k)
		ray.object_by.col(PLACE_NUMBERS + k) << by_c[k].x, by_c[k].y, by_c[k].slope_x, by_c[k].slope_y;

	Eigen::Matrix<double, 2, 6> points_by;
	points_by << oblique.x.v.transpose(), oblique.y.v.transpose();
	const Eigen::Matrix<double, 2, RAY_NUMBERS> points = points_by.leftCols<4>() * ray.object_by;
	ray.object_by.topRows<2>() = points;
	ray.object_by.topLeftCorner<2, PLACE_NUMBERS>() += points_by.col(4) * mounted.lens.pupil_magnification.v.transpose() + points_by.col(5) * mounted.lens.power.v.transpose();
	return ray;
}

}
