// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The word `aberrations` in a camera: its scale, its steps beside those of other effects, what is refused, and what the reports say of focus.

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/aberrated_lens.h"
#include "lens/effects.h"
#include "lens/field_curvature.h"
#include "lens/lens_spec.h"
#include "lens/statistics.h"
#include "lens/words.h"
#include "unit/resolved_lens.h"

using namespace tilt_lens;
using testing::HasSubstr;

namespace
{

const CameraVectors Camera = { { 0, 0, 0 }, { 0, 0, 1 }, { 0.8, 0, 0 }, { 0, 0.6, 0 } };

LensSpec Tilted()
{
	LensSpec spec;
	spec.enabled = true;
	spec.lens_tilt = 8.0;
	spec.tilt_direction = 40.0;
	spec.focal_distance = 5.0;
	spec.aperture_diameter = 0.25;
	return spec;
}

LensSpec Aberrated()
{
	LensSpec spec = Tilted();
	spec.aberrations_given = true;
	const double numbers[AberrationTerms] = { -1, 2, 3, -2, 4, -6, 0.5, 0.4, -0.3, 0.2, 0.1, -0.2, 0.3, -0.4, 0.5, 0.6 };
	std::copy(numbers, numbers + AberrationTerms, spec.aberrations);
	return spec;
}

TiltLens Resolved(const LensSpec& spec) { return ResolvedFor(spec, Camera); }

std::string RefusalOf(const LensSpec& spec) { return RefusalFor(spec, Camera); }

LensRay Sent(const TiltLens& lens, const Vec3d& pixel, double u, double v)
{
	LensRay ray = {};
	ray.pixel = ray.v = pixel;
	ray.lens_u = u;
	ray.lens_v = v;
	ray.wavelength = GreenWavelength;
	ray.weight = 1;
	for(const LensStep* step = lens.steps; *step != NULL; step++)
		(*step)(lens, ray);
	return ray;
}

const Vec3d Pixels[] = { { 0, 0, 1 }, { 0.38, -0.27, 1 }, { -0.2, 0.25, 1 } };
const double Samples[][2] = { { 0.5, 0.5 }, { 0.9, 0.6 }, { 0.1, 0.2 }, { 0.45, 1.0 } };

void ExpectNear(const Vec3d& a, const Vec3d& b, double limit)
{
	EXPECT_NEAR(a.x, b.x, limit);
	EXPECT_NEAR(a.y, b.y, limit);
	EXPECT_NEAR(a.z, b.z, limit);
}

}

// By light that goes backwards from the sensor's point to a point of the exit pupil, m w before the sensor, and then through the map: the
// camera's steps, pupil_magnification among them, are that lens. The glass's f is by the formula of MODEL.md.
TEST(AberratedLens, IsTheMapBetweenItsPupils)
{
	for(double m : { 0.8, 1.0, 1.25 })
	for(bool etendue : { false, true })
	{
		LensSpec spec = Aberrated();
		spec.aberrations_etendue = etendue;
		spec.pupil_magnification = m;
		const TiltLens lens = Resolved(spec);
		ASSERT_TRUE(lens.aberrates);
		EXPECT_EQ(lens.aberrations.radius, 0.125);
		EXPECT_NEAR(lens.aberrations.c[Coma], 2e-3 / lens.power, 1e-18) << "thousandths of the focal length";
		const double w = lens.image_distance, cosine = Dot(lens.normal, lens.axis);
		const RealLens<double> real = { m, (lens.power + (m - 1) * cosine / w) / m, lens.aberrations, etendue };
		for(const Vec3d& pixel : Pixels)
			for(const auto& sample : Samples)
			{
				const LensRay ray = Sent(lens, pixel, sample[0], sample[1]);
				const PupilPoint p = SquareToDisc(sample[0], sample[1]);
				// The sensor's point from the exit pupil's middle: the image is upside down.
				const Vec3d sensor = { -w * pixel.x, -w * pixel.y, -m * w };
				const PupilRay<double> image = RayToSensor(m * p.x * 0.125, m * p.y * 0.125, Dot(sensor, lens.basis_x), Dot(sensor, lens.basis_y), -Dot(sensor, lens.normal));
				const PupilRay<double> object = ObjectSideRay(real, image);
				ExpectNear(ray.S, object.x * lens.basis_x + object.y * lens.basis_y, 1e-15);
				const Vec3d b = object.slope_x * lens.basis_x + object.slope_y * lens.basis_y + lens.normal;
				ExpectNear((1 / Dot(ray.R, lens.normal)) * ray.R, b, 2e-15);
			}
	}
}

