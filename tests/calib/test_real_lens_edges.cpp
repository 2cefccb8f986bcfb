// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Edges through a real lens: what their fit makes of light that falls into no disc, and what rims leave of the opening.

#include "edge/edge_fit.h"
#include "edge/fit_response.h"
#include "solve/opening_points.h"
#include "solve/real_lens_edge_cost.h"
#include "solve/real_lens_light.h"
#include "support/shaded_lens.h"
#include "support/synthetic_lens.h"

#include <ceres/autodiff_cost_function.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace
{

using namespace tiltcal;

/// What FitEdge finds of an edge whose light is spread as `share` says: points and their parts, along the normal, px.
EdgeFit Fitted(const std::vector<std::pair<double, double>>& spread, double nx, double ny, double reach, double start)
{
	std::vector<EdgeSample> samples;
	for (double x = -reach + 0.05; x < reach; x += 0.1)
		for (const double s : { -3.0, 0.0, 3.0 })
		{
			double light = 0;
			for (const auto& [at, part] : spread)
				light += part * PixelEdgeResponse(x - at, 0, std::abs(nx), std::abs(ny)).value;
			samples.push_back({ x, s, 0.05 + 0.75 * light });
		}
	return FitEdge(samples, LoneEdge(nx, ny), {}, start);
}

/// A disc of radius R as points along a line, each with its chord.
std::vector<std::pair<double, double>> Disc(double R)
{
	const int n = 300;
	std::vector<std::pair<double, double>> spread;
	for (int k = 1; k <= n; ++k)
	{
		const double a = M_PI * k / (n + 1), sine = std::sin(a);
		spread.emplace_back(R * std::cos(a), 2 * sine * sine / (n + 1));
	}
	return spread;
}

// The light of a disc, a part of it thrown aside: coma, halo or core. So small a part that the fit's Huber weights, which begin at some 5 % of the step, let
// it be. To first order: a few times its square may be left, and 3 % by the response's own samples (48 across, and 65 nodes), whose steps are 1/10 of a disc.
TEST(FitResponse, IsWhatTheFitOfAnEdgeDoes)
{
	const double part = 0.004;
	for (const double diameter : { 3.0, 8.0, 20.0 })
		for (const double aside : { -0.8, -0.3, 0.0, 0.5, 0.9 })
		{
			const double nx = 0.8, ny = 0.6, reach = 0.75 * diameter + 3, R = 0.5 * diameter;
			std::vector<std::pair<double, double>> spread = Disc(R);
			for (auto& [at, share] : spread)
				share *= 1 - part;
			spread.emplace_back(aside * R, part);
			const EdgeFit disc = Fitted(Disc(R), nx, ny, reach, R), fit = Fitted(spread, nx, ny, reach, R);
			ASSERT_TRUE(disc.valid && fit.valid);
			const FitResponse response(nx, ny, diameter, reach, 0);
			EXPECT_NEAR(fit.offset - disc.offset, part * response.Place(aside * R).value, 3 * part * part * R + 0.03 * part * R) << diameter << " " << aside;
			EXPECT_NEAR(SoftDiameter(2 * fit.radius) - SoftDiameter(2 * disc.radius), part * response.Soft(aside * R).value, 6 * part * part * R + 0.03 * part * diameter) << diameter << " " << aside;
		}
}

// Along a row of pixels only light within a radius of the pixel's ends knows how wide a disc is. A point of light at the line's place takes the disc's width away, whatever
// that is: the fit's soft diameter falls by about as much as a disc has, some pixels at most; never by millions.
TEST(FitResponse, NarrowBlursDoNotFallBetweenItsSamples)
{
	for (const double reach : { 3.0, 6.14, 20.0 })
		for (const double diameter : { 1e-4, 0.03, 0.108, 0.25, 0.5 })
			for (const double x : { -1.0, -0.2, 0.0, 0.3 })
			{
				const FitResponse response(1, 1e-6, diameter, reach, 0.05);
				EXPECT_LT(std::abs(response.Soft(x).value), 20) << reach << ", " << diameter << ", " << x;
				EXPECT_LT(std::abs(response.Place(x).value), 2) << reach << ", " << diameter << ", " << x;
			}
}

TEST(FitResponse, ItsDerivativesAreItsOwn)
{
	const FitResponse response(0.6, 0.8, 7, 9, 0.1);
	const double h = 1e-5;
	for (const double x : { -9.0, -4.1, -0.3, 0.0, 2.22, 6.0 })
	{
		EXPECT_NEAR(response.Place(x).derivative, (response.Place(x + h).value - response.Place(x - h).value) / (2 * h), 1e-5);
		EXPECT_NEAR(response.Soft(x).derivative, (response.Soft(x + h).value - response.Soft(x - h).value) / (2 * h), 1e-5);
	}
	EXPECT_EQ(response.Place(100).value, 0);
}

/// RealLensEdge as Ceres would have it, by Jets of all numbers.
struct ByJets
{
	const RealLensEdge& edge;

	template<typename T>
	bool operator()(const T* state, const T* pose, const T* centre, const T* lens, const T* c, const T* rims, T* seen) const
	{
		return edge.See(state, pose, centre, lens, c, rims, seen);
	}
};

// Both are exact but for rounding: sums of 18 points, each of some hundred operations on numbers up to 1e4 of what is left: 1e-16 1e2 1e4.
TEST(RealLensEdgeCost, HasTheDerivativesOfJets)
{
	using namespace real_lens;
	const double state[STATE_SIZE] = { 0.09, -0.04, 2410, 905, 590 }, pose[6] = { 0.3, -0.4, 3.0, -40, 25, 610 }, centre[3] = { 0.4, -0.2, 0.1 }, lens[LENS_SIZE] = { 0.02 / 45, 1.07, 0.98, 1.3 },
		rims[RIMS_SIZE] = { 0.2, 0.5, 0.1, 0.4 };
	double c[tilt_lens::AberrationTerms];
	for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
		c[k] = 0.03 * (k % 5 - 2.2);
	for (const bool along_columns : { true, false })
	{
		RealLensEdge edge{ 60, 45, along_columns, 1300, 380, 0.6, -0.8, 8, 0.02, FitResponse(0.6, -0.8, 9, 10, 0.1, true), 0.2, 0.15, 1.1, OpeningPoints(), {} };
		for (size_t k = 0; k < edge.points.size(); ++k)
			edge.px_per_mm.push_back(3.6 + 0.01 * double(k));
		edge.at_rims = { 0.1, 0.5, 0.2, 0.3 };
		edge.by_rims = { { { 0.2, -0.1, 0.05, 0.3 }, { -0.4, 0.2, 0.6, -0.7 }, { 0.01, 0.02, -0.03, 0.01 }, { -0.02, 0.04, 0.01, 0.03 } } };
		edge.shape = EdgeShape{ { 0.02, -0.03 }, { 0.01, 0.01 } };
		const double* const parameters[] = { state, pose, centre, lens, c, rims };
		const int sizes[] = { STATE_SIZE, 6, 3, LENS_SIZE, tilt_lens::AberrationTerms, RIMS_SIZE };
		const ceres::AutoDiffCostFunction<ByJets, RealLensEdge::SEEN, STATE_SIZE, 6, 3, LENS_SIZE, tilt_lens::AberrationTerms, RIMS_SIZE> jets(new ByJets{ edge });
		const RealLensEdge::Seen weight{ 2, 5, 30, 40 };
		const RealLensEdgeCost cost(edge, weight);
		std::vector<std::vector<double>> expected, found;
		std::vector<double*> to_expected, to_found;
		for (const int size : sizes)
		{
			expected.emplace_back(RealLensEdge::SEEN * size);
			found.emplace_back(RealLensEdge::SEEN * size);
		}
		for (size_t b = 0; b < std::size(sizes); ++b)
		{
			to_expected.push_back(expected[b].data());
			to_found.push_back(found[b].data());
		}
		RealLensEdge::Seen by_jets, seen;
		ASSERT_TRUE(jets.Evaluate(parameters, by_jets.data(), to_expected.data()));
		ASSERT_TRUE(cost.Evaluate(parameters, seen.data(), to_found.data()));
		for (size_t i = 0; i < RealLensEdge::SEEN; ++i)
		{
			EXPECT_NEAR(seen[i], weight[i] * by_jets[i], 1e-10 * std::abs(by_jets[i]));
			for (size_t b = 0; b < std::size(sizes); ++b)
				for (int k = 0; k < sizes[b]; ++k)
				{
					const double exact = weight[i] * expected[b][i * size_t(sizes[b]) + size_t(k)];
					EXPECT_NEAR(found[b][i * size_t(sizes[b]) + size_t(k)], exact, 1e-10 * std::abs(exact) + 1e-10) << "residual " << i << ", block " << b << ", number " << k;
				}
		}
		// Blocks that are held are not asked for.
		std::vector<double*> some = to_found;
		some[0] = some[4] = nullptr;
		const std::vector<double> before = found[1];
		ASSERT_TRUE(cost.Evaluate(parameters, seen.data(), some.data()));
		EXPECT_EQ(found[1], before);
		ASSERT_TRUE(cost.Evaluate(parameters, seen.data(), nullptr));
	}
}

// Of a uniform disc: light 1, middle 0, 1/4 along every direction, fourth moment 1/8.
TEST(OpeningPoints, HaveADiscsMoments)
{
	for (const double a : { 0.0, 0.4, 1.1, 2.3 })
	{
		double moment[5] = {};
		for (const OpeningPoint& p : OpeningPoints())
			for (int k = 0; k < 5; ++k)
				moment[k] += p.weight * std::pow(p.x * std::cos(a) + p.y * std::sin(a), k);
		const double disc[] = { 1, 0, 0.25, 0, 0.125 };
		for (int k = 0; k < 5; ++k)
			EXPECT_NEAR(moment[k], disc[k], 1e-12) << k;
	}
}

// Four Gauss nodes in the square of the radius are exact to its seventh power, nine points around to the eighth moment.
TEST(OpeningPoints, FineOnesHaveItsHigherMomentsToo)
{
	for (const double a : { 0.0, 0.4, 1.1, 2.3 })
		for (int k = 0; k <= 8; ++k)
		{
			double moment = 0;
			for (const OpeningPoint& p : OpeningPoints(FINE))
				moment += p.weight * std::pow(p.x * std::cos(a) + p.y * std::sin(a), k);
			const double disc[] = { 1, 0, 1 / 4., 0, 1 / 8., 0, 5 / 64., 0, 7 / 128. };
			EXPECT_NEAR(moment, disc[k], 1e-12) << k;
		}
}

// A lens without aberrations and two rims, against rays that follow Gauss's equation to the rims. The cover has 400 points; some 40 of them lie on a border, each off
// by less than its half, evenly spread (0.29): sqrt(40) 0.29 / 400 = 0.5 % of the light, where half is left 1 %; four times that.
TEST(RealLensLight, IsThatOfRaysThroughBothRims)
{
	const synthetic::Lens lens;
	synthetic::Shade shade;
	shade.rim_radius = 10;
	shade.rim_distance = 15;
	shade.rear_radius = 9;
	shade.rear_distance = 14;
	const double state[real_lens::STATE_SIZE] = { 0, 0, lens.w / synthetic::PITCH, lens.cx, lens.cy }, of_lens[real_lens::LENS_SIZE] = { synthetic::PITCH / lens.f, 1, 1, 0 }, c[tilt_lens::AberrationTerms] = {};
	const double R = 0.5 * lens.d, rims[real_lens::RIMS_SIZE] = { std::log(10 / R), std::log(15 / R), std::log(9 / R), std::log(14 / R) };
	const auto light = [&](double u, double v)
	{
		MountedLens<double> mounted(state, of_lens, c, R, synthetic::PITCH, u, v);
		mounted.lens.etendue = false;   // as Gauss's equation has it
		return LogLightThroughRims(mounted, R, rims, { 1, -1 });
	};
	const double middle = light(lens.cx, lens.cy) - std::log(synthetic::LightLeft(lens, shade, lens.cx, lens.cy));
	double darkest = 1;
	for (const double u : { 30.0, 500.0, 1300.0, 1780.0 })
		for (const double v : { 20.0, 600.0, 1100.0 })
		{
			const double left = synthetic::LightLeft(lens, shade, u, v);
			darkest = std::min(darkest, left);
			EXPECT_NEAR(light(u, v) - middle, std::log(left), 0.04) << u << ", " << v;
		}
	EXPECT_LT(darkest, 0.6) << "the rims are to cut much";
}

OpeningView View(double X) { return { { 1, 1 / 45., { {}, 8 } }, 8, X, 0, 48, FEW }; }

/// Half the width across x, in radii, of what |x| < 1 and |x + 0.5| < 1 have in common.
double Chord(double x)
{
	return std::sqrt(std::max(0.0, std::min(1 - x * x, 1 - (x + 0.5) * (x + 0.5))));
}

template<typename Function>
double SumOver(double from, double to, Function of)
{
	const double step = 1e-4;
	double sum = 0;
	for (double x = from + 0.5 * step; x < to; x += step)
		sum += step * of(x);
	return sum;
}

/// Along x (0) or y (1); weights of sum 1.
double Variance(const std::vector<OpeningPoint>& points, int axis)
{
	double middle = 0, squares = 0;
	for (const OpeningPoint& p : points)
	{
		const double at = axis == 0 ? p.x : p.y;
		middle += p.weight * at;
		squares += p.weight * at * at;
	}
	return squares - middle * middle;
}

// A rim close behind the pupil, its centre half a radius aside: what two discs have in common.
TEST(OpeningThroughRims, LeavesWhatTwoDiscsHaveInCommon)
{
	// Behind at z the ray to X is at x (1 - z/48) + X z/48: with z = 24, x/2 + X/2, and a rim of 4 leaves |x + X| < 8.
	const double X = 4;
	const std::vector<OpeningPoint> open = OpeningThroughRims(View(X), { { 4, -24 } });
	double middle = 0, light = 0;
	for (const OpeningPoint& p : open)
	{
		middle += p.weight * p.x;
		light += p.weight;
	}
	const double area = SumOver(-1, 0.5, Chord), exact = SumOver(-1, 0.5, [](double x) { return x * Chord(x); });
	EXPECT_NEAR(light, 1, 1e-12);
	// 400 small points of equal area, those on a border in part: their sum is off by less than some tenths of sqrt(400).
	EXPECT_NEAR(middle, exact / area, 0.02);
	// Some 56 points of the cover lie on the border, each with a part that is off by some 0.2 of a point at random: 1.5 of the 250 that are left. Four times that.
	const double relative = 0.025;
	const double variance = SumOver(-1, 0.5, [&](double x) { return (x - exact / area) * (x - exact / area) * Chord(x); }) / area;
	EXPECT_NEAR(Variance(open, 0), variance, relative * variance);
	// A rim around the axis leaves a disc.
	for (const double left : { 0.95, 0.8, 0.6 })
		for (const int axis : { 0, 1 })
			EXPECT_NEAR(Variance(OpeningThroughRims(View(0), { { 4 * left, -24 } }), axis), 0.25 * left * left, relative * 0.25 * left * left) << left;
	EXPECT_EQ(OpeningThroughRims(View(0), {}).size(), OpeningPoints().size());
	EXPECT_EQ(OpeningThroughRims(View(100), { { 0.5, -24 } }).size(), OpeningPoints().size()) << "nothing left";
}

}
