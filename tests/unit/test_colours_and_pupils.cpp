// SPDX-License-Identifier: AGPL-3.0-or-later
//
// chromatic and pupil_magnification: the formulas against their definitions, the steps that a lens gets, and what is
// refused.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/chromatic.h"
#include "lens/effects.h"
#include "lens/lens_spec.h"
#include "lens/optics.h"
#include "lens/pupil_magnification.h"
#include "lens/statistics.h"
#include "unit/resolved_lens.h"

using namespace tilt_lens;
using testing::HasSubstr;

namespace
{

typedef Vec3<double> V;

const double Degree = 3.14159265358979323846 / 180.0;
const CameraVectors Camera = { { 0, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 }, { 0, 1, 0 } };

int StepsOf(const TiltLens& lens)
{
	int n = 0;
	while(lens.steps[n] != NULL)
		n++;
	return n;
}

TiltLens Resolved(const LensSpec& spec) { return ResolvedFor(spec, Camera); }

std::string RefusalOf(const LensSpec& spec) { return RefusalFor(spec, Camera); }

}

// A point at the tangent t of the angle from the axis is imaged at (1 + C) t.
TEST(Chromatic, LateralScalesTheTangentAboutTheLensAxis)
{
	const V n = LensNormalFromTilt(25 * Degree, 70 * Degree);
	const LensBasis<double> basis = BasisOfLensPlane(n);
	for(double C : { -0.02, 0.0, 0.013 })
	{
		const V scene = n + 0.3 * basis.a - 0.2 * basis.b, image = n + ((1 + C) * 0.3) * basis.a - ((1 + C) * 0.2) * basis.b;
		EXPECT_NEAR(Length(LateralDirection(n, C, 7.0 * image) - 7.0 * scene), 0, 1e-14);
	}
}

// n/f = q + e_z/w with 1/f larger by A gives the plane q + A n.
TEST(Chromatic, AxialIsThePlaneOfALensOfMorePower)
{
	const V q = { 0.01, -0.03, 0.02 };
	const double A = 0.004, inverse_w = 1 / 1.5;
	const Lens<double> lens = LensFromPlane(q, inverse_w);
	const V moved = PlaneFromLens(lens.normal, lens.power + A, inverse_w);
	for(const V& v : { V{ 0, 0, 1 }, V{ 0.4, -0.3, 1 } })
		EXPECT_NEAR(AxialFocus(lens.normal, A, v, Dot(q, v)), Dot(moved, v), 1e-16);
}

// By construction of the two pupils: light that enters at the tangent t leaves at t / M, and meets the sensor, M w
// behind the exit pupil, where it would have met it without; for a tilted lens, where the line meets the plane.
TEST(PupilMagnification, LeavesTheUprightPictureAlone)
{
	const V e = { 0, 0, 1 };
	for(double M : { 0.5, 1.07, 2.0 })
	{
		const V pixel = { 0.3, -0.2, 1 };
		EXPECT_NEAR(Length(DirectionBeforePupils(e, M, DirectionFromExitPupil(e, M, pixel)) - pixel), 0, 1e-15);
	}
}

TEST(PupilMagnification, FollowsTheLightThroughBothPupils)
{
	const V e = { 0, 0, 1 }, n = LensNormalFromTilt(-9 * Degree, 50 * Degree);
	const LensBasis<double> basis = BasisOfLensPlane(n);
	const double M = 1.4, w = 48;
	const double X = 0.31, Y = -0.22;                               // tangents before the lens
	const V behind = n + (X / M) * basis.a + (Y / M) * basis.b;     // and behind it, turned round
	const V sensor = (M * w / behind.z) * behind;                   // where the line from the exit pupil meets z = M w
	const V pixel = { sensor.x, sensor.y, w };
	const V v = DirectionBeforePupils(n, M, DirectionFromExitPupil(e, M, pixel));
	EXPECT_NEAR(Dot(v, basis.a) / Dot(v, n), X, 1e-15);
	EXPECT_NEAR(Dot(v, basis.b) / Dot(v, n), Y, 1e-15);
	EXPECT_NEAR(Length(DirectionBehindPupils(n, M, DirectionBeforePupils(n, M, sensor)) - sensor), 0, 1e-13);
}

