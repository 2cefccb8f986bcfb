// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the closed loops count: nothing that is off passes as good, and what is not told does not count.

#include "closed_loop_page.h"
#include "base/files.h"
#include "lens/optical_vignetting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cameras;

Result Of(const std::string& name, std::vector<Deviation> deviations)
{
	Result r;
	r.camera.name = name;
	r.light = "snr200";
	r.answer.deviations = std::move(deviations);
	return r;
}

Result RefusedOf(const std::string& name)
{
	Result r = Of(name, {});
	r.answer.refusal = "no board";
	return r;
}

TEST(ClosedLoop, AnErrorWithoutASigmaIsOutside)
{
	EXPECT_EQ(Deviation({ "k1", 0.00169, 0, 0 }).InSigmas(), -HUGE_VAL);
	EXPECT_EQ(Deviation({ "w", 48, 48.1, 0 }).InSigmas(), HUGE_VAL);
	EXPECT_EQ(Deviation({ "w", 48, 48, 0 }).InSigmas(), 0);
	EXPECT_EQ(Deviation({ "w", 48, 48.1, 0.1 }).InSigmas(), (48.1 - 48) / 0.1);
	// What is no number promises nothing that could be kept; an infinite sigma would hold everything.
	for (const Deviation& d : { Deviation{ "w", 48, NAN, 1 }, Deviation{ "w", 48, 48, NAN }, Deviation{ "w", 48, 48, HUGE_VAL }, Deviation{ "w", 48, HUGE_VAL, HUGE_VAL } })
		EXPECT_TRUE(std::isinf(d.InSigmas()));
	const Coverage c = CoverageOfAll({ Of("a", { { "w", 48, 48.1, 0 }, { "f", 45, 45, 1 } }) });
	EXPECT_EQ(c.inside, 1);
	EXPECT_EQ(c.all, 2);
	EXPECT_TRUE(std::isinf(c.worst));
	EXPECT_EQ(c.mean, 5) << "10 and 0";
}

TEST(ClosedLoop, RimsOfTheThinLensAreTwoDiscs)
{
	const double radius = 8, w = 48, distance = 500;
	const int points = 1200;
	// A rim's edge meets some 2 sqrt(points / pi) = 40 of the points' cells, and takes each or not: 4 standard deviations of that.
	const double bound = 4 * 0.5 * std::sqrt(2 * std::sqrt(points / M_PI)) / points;
	for (const synthetic::Rim& rim : { synthetic::Rim{ 10, 15 }, synthetic::Rim{ 9, -15 } })
	{
		synthetic::Scene scene;
		scene.width = 60;
		scene.height = 40;
		scene.w_px = w / 0.6;   // of a sensor of 36 mm
		scene.aperture = 2 * radius;
		scene.lens_points = points;
		scene.w = w;
		scene.rims = { rim };
		const cv::Mat picture = synthetic::TakePicture(scene, { [](double, double) { return 1.0f; } });
		// What the pixel sees is sharp, so that all its rays meet: the lens seen from there, and the rim.
		const double nearer = 1 - (rim.distance > 0 ? rim.distance / distance : -rim.distance / w);
		for (int y = 0; y < scene.height; y += 3)
			for (int x = 0; x < scene.width; x += 3)
			{
				const double slope = std::hypot(x - 29.5, y - 19.5) / scene.w_px;
				const double share = tilt_lens::OverlapOfDiscs(radius * nearer, rim.radius, std::abs(rim.distance) * slope) / (M_PI * std::pow(radius * nearer, 2));
				// A pixel is 0.6 mm wide: over it the share is nearly a straight line, bent by less than a thousandth.
				EXPECT_NEAR(picture.at<float>(y, x), share, bound + 1e-3) << x << " " << y << " " << rim.distance;
			}
		EXPECT_LT(picture.at<float>(0, 0), 0.9) << "a rim that cuts nothing tests nothing";
	}
}

TEST(ClosedLoop, WhatIsNotToldDoesNotCount)
{
	Result r = Of("a", { { "f", 45, 45, 1 } });
	r.answer.not_told = { "k1: not significant" };
	const Coverage c = CoverageOfAll({ r });
	EXPECT_EQ(c.inside, 1);
	EXPECT_EQ(c.all, 1);
	EXPECT_EQ(c.not_told, 1);
}

