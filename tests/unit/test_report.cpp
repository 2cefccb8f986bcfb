// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The statistics and the preview of focus, without POV-Ray.

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/optics.h"
#include "lens/preview.h"
#include "lens/statistics.h"
#include "unit/resolved_lens.h"

using namespace tilt_lens;
using testing::HasSubstr;

namespace
{

const CameraVectors Camera = { { 0, 0, 0 }, { 0, 0, 1 }, { 2, 0, 0 }, { 0, 1, 0 } };

TiltLens Resolved(double tilt, double direction, double distance, double aperture)
{
	LensSpec spec;
	spec.enabled = true;
	spec.focal_plane_tilt = tilt;
	spec.tilt_direction = direction;
	spec.focal_distance = distance;
	spec.aperture_diameter = aperture;
	return ResolvedFor(spec, Camera);
}

/// Squared changes of a pixel whose variance halves with every doubling, the latest first.
LevelChanges Halving(double latest)
{
	LevelChanges c;
	c.pixels = 1.0;
	for(int j = 0; j < ChangesKept; j++)
		c.change[j] = std::ldexp(latest, j);
	return c;
}

}

// z = U + x tan(A): kappa = 0 at v.x = 1/tan(A). With A = atan(2) that is v.x = 0.5,
// three quarters of the way across a frame of -1 to 1.
TEST(Statistics, SharesOfThePictureAreThoseOfThePlane)
{
	const TiltLens lens = Resolved(std::atan(2.0) * 180 / M_PI, 90.0, 50.0, 0.1);
	const FocusCounts c = CountFocus(lens, Camera, 800, 100, 0, 0, 799, 99);
	EXPECT_EQ(c.All(), 80000u);
	EXPECT_EQ(c.empty, 0u);
	EXPECT_NEAR(c.front, 60000, 101);   // one column of pixels either way
	EXPECT_NEAR(c.behind, 20000, 101);
	EXPECT_GT(c.infinity, 0u);
	EXPECT_LE(c.infinity, 200u);
	// The right half alone.
	EXPECT_EQ(CountFocus(lens, Camera, 800, 100, 400, 0, 799, 99).All(), 40000u);
}

// The ray directions that the renderer itself makes, between the corners of each pixel, beside the count's own formulas: w long, as calibrated cameras'
// are, pupils of two sizes, aberrations. What differs is where kappa is bent over a pixel.
TEST(Statistics, SharesAreThoseOfTheRays)
{
	const CameraVectors large = { { 0, 0, 0 }, { 0, 0, 50 }, { 100, 0, 0 }, { 0, 50, 0 } };
	for(int effects = 0; effects < 4; effects++)
	{
		SCOPED_TRACE(effects);
		LensSpec spec;
		spec.enabled = true;
		spec.lens_tilt = 20.0;
		spec.tilt_direction = 90.0;
		spec.focal_distance = 450.0;
		spec.aperture_diameter = 5.0;
		if(effects & 1)
			spec.pupil_magnification = 1.3;
		const TiltLens traced = ResolvedFor(spec, large);
		spec.aberrations_given = (effects & 2) != 0;
		spec.aberrations[Spherical] = 0.01;     // none through the middle of the lens
		const TiltLens lens = ResolvedFor(spec, large);
		const int width = 300, height = 40;
		FocusCounts rays;
		const auto kappa = [&](double x, double y)
		{
			LensRay ray;
			ray.pixel = ray.v = large.direction + (x / width - 0.5) * large.right + (0.5 - y / height) * large.up;
			ray.lens_u = ray.lens_v = 0.5;
			ray.wavelength = GreenWavelength;
			ray.weight = 1.0;
			for(const LensStep *step = traced.steps; *step != nullptr; step++)
				(*step)(traced, ray);
			return ray.kappa;
		};
		for(int y = 0; y < height; y++)
			for(int x = 0; x < width; x++)
			{
				const double corners[4] = { kappa(x, y), kappa(x + 1, y), kappa(x, y + 1), kappa(x + 1, y + 1) };
				const double most = *std::max_element(corners, corners + 4), least = *std::min_element(corners, corners + 4);
				(least > 0.0 ? rays.front : most < 0.0 ? rays.behind : rays.infinity)++;
			}
		ASSERT_GT(rays.behind, 100u);
		ASSERT_GT(rays.infinity, 30u);
		const FocusCounts count = CountFocus(lens, large, width, height, 0, 0, width - 1, height - 1);
		// A column of pixels either way.
		EXPECT_NEAR(double(count.front), double(rays.front), height);
		EXPECT_NEAR(double(count.behind), double(rays.behind), height);
		EXPECT_NEAR(double(count.infinity), double(rays.infinity), height);
	}
}