// What other words do comes first; the aberrations are added to it.
TEST(AberratedLens, AddsToWhatOtherWordsDo)
{
	LensSpec spec = Aberrated();
	spec.field_curvature = -0.3;
	spec.distortion_given = true;
	spec.distortion[0] = -0.1;
	spec.blades = 5.0;
	spec.lateral_given = true;
	spec.lateral[RedWavelength] = 0.01;
	LensSpec without = spec;
	without.aberrations_given = false;
	const TiltLens lens = Resolved(spec), plain = Resolved(without);
	EXPECT_EQ(EffectNames(lens), EffectNames(plain) + ", aberrations");
	for(const Vec3d& pixel : Pixels)
		for(const auto& sample : Samples)
		{
			const LensRay ray = Sent(lens, pixel, sample[0], sample[1]), before = Sent(plain, pixel, sample[0], sample[1]);
			const double depth = Dot(before.R, plain.normal);
			const PupilRay<double> there = Aberrate(lens.aberrations, PupilRay<double>{ Dot(before.S, plain.basis_x), Dot(before.S, plain.basis_y),
			                                        Dot(before.R, plain.basis_x) / depth, Dot(before.R, plain.basis_y) / depth });
			ExpectNear(ray.S, there.x * lens.basis_x + there.y * lens.basis_y, 1e-16);
			ExpectNear(ray.R, depth * (there.slope_x * lens.basis_x + there.slope_y * lens.basis_y + lens.normal), 1e-15);
		}
}

// No word, or nothing but zeros: not one step more, and the ray of the lens without, to the last bit.
TEST(AberratedLens, OfZerosHasNoStep)
{
	LensSpec zeros = Tilted();
	zeros.aberrations_given = true;
	EXPECT_FALSE(Resolved(zeros).has_effects);
	EXPECT_EQ(Resolved(zeros).steps[3], nullptr);
	zeros.aberrations[Fifth_RRR] = 1;
	EXPECT_TRUE(Resolved(zeros).aberrates_fifth);
	EXPECT_EQ(EffectNames(Resolved(zeros)), "aberrations");
}

// f_stop and focal_length of the block: the numbers belong to the glass, whatever the camera's own opening is.
TEST(AberratedLens, IsStoppedDownWithItsNumbersKept)
{
	LensSpec spec = Aberrated();
	spec.aberrations_focal_length = 2.0;
	spec.aberrations_f_stop = 4.0;
	const TiltLens open = Resolved(spec);
	EXPECT_EQ(open.aberrations.radius, 0.25);
	EXPECT_DOUBLE_EQ(open.aberrations.c[Coma], 4e-3);
	spec.aperture_diameter = 0.125;
	const TiltLens closed = Resolved(spec);
	// The same point of the glass, halfway out of the one and at the rim of the other: the same ray.
	const LensRay half = Sent(open, Pixels[1], 0.75, 0.5), rim = Sent(closed, Pixels[1], 1.0, 0.5);
	ExpectNear(half.S, rim.S, 1e-15);
	ExpectNear(half.R, rim.R, 1e-15);
	// Without an opening it needs one of its own.
	spec.aperture_diameter = 0.0;
	EXPECT_TRUE(Resolved(spec).moves_pinhole_rays);
	spec.aberrations_f_stop = Given<double>();
	EXPECT_THAT(RefusalOf(spec), HasSubstr("aberrations hold for an opening: give f_stop"));
}

