// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where the paper's two cases fail and the one expression does not.

#include <cmath>

#include <gtest/gtest.h>

#include "lens/optics.h"
#include "paper_cases.h"

using namespace tilt_lens;

namespace
{

const Vec3<double> v = { 0.31, -0.27, 1.0 };
const Vec3<double> S = { 0.21, 0.13, -0.04 };
const double HalfTheDigits = 1.5e-8;

double OurError(double kappa)
{
	return DirectionError(Normalized(RayDirection(v, S, kappa)), v, S, kappa);
}

double PaperError(double kappa)
{
	return DirectionError(PaperRay(v, S, kappa), v, S, kappa);
}

}

// Two roundings in R and four in the normalisation, each 1.1e-16.
TEST(PaperCases, OursKeepsAllDigitsAtEveryKappa)
{
	for(double sign : { 1.0, -1.0 })
		for(double e = 2.0; e > -320.0; e -= 0.25)
			EXPECT_LE(OurError(sign * std::pow(10.0, e)), 7e-16) << "kappa 1e" << e;
	EXPECT_LE(OurError(0.0), 7e-16);
	EXPECT_LE(OurError(4.9e-324), 7e-16);
}

TEST(PaperCases, CasesAgreeWhereTheyAreWellConditioned)
{
	for(double kappa : { 10.0, 0.3, 1e-3, -1e-3, -5.0, 1e-100 })
		EXPECT_LE(PaperError(kappa), 1e-14) << kappa;
}

// The two cases do not fade: 1/kappa keeps its digits until its square overflows,
// and then they are gone all at once. sqrt(DBL_MAX) = 1.34e154.
TEST(PaperCases, CasesLoseHalfTheirDigitsWhereTheSquareOverflows)
{
	double kappa = 1.0;
	while(kappa > 0.0 && PaperError(kappa) < HalfTheDigits)
		kappa *= 0.999;
	EXPECT_NEAR(std::log10(kappa), -154.1, 0.2);
	EXPECT_EQ(PaperError(0.0), 2.0) << "no focus point, no direction";
	EXPECT_EQ(PaperError(-0.0), 2.0);
}

// In single precision, as a renderer on a graphics card would have it, the same
// happens at the square root of FLT_MAX already: planes 1e19 away.
TEST(PaperCases, SinglePrecisionFailsAtOneOver1e19)
{
	const auto finite = [](float kappa) {
		const Vec3<float> focus = { 0.31f / kappa, -0.27f / kappa, 1.0f / kappa };
		const Vec3<float> R = focus - Vec3<float>{ 0.21f, 0.13f, -0.04f };
		return std::isfinite(Length(R));
	};
	EXPECT_TRUE(finite(1e-18f));
	EXPECT_FALSE(finite(1e-20f));
}