TEST(Statistics, PixelsBehindTheLensPlaneAreEmpty)
{
	// n = (-sin 60, 0, cos 60): v.n = 0 at v.x = 1/tan 60 = 0.577.
	LensSpec spec;
	spec.enabled = true;
	spec.lens_tilt = 60.0;
	spec.tilt_direction = 90.0;
	spec.focal_distance = 5.0;
	spec.aperture_diameter = 0.1;
	TiltLens lens;
	std::string error;
	ASSERT_TRUE(ResolveTiltLens(spec, Camera, lens, error)) << error;
	const FocusCounts c = CountFocus(lens, Camera, 1000, 10, 0, 0, 999, 9);
	EXPECT_NEAR(c.empty / 10000.0, 0.5 * (1.0 - 1.0 / std::sqrt(3.0)), 1.5e-3);
}

TEST(Statistics, TextNamesTheFigures)
{
	// Changes of independent samples halve: exponent 1, and the variance is the latest change.
	RenderCounts a, b;
	a.AddPixel(16, Halving(1e-6));
	a.AddLight(48, {}, false);
	b.AddPixel(64, Halving(3e-6));
	b.AddLight(50, {}, false);
	a += b;
	const TiltLens lens = Resolved(60.0, 90.0, 8.0, 0.5);
	const std::string text = StatisticsText(lens, CountFocus(lens, Camera, 8, 6, 0, 0, 7, 5), a);
	EXPECT_THAT(text, HasSubstr("60.000 deg to the sensor, receding towards 90.00 deg"));
	EXPECT_THAT(StatisticsText(Resolved(60.0, -1e-9, 8.0, 0.5), {}, a), HasSubstr("receding towards 0.00 deg"));
	EXPECT_THAT(text, HasSubstr("Distance:      8 along the axis"));
	EXPECT_THAT(text, HasSubstr("min 16  mean 40.00  max 64   Camera Rays: 98"));
	EXPECT_THAT(text, HasSubstr("0.00141 RMS"));          // sqrt(2e-6)
	EXPECT_THAT(StatisticsText(Resolved(0, 0, 8, 0), {}, {}), HasSubstr("a pinhole"));
}

TEST(Statistics, OneSampleDoesNotTellItsError)
{
	RenderCounts c;
	c.AddPixel(16, Halving(1e-6));
	c.AddLight(16, {}, false);
	EXPECT_TRUE(c.ErrorIsKnown());
	LevelChanges alone;
	alone.pixels = 1;
	alone.changes = 0;
	c.AddPixel(1, alone);
	c.AddLight(1, {}, false);
	EXPECT_FALSE(c.ErrorIsKnown());
	const TiltLens lens = Resolved(60.0, 90.0, 8.0, 0.5);
	const std::string text = StatisticsText(lens, CountFocus(lens, Camera, 8, 6, 0, 0, 7, 5), c);
	EXPECT_THAT(text, HasSubstr("Estimated Error: unknown, one sample a pixel does not tell\n"));
	EXPECT_THAT(text, testing::Not(HasSubstr("RMS")));
}

// denoise has no halves of one sample to judge by: what the neighbours say of such pixels stays.
TEST(Statistics, DenoiseKnowsNothingOfSingleSamples)
{
	RenderCounts c;
	c.AddPixel(16, Halving(1e-6));
	LevelChanges alone;
	alone.pixels = 1;
	alone.changes = 1;
	alone.change[0] = 4e-6;
	c.AddPixel(1, alone);
	const TiltLens lens = Resolved(60.0, 90.0, 8.0, 0.5);
	// sqrt((1e-6 + 4e-6) / 2), of which denoise takes the first.
	EXPECT_THAT(StatisticsText(lens, CountFocus(lens, Camera, 8, 6, 0, 0, 7, 5), c), HasSubstr("Estimated Error: 0.00158 RMS"));
	EXPECT_THAT(StatisticsText(lens, CountFocus(lens, Camera, 8, 6, 0, 0, 7, 5), c, 0.0), HasSubstr("Estimated Error: 0.00141 RMS"));
}