// n = (-sin 60, 0, cos 60), and behind both pupils the tangents about it are 1/M of those before: rays leave where x < M / tan 60, by the line from the
// exit pupil, M w before the sensor, that grazes the lens plane.
TEST(PupilMagnification, RaysLeaveForwardsWhereTheExitPupilSeesThem)
{
	LensSpec spec;
	spec.enabled = true;
	spec.lens_tilt = 60.0;
	spec.tilt_direction = 90.0;
	spec.focal_distance = 5.0;
	spec.aperture_diameter = 0.1;
	for(double M : { 0.5, 1.3, 2.0 })
	{
		spec.pupil_magnification = M;
		const TiltLens lens = Resolved(spec);
		const double last = M / std::tan(60 * Degree);
		for(double x : { -0.9, 0.0, last - 0.01, last + 0.01, 0.99 })
		{
			LensRay ray = {};
			ray.pixel = ray.v = lens.direction + 0.5 * x * Camera.right;
			ray.lens_u = 0.8;
			ray.lens_v = 0.3;
			EXPECT_EQ(lens.Depth(ray.v) > 0.0, x < last) << M << " " << x;
			for(const LensStep *step = lens.steps; *step != NULL; step++)
				(*step)(lens, ray);
			EXPECT_EQ(Dot(ray.R, lens.normal) > 0.0, x < last) << M << " " << x;
		}
		// Half a pixel of 1000.
		EXPECT_NEAR(CountFocus(lens, Camera, 1000, 10, 0, 0, 999, 9).empty / 10000.0, std::max(0.0, 0.5 * (1.0 - last)), 1e-3) << M;
	}
}

// The plane of focus that makes a lens parallel to the axis: there is no light on its axis that any could be relative to.
TEST(Effects, NaturalVignettingNeedsALensAxis)
{
	LensSpec spec;
	spec.enabled = true;
	spec.image_distance = 1.0;
	spec.focal_plane_point = V{ 0, 0, -1 };
	spec.focal_plane_normal = V{ 0, 1, 1 };
	spec.aperture_diameter = 0.1;
	Resolved(spec);
	spec.natural_vignetting = true;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("tilted by 90 degrees"));
}

// What is not named has no step: three make the lens itself, and one more each effect.
TEST(Effects, OnlyWhatIsNamedHasAStep)
{
	LensSpec spec;
	spec.enabled = true;
	spec.aperture_diameter = 0.2;
	EXPECT_FALSE(Resolved(spec).has_effects);
	EXPECT_EQ(StepsOf(Resolved(spec)), 3);
	EXPECT_EQ(EffectNames(Resolved(spec)), "");

	spec.blades = 5.0;
	spec.field_curvature = 0.1;
	EXPECT_TRUE(Resolved(spec).has_effects);
	EXPECT_EQ(StepsOf(Resolved(spec)), 3) << "they stand in the place of the disc and the plane";
	EXPECT_EQ(EffectNames(Resolved(spec)), "blades, field_curvature");
	EXPECT_FALSE(Resolved(spec).moves_pinhole_rays);

	spec.natural_vignetting = true;
	spec.axial[RedWavelength] = 0.01;
	const TiltLens lens = Resolved(spec);
	EXPECT_EQ(StepsOf(lens), 5);
	EXPECT_TRUE(lens.weighs && lens.splits && lens.moves_pinhole_rays);
	EXPECT_EQ(EffectNames(lens), "blades, field_curvature, chromatic axial, vignetting natural");

	// One rim before the lens has a step of its own, any others have one together; the effect is named once.
	spec = LensSpec();
	spec.enabled = true;
	spec.rims[0] = { 1.0, 4.0 };
	spec.rims[1] = { 1.0, 0.0 };
	for(spec.rim_count = 1; spec.rim_count <= 2; spec.rim_count++)
	{
		EXPECT_EQ(StepsOf(Resolved(spec)), 4);
		EXPECT_EQ(EffectNames(Resolved(spec)), "vignetting optical");
		EXPECT_TRUE(Resolved(spec).weighs && Resolved(spec).moves_pinhole_rays);
	}

	spec = LensSpec();
	spec.enabled = true;
	spec.lateral_given = true;
	EXPECT_FALSE(Resolved(spec).has_effects) << "chromatic 0, 0 is none";
}

TEST(Effects, RefusalsSayWhatIsAllowed)
{
	LensSpec good;
	good.enabled = true;
	LensSpec spec = good;
	spec.blades = 5.5;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("whole number from 3 to 64, but is 5.5"));
	spec = good;
	for(const Rim rim : { Rim{ 0.0, 4.0 }, Rim{ -1.0, 4.0 }, Rim{ 1.0, HUGE_VAL }, Rim{ std::nan(""), 1.0 } })
	{
		spec.rim_count = 2;
		spec.rims[0] = { 1.0, 4.0 };
		spec.rims[1] = rim;
		EXPECT_THAT(RefusalOf(spec), HasSubstr("a radius greater than 0 and a finite distance")) << rim.radius << " " << rim.distance;
	}
	spec.rims[1] = { 1.0, -1e6 };
	EXPECT_THAT(RefusalOf(spec), HasSubstr("1e+06 behind the lens, beyond the sensor"));
	spec = good;
	spec.pupil_magnification = -1.0;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("but is -1"));
	spec = good;
	spec.axial[BlueWavelength] = 1e300;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("chromatic axial 1e+300 is too large"));
	spec = good;
	// Red's image is half as large, so that its corners lie where the distortion folds.
	spec.distortion_given = true;
	spec.distortion[0] = -0.1;
	Resolved(spec);
	spec.lateral[RedWavelength] = -0.45;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("folds inside the frame"));
}