TEST(AberratedLens, RefusesFoldsByName)
{
	LensSpec spec = Tilted();
	spec.aberrations_given = true;
	// p = P c / r = 1/3 on chief rays (test_aberrations.cpp), P about 0.3 in the corner that is farthest from the axis.
	const double limit = 1000 / 3.0 / 0.3 * 0.125 * Resolved(spec).power;
	spec.aberrations[Distortion] = 2 * limit;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("the aberrations fold inside the frame: at "));
	spec.aberrations[Distortion] = -2 * limit;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("Use smaller numbers, a smaller aperture or a narrower view"));
	spec.aberrations[Distortion] = 0.3 * limit;
	EXPECT_TRUE(Resolved(spec).aberrates);
	spec.aberrations[Distortion] = 1e7;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("distortion of aberrations must lie between"));
	spec.aberrations[Distortion] = NAN;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("distortion of aberrations must lie between"));
	spec = Aberrated();
	spec.aberrations_f_stop = -1.0;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("f_stop of aberrations must be greater than 0, but is -1"));
	spec = Aberrated();
	spec.aberrations_focal_length = HUGE_VAL;
	EXPECT_THAT(RefusalOf(spec), HasSubstr("focal_length of aberrations must be greater than 0"));
}

// A rim before the lens meets the ray that leaves it; one behind it, the ray that arrives, whatever happens to it later.
TEST(AberratedLens, RimsMeetTheRayWhereTheyStand)
{
	LensSpec spec = Aberrated();
	for(double& number : spec.aberrations)
		number *= 3;
	const TiltLens lens = Resolved(spec);
	int cut[2] = {}, passed[2] = {};
	for(int behind = 0; behind < 2; behind++)
	{
		const double Z = behind ? -0.5 : 0.6;
		LensSpec rimmed = spec;
		rimmed.rim_count = 1;
		rimmed.rims[0] = { 0.16, Z };
		LensSpec plain_rimmed = rimmed;
		plain_rimmed.aberrations_given = false;
		const TiltLens with = Resolved(rimmed), plain = Resolved(plain_rimmed);
		for(int i = 0; i < 400; i++)
		{
			const Vec3d pixel = { 0.4 * std::cos(0.7 * i), 0.3 * std::sin(0.9 * i), 1 };
			const double u = std::fmod(0.618 * i, 1), v = std::fmod(0.755 * i, 1);
			const LensRay ray = Sent(with, pixel, u, v);
			bool passes;
			if(behind)
				passes = Sent(plain, pixel, u, v).weight > 0;
			else
			{
				const LensRay bare = Sent(lens, pixel, u, v);
				const Vec3d at = bare.S + (Z / Dot(bare.R, lens.normal)) * bare.R - Z * lens.normal;
				passes = Length(at) <= 0.16;
			}
			EXPECT_EQ(ray.weight > 0, passes) << Z << ", " << i;
			(passes ? passed : cut)[behind]++;
		}
	}
	EXPECT_THAT(cut, testing::Each(testing::Gt(20))) << "both do something";
	EXPECT_THAT(passed, testing::Each(testing::Gt(20)));
}