TEST(ClosedLoop, ARefusalIsExpectedByNameOrFailsTheRun)
{
	const std::vector<Result> results = { Of("random 1", { { "f", 45, 45, 1 } }), RefusedOf("random 3"), RefusedOf("random 30") };
	EXPECT_EQ(RefusalsOf(results, {}).unexpected.size(), 2u);
	const Refusals one = RefusalsOf(results, { "random 3," });
	EXPECT_EQ(one.all.size(), 2u);
	ASSERT_EQ(one.unexpected.size(), 1u);
	EXPECT_EQ(one.unexpected[0]->camera.name, "random 30");
	EXPECT_TRUE(RefusalsOf(results, { "random 3, snr200", "random 30" }).unexpected.empty());
	const std::string page = testing::TempDir() + "closed-loop.md";
	WritePage(page, "closed_loop", results, { "random 3," });
	EXPECT_THAT(tiltcal::ReadText(page, "page"), testing::HasSubstr("Without an answer: 2 of 3 sets, 1 of them unexpected, which fails the run. **random 30, snr200**."));
}

TEST(ClosedLoop, AShareHasItsBinomialInterval)
{
	// Wilson's, as tables of it have it: 8 of 10, 0 of 10.
	EXPECT_NEAR(IntervalOf(8, 10).low, 0.490, 0.001);
	EXPECT_NEAR(IntervalOf(8, 10).high, 0.943, 0.001);
	EXPECT_EQ(IntervalOf(0, 10).low, 0);
	EXPECT_NEAR(IntervalOf(0, 10).high, 0.278, 0.001);
	EXPECT_EQ(IntervalOf(0, 0).high, 1);
	EXPECT_TRUE(IntervalOf(80, 100).IsOutside(0.9, 0.99));
	EXPECT_TRUE(IntervalOf(1000, 1000).IsOutside(0.9, 0.99));
	EXPECT_FALSE(IntervalOf(85, 100).IsOutside(0.9, 0.99)) << "of a true 90 by chance";
}

TEST(ClosedLoop, NumbersThatHangTogetherSayLess)
{
	// Ten sets of four numbers, two of them wholly outside: as ten numbers say it.
	std::vector<Result> together, scattered;
	for (int set = 0; set < 10; ++set)
	{
		const double off = set < 2 ? 3 : 0;
		together.push_back(Of("a", { { "w", 0, off, 1 }, { "f", 0, off, 1 }, { "d", 0, off, 1 }, { "U", 0, off, 1 } }));
		scattered.push_back(Of("a", { { "w", 0, set < 8 ? 3. : 0., 1 }, { "f", 0, 0, 1 }, { "d", 0, 0, 1 }, { "U", 0, 0, 1 } }));
	}
	// sum (inside - p all)^2 = 2 3.2^2 + 8 0.8^2 = 25.6; times 10/9 over 40 0.8 0.2.
	EXPECT_NEAR(CoverageOfAll(together).clustering, 25.6 / 0.9 / 6.4, 1e-9);
	EXPECT_EQ(CoverageOfAll(scattered).clustering, 1);
	EXPECT_EQ(CoverageOfAll(together).Share(), CoverageOfAll(scattered).Share());
	EXPECT_GT(CoverageOfAll(together).Where().high, CoverageOfAll(scattered).Where().high);
}

TEST(ClosedLoop, ARimOfALensThatHasNoneIsCounted)
{
	std::vector<Result> results(20, Of("a", {}));
	results.push_back(RefusedOf("b"));
	EXPECT_EQ(CountMadeUpRims(results).sets, 20);
	tiltcal::Effect rim;
	rim.id = tiltcal::EffectId::VIGNETTING_OPTICAL;
	results[3].answer.calibration.effects = { rim };
	EXPECT_EQ(CountMadeUpRims(results).with, 0) << "it is not used";
	results[3].answer.calibration.effects[0].used = true;
	EXPECT_EQ(CountMadeUpRims(results).with, 1);
	EXPECT_FALSE(CountMadeUpRims(results).AreTooMany());
	results[4] = results[5] = results[3];
	EXPECT_TRUE(CountMadeUpRims(results).AreTooMany());
	results[3].camera.glass = "lens.txt";
	EXPECT_EQ(CountMadeUpRims(results).with, 2) << "glass may have rims";
}

TEST(ClosedLoop, FewerThanTheLeastAreOnceInAThousand)
{
	// Tables of the binomial distribution: P(X <= 12 | 20, 0.9) = 0.0004, P(X <= 13) = 0.0024; P(X <= 1 | 3, 0.5) = 0.5, P(X = 0) = 0.125.
	EXPECT_EQ(LeastInside(20, 0.9), 13);
	EXPECT_EQ(LeastInside(3, 0.5), 0);
	EXPECT_EQ(LeastInside(20, 1), 20);
	EXPECT_EQ(LeastInside(20, 0), 0);
}

}