// Where pixels stopped early and the spread rests on single bright samples, the estimate is a bound.
TEST(Statistics, EstimateIsABoundWhereLightMayBeMissed)
{
	const TiltLens lens = Resolved(60.0, 90.0, 8.0, 0.5);
	const auto text = [&](double missed, double sigma, bool early)
	{
		RenderCounts c;
		c.AddPixel(16, Halving(1e-6));
		c.AddLight(16, { missed, sigma * sigma }, early);
		return StatisticsText(lens, CountFocus(lens, Camera, 8, 6, 0, 0, 7, 5), c);
	};
	// A quarter more than 0.001: 0.5625e-6 of its square.
	EXPECT_THAT(text(0.57e-6, 0.0, true), HasSubstr("Estimated Error: >= 0.00100 RMS"));
	EXPECT_THAT(text(0.3e-6, 0.3e-6, true), HasSubstr("  early may have missed them"));
	EXPECT_THAT(text(0.57e-6, 0.0, false), HasSubstr("  have met none; more blur_samples find them"));
	for(const std::string& sure : { text(0.55e-6, 0.0, true), text(0.3e-6, 0.2e-6, true), text(-1e-6, 1e-6, true), text(0.0, 0.0, true) })
	{
		EXPECT_THAT(sure, HasSubstr("Estimated Error: 0.00100 RMS"));
		EXPECT_THAT(sure, testing::Not(HasSubstr("at least")));
	}
}

// Horvitz and Thompson: of pixels that light meets with one of 1/p samples those that met it in the first n, weighted, stand for the others.
TEST(Statistics, MissedLightIsThatOfThePixelsThatMetNone)
{
	const double p = 0.03, light = 0.2;
	const int n = 8, pixels = 20000;
	std::mt19937 random(1);
	std::bernoulli_distribution meets(p);
	RareLight sum;
	double missed = 0.0;
	for(int k = 0; k < pixels; k++)
	{
		bool met = false;
		for(int i = 0; i < n; i++)
			met |= meets(random);
		missed += met ? 0.0 : light * light;
		if(met)
			sum += RareLight::Of(light, p, n, true);
	}
	// Four of its own standard deviations, beside which those of the count are small.
	EXPECT_NEAR(sum.missed, missed, 4.0 * std::sqrt(sum.variance));
	EXPECT_LT(std::sqrt(sum.variance), 0.03 * missed);
	// One that went on, and met it later, is no longer missing.
	const double before = sum.missed;
	sum += RareLight::Of(light, p, n, false);
	EXPECT_DOUBLE_EQ(sum.missed, before - light * light);
}

// The blur of the preview against the definition, w d |1/U - 1/z| in pixels.
TEST(Preview, BlurIsThePapersInPixels)
{
	const double d = 0.3, U = 7.0, z = 3.0, pixels_per_slope = 400.0;
	const PixelFocus pixel = { 1.0 / z, 1.0 / U, pixels_per_slope, false };
	EXPECT_NEAR(BlurInPixels(pixel, d), d * (1.0 / z - 1.0 / U) * pixels_per_slope, 1e-12);
	EXPECT_GT(BlurInPixels(pixel, d), 0.0) << "nearer than the focus";
	const PixelFocus sky = { 0.0, 1.0 / U, pixels_per_slope, false };
	EXPECT_NEAR(BlurInPixels(sky, d), -d / U * pixels_per_slope, 1e-12);
}

TEST(Preview, ColourInFocusGreyOutsideContoursBetween)
{
	const Rgb scene = { 0.8, 0.3, 0.1 };
	const auto at = [&](double blur) { return ShowFocus(scene, { blur / 100.0, 0.0, 100.0, false }, 1.0); };
	EXPECT_EQ(at(0.5).r, scene.r);
	EXPECT_EQ(at(-0.99).b, scene.b);
	EXPECT_LT(at(3.0).r, 0.5 * scene.r);
	EXPECT_GT(at(4.0).b, 0.5) << "a contour nearer than the focus is blue";
	EXPECT_GT(at(-8.0).r, 0.5) << "a contour beyond the focus is orange";
	EXPECT_LT(at(-8.0).b, 0.2);
	EXPECT_LT(at(5.5).b, 0.3) << "no contour between";
}

TEST(Preview, PlaneIsASheetWithATrace)
{
	const Rgb scene = { 0.2, 0.2, 0.2 };
	const auto at = [&](double z, double kappa) { return ShowPlane(scene, { 1.0 / z, kappa, 100.0, false }); };
	EXPECT_GT(at(10.0, 0.1).r, 0.8) << "on the plane";
	EXPECT_EQ(at(5.0, 0.1).r, scene.r) << "in front of the sheet";
	EXPECT_GT(at(20.0, 0.1).r, scene.r) << "through the sheet";
	EXPECT_EQ(at(20.0, -0.1).r, scene.r) << "the plane is behind the lens";
	EXPECT_EQ(ShowPlane(scene, { 0.0, 0.1, 100.0, false }).r, scene.r) << "no haze over the sky";
}
