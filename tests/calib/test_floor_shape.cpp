// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/floor_shape.h"
#include "support/synthetic_lens.h"

#include <tiltcal/calibrate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace tiltcal;

namespace
{

// An edge through a disc, another blur and a pixel, and the disc with a pixel that is nearest to it by least squares: nothing of the calibrator's.
const double STEP = 0.02;

/// The light at an edge's distance t, px, through a disc of that diameter.
double ThroughDisc(double diameter, double t)
{
	const double s = std::clamp(2 * t / diameter, -1.0, 1.0);
	return 0.5 + (std::asin(s) + s * std::sqrt(1 - s * s)) / M_PI;
}

/// The mean of `edge` with the weights of `kernel`, over [-reach, reach].
double Blurred(const std::function<double(double)>& edge, const std::function<double(double)>& kernel, double reach, double t)
{
	double sum = 0, weights = 0;
	for (double x = -reach + 0.5 * STEP; x < reach; x += STEP)
	{
		sum += kernel(x) * edge(t - x);
		weights += kernel(x);
	}
	return sum / weights;
}

/// Diameter squared of the disc that fits a disc behind that kernel, less its own square.
double FloorOf(const std::function<double(double)>& kernel, double reach, double diameter)
{
	const auto pixel = [](double) { return 1.0; };
	const auto edge = [&](double t) { return ThroughDisc(diameter, t); };
	std::vector<double> at, seen;
	for (double t = -diameter - 3; t <= diameter + 3; t += 0.2)
	{
		at.push_back(t);
		seen.push_back(Blurred([&](double s) { return Blurred(edge, pixel, 0.5, s); }, kernel, reach, t));
	}
	const auto misfit = [&](double d)
	{
		double sum = 0;
		for (size_t i = 0; i < at.size(); ++i)
			sum += std::pow(Blurred([&](double s) { return ThroughDisc(d, s); }, pixel, 0.5, at[i]) - seen[i], 2);
		return sum;
	};
	// Golden section: the misfit has one minimum.
	double a = std::max(diameter, 0.1), b = diameter + 5;
	const double golden = 0.5 * (std::sqrt(5.0) - 1);
	while (b - a > 1e-4)
	{
		const double left = b - golden * (b - a), right = a + golden * (b - a);
		(misfit(left) < misfit(right) ? b : a) = misfit(left) < misfit(right) ? right : left;
	}
	return 0.25 * (a + b) * (a + b) - diameter * diameter;
}

}

// Of a Gaussian, in roots of the floor in the middle of what is measured; tolerance: a fifth of the whole effect, for what sigmas hold of it is a share that nobody
// knows better. A triangle, the kernel of bilinear demosaicing, is more compact and differs by as much or more, but not by half as much again.
TEST(FloorShape, IsThatOfAGaussian)
{
	const auto gaussian = [](double x) { return std::exp(-0.5 * x * x / (0.8 * 0.8)); };
	const auto triangle = [](double x) { return std::max(0.0, 1.3 - std::abs(x)); };
	for (const double diameter : { 0.5, 1.5, 3.0, 5.0 })
	{
		const auto measured = [&](const std::function<double(double)>& kernel, double reach)
		{
			const double middle = FloorOf(kernel, reach, 3), root = std::sqrt(middle);
			return std::pair{ (FloorOf(kernel, reach, diameter) - FloorOf(kernel, reach, 8)) / middle, GaussianFloorExcess(diameter / root) - GaussianFloorExcess(8 / root) };
		};
		const auto [of_gaussian, said] = measured(gaussian, 3.2);
		EXPECT_NEAR(of_gaussian, said, 0.06) << diameter;
		const auto [of_triangle, said_of_it] = measured(triangle, 1.3);
		EXPECT_GT(of_triangle, said_of_it - 0.06) << diameter;
		EXPECT_LT(of_triangle, 1.5 * said_of_it + 0.06) << diameter;
	}
	// A peaked one adds by squares: the other end of what is open.
	const auto peaked = [](double x) { return std::exp(-std::abs(x) / 0.5); };
	const double large = FloorOf(peaked, 4, 8);
	for (const double diameter : { 0.5, 3.0 })
		EXPECT_NEAR(FloorOf(peaked, 4, diameter) / large, 1, 0.03) << diameter;
}

// Photographs that are as sharp as their pixels leave nothing open, and cost nothing. Unsharp ones, whose blurs add by squares in truth, must be inside what is held open.
TEST(FloorShape, SigmasHoldTheOpenShapeWherePhotographsAreUnsharp)
{
	const synthetic::Lens lens;
	const CalibrateOptions options{ Model::PLANE, Poses::OWN };
	Task task = synthetic::TwoStates(lens, synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 });
	const Calibration sharp = Calibrate(task, options);
	EXPECT_FALSE(ShapeOfFloorIsSeen(sharp));
	EXPECT_EQ(sharp.TiltLeftOutByModel(1), 0);
	for (State& state : task.states)
		for (Photo& photo : state.photos)
			for (Edge& edge : photo.edges)
				edge.blur = std::sqrt(edge.blur * edge.blur + 5);
	const Calibration unsharp = Calibrate(task, options);
	ASSERT_TRUE(ShapeOfFloorIsSeen(unsharp));
	const std::optional<PartAnswer> other = SolveWithGaussianFloor(unsharp);
	ASSERT_TRUE(other);
	const double apart = std::abs(other->solution.aperture_diameter.value - unsharp.solution.aperture_diameter.value);
	EXPECT_GT(unsharp.solution.aperture_diameter.sigma, 0.99 * apart / std::sqrt(3.0));
	EXPECT_GT(unsharp.TiltLeftOutByModel(1), 0) << "no scatter, which further photographs would mend";
	EXPECT_GT(unsharp.solution.aperture_diameter.sigma, sharp.solution.aperture_diameter.sigma);
	EXPECT_NEAR(unsharp.solution.aperture_diameter.value, lens.d, 3 * unsharp.solution.aperture_diameter.sigma);
}
