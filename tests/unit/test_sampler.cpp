// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The sampler against what defines it: a digital net, scrambled, seeded by pixel.

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "lens/pupil.h"
#include "lens/sampler.h"

using namespace tilt_lens;

namespace
{

std::vector<LensSample> Samples(uint32_t x, uint32_t y, int n)
{
	PixelSampler sampler(x, y);
	std::vector<LensSample> s;
	for(int i = 0; i < n; i++)
		s.push_back(sampler.Next());
	return s;
}

}

TEST(Sampler, IsTheSameForTheSamePixelAndDifferentForOthers)
{
	const auto a = Samples(17, 4, 64), b = Samples(17, 4, 64), c = Samples(4, 17, 64);
	int same = 0;
	for(int i = 0; i < 64; i++)
	{
		EXPECT_EQ(a[i].lens_u, b[i].lens_u);
		EXPECT_EQ(a[i].pixel_y, b[i].pixel_y);
		same += a[i].lens_u == c[i].lens_u;
	}
	EXPECT_LE(same, 1);
}

// Every 2^k samples put one sample into each of 2^k equal intervals, in every
// dimension: the definition of a (0, k, 1)-net, which Owen scrambling keeps.
TEST(Sampler, EveryDimensionIsStratified)
{
	for(int n : { 16, 64, 1024 })
	{
		const auto s = Samples(3, 5, n);
		std::set<int> strata[4];
		for(const LensSample& p : s)
		{
			const double value[4] = { p.pixel_x, p.pixel_y, p.lens_u, p.lens_v };
			for(int d = 0; d < 4; d++)
			{
				ASSERT_GT(value[d], 0.0);
				ASSERT_LT(value[d], 1.0);
				strata[d].insert(int(value[d] * n));
			}
		}
		for(int d = 0; d < 4; d++)
			EXPECT_EQ(strata[d].size(), size_t(n)) << "dimension " << d;
	}
}

// The lens dimensions form a (0, 2)-sequence: all elementary boxes of area 1/n
// hold exactly one of n = 2^k samples.
TEST(Sampler, LensSamplesAreA02Sequence)
{
	const int k = 8, n = 1 << k;
	const auto s = Samples(100, 7, n);
	for(int a = 0; a <= k; a++)
	{
		std::set<int> boxes;
		for(const LensSample& p : s)
			boxes.insert((int(p.lens_u * (1 << a)) << (k - a)) + int(p.lens_v * (1 << (k - a))));
		EXPECT_EQ(boxes.size(), size_t(n)) << "boxes 2^-" << a << " wide";
	}
}

// Integrals over pixel x lens. 4096 samples; independent samples would give a
// standard error of 0.1/64 = 0.0016 for such functions, a net far less: 5e-4.
TEST(Sampler, IntegratesAProduct)
{
	double sum = 0.0;
	const int n = 4096;
	for(const LensSample& p : Samples(9, 9, n))
		sum += p.pixel_x * p.pixel_y * std::sin(3.0 * p.lens_u) * std::exp(p.lens_v);
	const double exact = 0.25 * (1.0 - std::cos(3.0)) / 3.0 * (std::exp(1.0) - 1.0);
	EXPECT_NEAR(sum / n, exact, 5e-4);
}

// What README.md and LIMITS.md say of small lights: one on a hundredth of the lens is missed by all 16 samples of all 5 x 5
// pixels in fewer places than independent samples would miss it in, 0.99^400 = 1.8 %.
TEST(Sampler, ALightOnAHundredthOfTheLensIsMissedInFewPlaces)
{
	const int places = 40000;
	int missed = 0;
	for(int place = 0; place < places; place++)
	{
		// A square of a hundredth, anywhere.
		const double left = 0.9 * std::fmod(0.5 + place * 0.7548776662466927, 1.0), low = 0.9 * std::fmod(0.5 + place * 0.5698402909980532, 1.0);
		bool seen = false;
		for(int pixel = 0; pixel < 25; pixel++)
			for(const LensSample& s : Samples(5 * (place % 60) + pixel % 5, 5 * (place / 60) + pixel / 5, 16))
				seen |= s.lens_u >= left && s.lens_u < left + 0.1 && s.lens_v >= low && s.lens_v < low + 0.1;
		missed += !seen;
	}
	// Below it by more than chance, binomial: 3 sigma.
	const double bound = std::pow(0.99, 400), sigma = std::sqrt(bound * (1 - bound) / places);
	EXPECT_LT(missed / double(places), bound - 3 * sigma);
	EXPECT_GT(missed, 0) << "of 40000 places: the sentence would be too careful";
}

TEST(Pupil, SquareToDiscPreservesArea)
{
	// Rings and sectors must get their share. 2^16 net samples: the count in a region
	// of area 1/8 with a smooth boundary errs by far less than 0.2 percent.
	const int n = 1 << 16;
	int ring[8] = {}, sector[8] = {};
	double r2 = 0.0;
	for(const LensSample& s : Samples(1, 2, n))
	{
		const PupilPoint p = SquareToDisc(s.lens_u, s.lens_v);
		const double q = p.x * p.x + p.y * p.y;
		ASSERT_LE(q, 1.0 + 1e-12);
		r2 += q / n;
		ring[std::min(7, int(q * 8.0))]++;
		sector[std::min(7, int((std::atan2(p.y, p.x) + M_PI) / (2.0 * M_PI) * 8.0))]++;
	}
	EXPECT_NEAR(r2, 0.5, 1e-3);
	for(int i = 0; i < 8; i++)
	{
		EXPECT_NEAR(ring[i] / double(n), 0.125, 0.125 * 2e-2) << "ring " << i;
		EXPECT_NEAR(sector[i] / double(n), 0.125, 0.125 * 2e-2) << "sector " << i;
	}
}

TEST(Pupil, CentreAndCorners)
{
	EXPECT_EQ(SquareToDisc(0.5, 0.5).x, 0.0);
	EXPECT_EQ(SquareToDisc(0.5, 0.5).y, 0.0);
	for(double u : { 0.0, 1.0 })
		for(double v : { 0.0, 1.0 })
			EXPECT_NEAR(std::hypot(SquareToDisc(u, v).x, SquareToDisc(u, v).y), 1.0, 1e-15);
}
