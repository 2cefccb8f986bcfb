// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a camera does to the light, and what the verdict says of it.

#include "calibrate/check_light.h"
#include "camera_light.h"
#include "closed_loop.h"
#include "edge/tone_exponent.h"
#include "measure/clipped.h"
#include "model/footprint.h"
#include "model/predict.h"
#include "report/report_html.h"
#include "report/write_json.h"
#include "solve/each_edge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{

using namespace tiltcal;
using namespace cameras;

/// The photographs, once for all kinds of light: two states, three poses each, 0.3 megapixels.
const Negatives& Photographs()
{
	static const Negatives negatives = []
	{
		Camera camera = RandomCamera(7);
		camera.photos = 3;
		return Photograph(camera, 7);
	}();
	return negatives;
}

Calibration Developed(const char* light)
{
	const Answer answer = CloseTheLoop(Photographs(), LightOf(light), 1, testing::TempDir() + "light-" + light);
	EXPECT_EQ(answer.refusal, "") << light;
	return answer.calibration;
}

TEST(Light, LinearLightIsGood)
{
	const Calibration c = Developed("snr200");
	// 3 sigma, the bound above which it is said; by chance once in 370.
	EXPECT_LT(std::abs(c.light.bend.value), std::max(3 * c.light.bend.sigma, 0.004));
	EXPECT_EQ(c.light.clipped_share, 0);
	EXPECT_TRUE(JudgeLight(c.light).empty());
	EXPECT_TRUE(JudgeLightOfStates(c).empty());
	EXPECT_EQ(c.verdict.grade, Grade::GOOD);   // what is developed otherwise below is not good for that alone
	// By the real lens's places where that is the answer: here 0.03 of each radius to the bright side.
	Calibration real = c;
	real.real_lens.emplace();
	ForEachEdge(c.task, [&](size_t s, size_t p, const Edge& e) { real.real_lens->place_errors_px.push_back(-0.03 * 0.5 * PredictedBlur(c, s, p, e)); });
	EXPECT_EQ(CheckLight(real).bend.value, c.light.bend.value);
	real.real_lens->used = true;
	EXPECT_NEAR(CheckLight(real).bend.value, 0.03, 1e-9);
}

// Each biases blur by more than its sigma (the aperture by 7 to 25 %), so none may be good.
TEST(Light, SharpenedIsSaid)
{
	const Calibration c = Developed("sharpened");
	EXPECT_GT(c.verdict.grade, Grade::GOOD);
	ASSERT_FALSE(c.verdict.remarks.empty());
	EXPECT_NE(c.verdict.remarks[0].text.find("the photographs were sharpened"), std::string::npos) << c.verdict.remarks[0].text;
}

// The demosaicing blurs more than the sharpening takes off, so that edges are no steeper than they can be; but they overshoot.
TEST(Light, SharpeningIsSaidBehindAMosaic)
{
	const Calibration c = Developed("sharpened-bayer");
	EXPECT_LT(c.light.sharpening.value, 0);
	EXPECT_GT(c.light.overshoot.value, 3 * c.light.overshoot.sigma);
	EXPECT_GT(c.verdict.grade, Grade::GOOD);
	ASSERT_FALSE(c.verdict.remarks.empty());
	EXPECT_NE(c.verdict.remarks[0].text.find("overshoots beside sharp edges"), std::string::npos) << c.verdict.remarks[0].text;
	// A blur that is nowhere negative leaves edges that only rise, JPEG's ringing aside.
	for (const char* light : { "bayer", "bayer-jpeg" })
		EXPECT_TRUE(JudgeLight(Developed(light).light).empty()) << light;
}

// As a camera's own JPEGs have them, each beside the other; and clipped at the file's own full scale.
TEST(Light, WhatCamerasCookIsSaid)
{
	for (const char* light : { "sharpened-tone-curve", "cooked-jpeg", "clipped" })
	{
		const Calibration c = Developed(light);
		EXPECT_FALSE(JudgeLight(c.light).empty()) << light;
		EXPECT_GT(c.verdict.grade, Grade::GOOD) << light;
	}
}

TEST(Light, SharpenedPhotographsAreNotCalledMisfiled)
{
	// Two untilted photographs of this camera are sharper than the others, and are what sharpening changes most.
	const Answer answer = CloseTheLoop(Photograph(RandomCamera(3), 3), LightOf("sharpened"), 1, testing::TempDir() + "light-misfiled");
	ASSERT_EQ(answer.refusal, "");
	const std::vector<Remark>& remarks = answer.calibration.verdict.remarks;
	ASSERT_FALSE(remarks.empty());
	EXPECT_EQ(answer.calibration.verdict.grade, Grade::POOR);
	EXPECT_NE(remarks[0].text.find("sharpened"), std::string::npos) << remarks[0].text;
	for (const Remark& r : remarks)
		for (const char* accusation : { "file it", "camera shaken", "set the lens straight", "untilted_free" })
			EXPECT_EQ(r.text.find(accusation), std::string::npos) << r.text;
}

TEST(Light, ToneCurveIsSaid)
{
	const Calibration c = Developed("tone-curve");
	EXPECT_GT(std::abs(c.light.bend.value), 5 * c.light.bend.sigma);
	EXPECT_GT(c.verdict.grade, Grade::GOOD);
}