// The mean of two inverse depths: where rays next to the middle come together, along and across the radius, by differences.
TEST(AberratedLens, FocusOfReportsIsThatOfTheMiddle)
{
	LensSpec spec = Aberrated();
	spec.field_curvature = 0.2;
	spec.distortion_given = true;
	spec.distortion[0] = 0.05;
	const TiltLens lens = Resolved(spec);
	for(const Vec3d& pixel : Pixels)
	{
		// Through S0 = 0, and a little right and up: rays of the plane through two of them need not meet, but d(S + Z b)/dS0 = A + Z B
		// has the trace and determinant that say where it vanishes.
		const double h = 1e-4;      // of the radius
		double A[2][2], B[2][2];
		const auto slopes = [&](const LensRay& ray) { return PupilRay<double>{ Dot(ray.S, lens.basis_x), Dot(ray.S, lens.basis_y),
			Dot(ray.R, lens.basis_x) / Dot(ray.R, lens.normal), Dot(ray.R, lens.basis_y) / Dot(ray.R, lens.normal) }; };
		for(int j = 0; j < 2; j++)
		{
			// SquareToDisc is linear along its axes.
			const PupilRay<double> plus = slopes(Sent(lens, pixel, 0.5 + (j == 0 ? h : 0) / 2, 0.5 + (j == 1 ? h : 0) / 2));
			const PupilRay<double> minus = slopes(Sent(lens, pixel, 0.5 - (j == 0 ? h : 0) / 2, 0.5 - (j == 1 ? h : 0) / 2));
			A[0][j] = plus.x - minus.x;
			A[1][j] = plus.y - minus.y;
			B[0][j] = plus.slope_x - minus.slope_x;
			B[1][j] = plus.slope_y - minus.slope_y;
		}
		// The two roots k = 1/Z of det(A k + B) = 0 have the mean of the linear coefficient.
		const double a = A[0][0] * A[1][1] - A[0][1] * A[1][0];
		const double b = A[0][0] * B[1][1] + B[0][0] * A[1][1] - A[0][1] * B[1][0] - B[0][1] * A[1][0];
		EXPECT_NEAR(InverseFocusAlongLensAxis(lens, pixel), -b / (2 * a), 1e-6);
	}
	// Without aberrations it is what the others say.
	spec.aberrations_given = false;
	spec.distortion_given = false;
	const TiltLens plain = Resolved(spec);
	for(const Vec3d& pixel : Pixels)
		EXPECT_NEAR(InverseFocusAlongLensAxis(plain, pixel), plain.Kappa(pixel) / Dot(pixel, plain.normal), 1e-15);
}

// Curvature alone is the bowl of C = -2 c / r^2, by the reports' count: the same pixels are focused behind the lens.
TEST(AberratedLens, CurvatureIsTheBowl)
{
	LensSpec spec;
	spec.enabled = true;
	spec.focal_distance = 20.0;
	spec.aperture_diameter = 0.02;
	spec.aberrations_given = true;
	const double c = 1e-4 * 0.3 / 2;    // C = -0.3
	spec.aberrations[Curvature] = c * Resolved(spec).power * 1e3;
	LensSpec bowl = spec;
	bowl.aberrations_given = false;
	bowl.field_curvature = -0.3;
	const TiltLens a = Resolved(spec), b = Resolved(bowl);
	for(const Vec3d& pixel : Pixels)
		EXPECT_NEAR(InverseFocusAlongLensAxis(a, pixel), b.Kappa(pixel), 1e-12 * (1.0 + std::fabs(b.Kappa(pixel))));   // the same up to rounding
	const FocusCounts with = CountFocus(a, Camera, 80, 60, 0, 0, 79, 59), wanted = CountFocus(b, Camera, 80, 60, 0, 0, 79, 59);
	EXPECT_GT(wanted.behind, 300u);
	EXPECT_NEAR(double(with.behind), double(wanted.behind), 1);
	EXPECT_NEAR(double(with.front), double(wanted.front), 1);
}

TEST(AberratedLens, IdleWithoutAnOpeningWhereMiddlesStay)
{
	LensSpec spec = Tilted();
	spec.aperture_diameter = 0.0;
	spec.aberrations_given = true;
	spec.aberrations_f_stop = 4.0;
	spec.aberrations[Spherical] = 1;
	EXPECT_EQ(IdleWords(spec, Resolved(spec)), "aberrations");
	spec.aberrations[Distortion] = 1;
	EXPECT_EQ(IdleWords(spec, Resolved(spec)), "");
}

TEST(AberratedLens, WordsOfTheBlock)
{
	EXPECT_EQ(AdviceOnAberrations("sperical"), "Unknown word 'sperical' in aberrations; did you mean 'spherical'?");
	EXPECT_EQ(AdviceOnAberrations("fifth_oder"), "Unknown word 'fifth_oder' in aberrations; did you mean 'fifth_order'?");
	EXPECT_THAT(AdviceOnAberrations("banana"), HasSubstr("the words are focal_length, f_stop, spherical, coma, astigmatism, curvature, distortion, pupil, fifth_order"));
	EXPECT_THAT(AdviceOnAberrations("blades"), HasSubstr("is their '}' missing before it?"));
	EXPECT_EQ(AdviceOn("coma"), "'coma' follows the word aberrations, as in 'aberrations { coma'.");
}
