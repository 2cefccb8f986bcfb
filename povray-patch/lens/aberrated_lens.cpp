// SPDX-License-Identifier: AGPL-3.0-or-later

#include "lens/aberrated_lens.h"

#include <algorithm>
#include <cmath>

#include "lens/angles.h"
#include "lens/ray_range.h"
#include "lens/refusal.h"
#include "lens/words.h"

namespace tilt_lens
{

namespace
{

PupilRay<double> InLensAxes(const TiltLens& lens, const LensRay& ray, double depth)
{
	return { Dot(ray.S, lens.basis_x), Dot(ray.S, lens.basis_y), Dot(ray.R, lens.basis_x) / depth, Dot(ray.R, lens.basis_y) / depth };
}

/// What follows asks the ray itself: v is its direction now, with the focus at infinity.
template<bool FifthOrder>
inline void AberrateRay(const TiltLens& lens, LensRay& ray)
{
	const double depth = Dot(ray.v, lens.normal);       // of R too
	PupilRay<double> there = Aberrate<FifthOrder>(lens.aberrations, InLensAxes(lens, ray, depth));
	if(lens.etendue_power != 0.0)
		there = ObliquePupil(lens.pupil_magnification, lens.etendue_power, there);
	ray.S = there.x * lens.basis_x + there.y * lens.basis_y;
	ray.R = depth * (there.slope_x * lens.basis_x + (there.slope_y * lens.basis_y + lens.normal));
	ray.v = ray.R;
	ray.kappa = 0.0;
}

LensStep AberratingStep(const TiltLens& lens)
{
	return lens.aberrates_fifth ? &AberrateFifthOrder : &AberrateThirdOrder;
}

/// The ray of a pixel through the point (x, y) of the unit disc up to where it is aberrated.
LensRay BeforeAberrations(const TiltLens& lens, const Vec3d& pixel, int wavelength, double x, double y)
{
	LensRay ray = {};
	ray.pixel = ray.v = pixel;
	ray.lens_u = ray.lens_v = 0.5;
	ray.wavelength = wavelength;
	ray.weight = 1.0;
	const LensStep last = AberratingStep(lens);
	for(const LensStep* step = lens.steps; *step != NULL && *step != last; step++)
		(*step)(lens, ray);
	ray.S = x * lens.lens_x + y * lens.lens_y;
	ray.R = RayDirection(ray.v, ray.S, ray.kappa);
	return ray;
}

}

void AberrateThirdOrder(const TiltLens& lens, LensRay& ray)
{
	AberrateRay<false>(lens, ray);
}

void AberrateFifthOrder(const TiltLens& lens, LensRay& ray)
{
	AberrateRay<true>(lens, ray);
}

bool AberratesPinholeRays(const TiltLens& lens)
{
	const double* c = lens.aberrations.c;
	return c[Distortion] != 0.0 || c[PupilAberration] != 0.0 || c[Fifth_PPR] != 0.0 || c[Fifth_PPP] != 0.0;
}

void TakeAberrations(const LensSpec& spec, TiltLens& lens)
{
	const std::string word = NameOf(Word::Aberrations);
	const Given<double>& focal_length = spec.aberrations_focal_length;
	const Given<double>& f_stop = spec.aberrations_f_stop;
	if(focal_length && !(focal_length.value > 0.0 && IsFinite(focal_length.value)))
		Refuse("tilt_lens: focal_length of %s must be greater than 0, but is %g.", word.c_str(), focal_length.value);
	if(f_stop && !(f_stop.value > 0.0 && IsFinite(f_stop.value)))
		Refuse("tilt_lens: f_stop of %s must be greater than 0, but is %g.", word.c_str(), f_stop.value);
	const double unit = focal_length ? focal_length.value : 1.0 / std::fabs(lens.power);
	for(int i = 0; i < AberrationTerms; i++)
	{
		const char* name = AberrationWords[std::min(i, ThirdOrderTerms)];
		if(!(std::fabs(spec.aberrations[i]) <= 1e6))
			Refuse("tilt_lens: %s of %s must lie between -1e6 and 1e6 thousandths of the focal length, but is %g.", name, word.c_str(), spec.aberrations[i]);
		lens.aberrations.c[i] = spec.aberrations[i] * 1e-3 * unit;
		lens.aberrates |= spec.aberrations[i] != 0.0;
		lens.aberrates_fifth |= i >= ThirdOrderTerms && spec.aberrations[i] != 0.0;
	}
	if(spec.aberrations_etendue)
	{
		const double m = lens.pupil_magnification, cosine = Dot(lens.normal, lens.axis);
		lens.aberrates = true;
		lens.etendue_power = (lens.power + (m - 1.0) * cosine / lens.image_distance) / m;
	}
	lens.aberrations.radius = f_stop ? 0.5 * unit / f_stop.value : 0.5 * lens.aperture_diameter;
	if(lens.aberrates && !(lens.aberrations.radius > 0.0 && IsFinite(lens.aberrations.radius)))
		Refuse("tilt_lens: %s hold for an opening: give f_stop among them, or the camera an aperture_diameter or f_stop.", word.c_str());
}

void CheckAberrations(const CameraVectors& camera, TiltLens& lens)
{
	const double radius = 0.5 * lens.aperture_diameter;
	// A square opening has corners.
	const double share = lens.square ? std::sqrt(2.0) : 1.0;
	double slope = 0.0, reach = radius, longest = 0.0;
	for(int i = 0; i <= 32; i++)
		for(int j = 0; j <= 32; j++)
		{
			// Half a percent beyond the frame, where anti-aliasing may ask.
			const Vec3d pixel = lens.direction + (1.01 * (i / 32.0 - 0.5)) * camera.right + (1.01 * (j / 32.0 - 0.5)) * camera.up;
			if(!(lens.Depth(pixel) > 0.0))
				continue;
			for(int turn = 0; turn < 8; turn++)
			{
				const double angle = 0.25 * Pi * turn;
				LensRay ray = BeforeAberrations(lens, pixel, turn % Wavelengths, share * std::cos(angle), share * std::sin(angle));
				const PupilRay<double> linear = InLensAxes(lens, ray, Dot(ray.v, lens.normal));
				slope = std::max(slope, std::hypot(linear.slope_x, linear.slope_y));
				AberratingStep(lens)(lens, ray);
				reach = std::max(reach, ScaledLength(ray.S));
				longest = IsFinite(ray.R) ? std::max(longest, MaxAbs(ray.R)) : HUGE_VAL;
			}
		}
	const AberrationFold fold = FindFold(lens.aberrations, slope, share * radius / lens.aberrations.radius);
	if(fold.folds)
		Refuse("tilt_lens: the aberrations fold inside the frame: at %.3g degrees from the lens's axis, %.3g of the radius for which they are "
		       "given from its centre, two rays become one. Use smaller numbers, a smaller aperture or a narrower view.",
		       std::atan(fold.slope) * DegreesPerRadian, fold.height);
	if(!(longest < LongestRay) || !IsFinite(reach))
		Refuse("tilt_lens: with these aberrations rays would be %g long, which must be below %g.", longest, LongestRay);
	// Between the places that were looked at it may be a little more.
	lens.reach = radius > 0.0 ? 1.0 + 1.1 * (reach / radius - 1.0) : 1.0;
	lens.reach_of_pinhole = radius > 0.0 ? 0.0 : 1.1 * reach;
}

double InverseFocusAlongLensAxis(const TiltLens& lens, const Vec3d& v)
{
	const LensRay ray = BeforeAberrations(lens, v, GreenWavelength, 0.0, 0.0);
	const double depth = Dot(ray.v, lens.normal), kappa = ray.kappa / depth;
	if(!lens.aberrates)
		return kappa;
	// With S0 moved by r dq, b0 moves by -kappa r dq: how S and b follow, and where S + Z b then stays.
	const double r = lens.aberrations.radius;
	double J[4][4], A[2][2], B[2][2];
	const PupilRay<double> linear = InLensAxes(lens, ray, depth);
	AberrationJacobian(lens.aberrations, linear, J);
	for(int i = 0; i < 2; i++)
		for(int j = 0; j < 2; j++)
		{
			A[i][j] = J[i][j] - kappa * r * J[i][2 + j];
			B[i][j] = J[2 + i][j] - kappa * r * J[2 + i][2 + j];
		}
	if(lens.etendue_power != 0.0)
	{
		const PupilRay<double> aberrated = Aberrate<true>(lens.aberrations, linear);
		for(int j = 0; j < 2; j++)
		{
			const PupilRay<double> change = { r * A[0][j], r * A[1][j], B[0][j], B[1][j] };
			const Across<double> moved = ChangeOfObliquePupil(lens.pupil_magnification, lens.etendue_power, aberrated, 0.0, 0.0, change);
			A[0][j] = moved.x / r;
			A[1][j] = moved.y / r;
		}
	}
	const double determinant = A[0][0] * A[1][1] - A[0][1] * A[1][0];
	const double trace = B[0][0] * A[1][1] - B[0][1] * A[1][0] + B[1][1] * A[0][0] - B[1][0] * A[0][1];
	return determinant != 0.0 ? -0.5 * trace / (determinant * r) : kappa;
}

}