TEST(Light, TheExponentOfAToneCurveIsFound)
{
	const Calibration c = Developed("power-0.8");
	EXPECT_GT(c.verdict.grade, Grade::GOOD);
	ASSERT_TRUE(c.light.exponent);
	EXPECT_NEAR(c.light.exponent->value, 0.8, 3 * c.light.exponent->sigma);
	const auto said = std::find_if(c.verdict.remarks.begin(), c.verdict.remarks.end(), [](const Remark& r) { return r.text.find("light to the power 0.") != std::string::npos; });
	EXPECT_NE(said, c.verdict.remarks.end());
}

// A curve chosen for each state, whose bends cancel in the mean of all photographs. A power of 1 % bends by 0.004, so that these are some 0.15 apart.
TEST(Light, StatesThatWereDevelopedApartAreSaid)
{
	const Negatives& n = Photographs();
	const std::string folder = testing::TempDir() + "light-apart-";
	std::vector<StateFiles> files{ DevelopAll(n, LightOf("power-0.8"), 1, folder + "dark")[0], DevelopAll(n, LightOf("power-1.2"), 1, folder + "bright")[1] };
	const Answer answer = CalibrateFiles(n, LightOf("power-0.8"), files);
	ASSERT_EQ(answer.refusal, "");
	const Calibration& c = answer.calibration;
	ASSERT_EQ(c.light.bend_of_states.size(), 2u);
	EXPECT_NEAR(c.light.bend_of_states[1].value - c.light.bend_of_states[0].value, 0.15, 0.08);
	const std::vector<Remark> remarks = JudgeLightOfStates(c);
	ASSERT_EQ(remarks.size(), 1u);
	EXPECT_NE(remarks[0].text.find("were not developed alike"), std::string::npos);
	EXPECT_EQ(c.verdict.grade, Grade::POOR);
	// What is found reaches whoever reads the files.
	const std::string json = CalibrationJson(c);
	EXPECT_NE(json.find("were not developed alike"), std::string::npos);
	EXPECT_NE(json.find("\"bend_of_states\": ["), std::string::npos);
	EXPECT_NE(ReportHtml(c, { "edges", "tiltcal calibrate", "2000-01-01" }, ReportPictures(c.task)).find("were not developed alike"), std::string::npos);
}

TEST(Light, APowerIsFoundByTheShiftItMakes)
{
	EXPECT_NEAR(ShiftOfExponent(1, 0.06, 2), 0, 1e-6) << "the fit's own shape";
	for (const double exponent : { 0.5, 0.9, 1.1, 2.0 })
		for (const double dark : { 0.0, 0.06, 0.3 })
		{
			const double shift = ShiftOfExponent(exponent, dark, 2);
			EXPECT_GT(shift * (exponent - 1), 0);
			EXPECT_NEAR(ExponentOfShift(shift, std::pow(dark, exponent), 2), exponent, 1e-4);
		}
	EXPECT_TRUE(std::isnan(ExponentOfShift(5, 0.06, 2)));
}

TEST(Light, ClippedAboveTheFilesOwnWhiteIsPoor)
{
	// White of 1.28 of full scale: every bright side.
	for (const char* light : { "12bit-in-16-clipped", "clipped-exr" })
	{
		const Calibration c = Developed(light);
		EXPECT_GT(c.light.clipped_share, 0.9) << light;
		EXPECT_EQ(c.verdict.grade, Grade::POOR) << light;
	}
}

cv::Mat Noisy(double dark, double bright, double noise, double white)
{
	cv::Mat picture(200, 200, CV_32FC1);
	std::mt19937 random(1);
	std::normal_distribution<float> normal(0, float(noise));
	for (int y = 0; y < picture.rows; ++y)
		for (int x = 0; x < picture.cols; ++x)
			picture.at<float>(y, x) = std::min(float(white), float(x < 100 ? dark : bright) + normal(random));
	return picture;
}

TEST(Light, WhiteLevels)
{
	EXPECT_TRUE(ClippedPixels(Noisy(0.05, 0.8, 0.01, 1)).empty());
	EXPECT_TRUE(ClippedPixels(Noisy(0.05, 0.8, 0, 1)).empty()) << "a render without noise";
	EXPECT_GT(cv::countNonZero(ClippedPixels(Noisy(0.05, 0.8, 0.01, 0.75))), 19000);
	EXPECT_GT(cv::countNonZero(ClippedPixels(Noisy(5, 80, 1, 80))), 9000) << "half of the bright side, in floats of another unit";
	// A render whose light falls off around a board: two thirds of what is dark differ, the board's own squares do not.
	cv::Mat render = Noisy(0.05, 0.8, 0, 1);
	for (int y = 70; y < render.rows; ++y)
		for (int x = 0; x < 100; ++x)
			render.at<float>(y, x) = 0.3f - 1e-4f * float(y) - 1e-5f * float(x * x);
	EXPECT_TRUE(ClippedPixels(render).empty());
	// One channel of three.
	cv::Mat colour;
	cv::merge(std::vector<cv::Mat>{ Noisy(0.05, 0.5, 0.01, 1), Noisy(0.05, 0.9, 0.01, 0.85), Noisy(0.05, 0.5, 0.01, 1) }, colour);
	EXPECT_GT(cv::countNonZero(ClippedPixels(colour)), 19000);
}

}
