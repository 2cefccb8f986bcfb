// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/error.h>
#include "profile/profile.h"
#include <tiltcal/transfer.h>

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace tiltcal;

cv::Mat Flat(double value, int width = 120, int height = 80) { return cv::Mat(height, width, CV_32FC1, cv::Scalar(value)); }

double Linear(double code) { return ToLinear(Transfer(), code / 255); }

/// Stripes, dimmer to the right and down: something to fit a shading to.
cv::Mat Stripes(int phase)
{
	cv::Mat image(300, 400, CV_32FC1);
	for (int y = 0; y < image.rows; ++y)
		for (int x = 0; x < image.cols; ++x)
			image.at<float>(y, x) = ((x + phase) / 20 + y / 30) % 2 ? 0.5f : 0.1f;
	return image;
}

cv::Mat Shade(const cv::Mat& image)
{
	cv::Mat shaded = image.clone();
	for (int y = 0; y < image.rows; ++y)
		for (int x = 0; x < image.cols; ++x)
		{
			const double u = 2.0 * x / (image.cols - 1) - 1, v = 2.0 * y / (image.rows - 1) - 1;
			shaded.at<float>(y, x) *= static_cast<float>(0.8 + 0.1 * u - 0.2 * u * u - 0.1 * v * v * v * v + 0.05 * u * v);
		}
	return shaded;
}

TEST(Profile, KnownErrorComesOut)
{
	const Comparison c = Compare(Flat(Linear(120)), Flat(Linear(127.5)), { ParseLine("10,5,60,5"), ParseLine("3,3,3,70") }, Match::NONE);
	// Single precision of the picture: 1e-5 of 255.
	EXPECT_NEAR(c.mean_abs_error, 7.5, 1e-3);
	ASSERT_EQ(c.lines.size(), 2u);
	EXPECT_NEAR(c.lines[0].mean_abs_error, 7.5, 1e-3);
	EXPECT_EQ(c.lines[0].samples.size(), 51u);
	EXPECT_EQ(c.lines[1].samples.size(), 68u);
}

TEST(Profile, ErrorIsAlongTheLineOnly)
{
	cv::Mat a = Flat(0.2), b = Flat(0.2);
	b.row(10).setTo(Linear(255));
	const double difference = 255 - 255 * EncodeSrgb(0.2);
	const Comparison c = Compare(a, b, { ParseLine("0,10,119,10"), ParseLine("0,20,119,20") }, Match::NONE);
	EXPECT_NEAR(c.lines[0].mean_abs_error, difference, 1e-3);
	EXPECT_EQ(c.lines[1].mean_abs_error, 0);
	EXPECT_NEAR(c.mean_abs_error, difference / 80, 1e-3);
	EXPECT_NEAR(c.rms_error, difference / std::sqrt(80), 1e-3);
}

TEST(Profile, SamplesBetweenPixelsInLinearLight)
{
	cv::Mat a = Flat(0);
	a.col(5).setTo(0.8);
	const Comparison c = Compare(a, a, { ParseLine("4.5,3,4.5,9") }, Match::NONE);
	EXPECT_NEAR(c.lines[0].samples[0].a, 255 * EncodeSrgb(0.4), 1e-3);
}

TEST(Profile, GainIsFound)
{
	cv::Mat half = Stripes(0);
	half *= 0.5;
	const Comparison c = Compare(Stripes(0), half, {}, Match::GAIN);
	ASSERT_EQ(c.shading.coefficients.size(), 1u);
	EXPECT_NEAR(c.shading.coefficients[0], 2, 1e-4);
	EXPECT_NEAR(c.mean_abs_error, 0, 1e-3);
}

TEST(Profile, ShadingIsFoundThoughTheEdgesDoNotMeet)
{
	// The photograph is shaded and shifted by 3 pixels: 15 % of the pixels lie on the wrong
	// side of an edge and must not pull the shading.
	const cv::Mat photo = Shade(Stripes(3));
	const Comparison c = Compare(photo, Stripes(0), {}, Match::SHADING);
	for (const double x : { 20.0, 200.0, 380.0 })
		for (const double y : { 20.0, 150.0, 280.0 })
		{
			const double u = 2 * x / 399 - 1, v = 2 * y / 299 - 1;
			const double truth = 0.8 + 0.1 * u - 0.2 * u * u - 0.1 * v * v * v * v + 0.05 * u * v;
			// One grey level of 255 at mid grey is 2 % of linear light.
			EXPECT_NEAR(c.shading.At(x, y, photo.size()), truth, 0.02 * truth) << x << " " << y;
		}
	// With the right edges nothing is left.
	EXPECT_LT(Compare(photo, Stripes(3), {}, Match::SHADING).mean_abs_error, 0.05);
}

// Counts of a sensor, 12 bits: white all over, if 1 were.
TEST(Profile, LightOfAnotherUnitIsComparedByOneGain)
{
	const cv::Mat a = 4000 * Stripes(0), b = 4000 * Stripes(3);
	const Comparison ordinary = Compare(2 * Stripes(0), 2 * Stripes(3), {}, Match::NONE), counts = Compare(a, b, {}, Match::NONE);
	// Its brightest hundredth, 2000, is white. Single precision: 1e-5 of 255.
	EXPECT_NEAR(counts.gain, 1 / 2000., 1e-9);
	EXPECT_EQ(ordinary.gain, 1);
	EXPECT_GT(counts.mean_abs_error, 1);
	EXPECT_NEAR(counts.mean_abs_error, ordinary.mean_abs_error, 3e-3);
	EXPECT_NEAR(Compare(a, 0.5 * a, {}, Match::GAIN).shading.coefficients[0], 2, 1e-4);
	EXPECT_NEAR(Compare(a, 3 * a, {}, Match::GAIN).mean_abs_error, 0, 1e-3);
	// A photograph of 8 bits, and a render that is three times as bright.
	EXPECT_NEAR(Compare(Stripes(0), 3 * Stripes(0), {}, Match::GAIN).shading.coefficients[0], 1 / 3., 1e-4);
}

TEST(Profile, ColourCountsByItsLuminance)
{
	cv::Mat colour(80, 120, CV_32FC3, cv::Scalar(0.1, 0.4, 0.2));   // blue, green, red
	const Comparison c = Compare(colour, Flat(0.0722 * 0.1 + 0.7152 * 0.4 + 0.2126 * 0.2), {}, Match::NONE);
	EXPECT_NEAR(c.mean_abs_error, 0, 1e-3);
}

TEST(Profile, RefusesLinesOutsideAndNonsense)
{
	EXPECT_THROW(Compare(Flat(0.1), Flat(0.1), { ParseLine("0,0,120,0") }, Match::NONE), Error);
	EXPECT_THROW(ParseLine("1,2,3"), Error);
	EXPECT_THROW(ParseLine("1,2,3,4,5"), Error);
	EXPECT_THROW(ParseMatch("some"), Error);
	// A black picture has no brightness to match.
	EXPECT_THROW(Compare(Flat(0.1), Flat(0), {}, Match::GAIN), Error);
}

}
