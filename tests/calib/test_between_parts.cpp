// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/between_parts.h"
#include "calibrate/left_over.h"
#include "calibrate/verdict.h"
#include "model/thin_lens_of_real.h"
#include "solve/each_edge.h"
#include "support/sigma_in.h"
#include "support/synthetic_lens.h"

#include <tiltcal/calibrate.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace tiltcal;

namespace
{

Solution Told()
{
	Solution s;
	s.w_mm = { 48, 0.03 };
	s.focal_length = { 45, 0.01 };
	s.aperture_diameter = { 16, 0.1 };
	s.focus_distance = { 600, 2 };
	s.field_curvature = { -3e-4, 1e-4 };
	s.states.resize(2);
	s.states[0].q = { 0, 0, 1 / 600.0 };
	s.states[0].q_sigma = { 0, 0, 2 / (600.0 * 600) };
	s.states[0].focus_distance = s.focus_distance;
	s.states[1].lens_tilt = { 5, 0.02 };
	s.states[1].tilt_direction = { 0, 0.1 };
	s.states[1].focus_distance = { INFINITY, 1 };
	return s;
}

}

// Each number by the part that puts it farthest off, less what that part scatters, in quadrature.
TEST(BetweenParts, SigmasHoldHowFarPartsDisagree)
{
	const Solution whole = Told();
	PartAnswer inner{ {}, whole }, outer{ {}, whole };
	inner.solution.w_mm = { 48.4, 0.3 };
	outer.solution.w_mm = { 47.9, 0.01 };
	// Within what it scatters: nothing is added.
	inner.solution.aperture_diameter = { 16.2, 0.5 };
	inner.solution.field_curvature = { -6e-4, 0 };
	// The same tilt told the other way round, 0.1 degrees more.
	inner.solution.states[1].lens_tilt = { -5.1, 0.06 };
	inner.solution.states[1].tilt_direction = { 180, 0.1 };
	outer.solution.states[1].tilt_direction = { 1, 0.2 };
	// A plane through infinity moves to the other side of it.
	outer.solution.states[1].q = { 0, 1e-4, -2e-5 };
	outer.solution.states[1].q_sigma = { 0, 6e-5, 0 };
	inner.solution.states[0].q.z = 1 / 600.0 + 5e-6;
	inner.solution.states[0].q_sigma.z = 3e-6;
	Solution told = whole;
	WidenByParts(whole, { inner, outer }, told);
	EXPECT_NEAR(told.w_mm.sigma, std::sqrt(0.03 * 0.03 + 0.4 * 0.4 - 0.3 * 0.3), 1e-9);
	EXPECT_NEAR(told.aperture_diameter.sigma, 0.1, 1e-12);
	EXPECT_NEAR(told.focal_length.sigma, 0.01, 1e-12);
	EXPECT_NEAR(told.field_curvature.sigma, std::hypot(1e-4, 3e-4), 1e-12);
	EXPECT_NEAR(told.states[1].lens_tilt.sigma, std::sqrt(0.02 * 0.02 + 0.1 * 0.1 - 0.06 * 0.06), 1e-6);
	// An arc of one degree and its sine differ by 5e-5 of it.
	EXPECT_NEAR(told.states[1].tilt_direction.sigma, std::sqrt(0.1 * 0.1 + 1 - 0.2 * 0.2), 1e-3);
	EXPECT_NEAR(told.states[1].q_sigma.y, 8e-5, 1e-12);
	EXPECT_NEAR(told.states[1].q_sigma.z, 2e-5, 1e-12);
	EXPECT_EQ(told.states[1].focus_distance.sigma, 1) << "infinity";
	// 1/U and U are one number.
	EXPECT_NEAR(told.states[0].q_sigma.z, std::hypot(2 / (600.0 * 600), 4e-6), 1e-12);
	EXPECT_NEAR(told.focus_distance.sigma, told.states[0].q_sigma.z * 600 * 600, 1e-9);
	EXPECT_EQ(told.states[0].focus_distance.sigma, told.focus_distance.sigma);
	EXPECT_EQ(told.w_mm.value, 48);
}

TEST(BetweenParts, PlacesAreToldAsTheLensIs)
{
	Geometry whole;
	whole.states.resize(1);
	StateGeometry& own = whole.states[0];
	// A board upside down: its rotation vector may be told either way round.
	own.poses = { { 0, 0, M_PI - 0.01, 10, 20, 600 } };
	own.pose_sigmas = { { 1e-4, 1e-4, 1e-4, 0.1, 0.1, 0.3 } };
	own.principal_point_sigma = { 0.3, 0.4 };
	own.lens_centre_sigma = { 0, 0, 0.1 };
	whole.distortion_terms = 1;
	whole.distortion = { 0.004 };
	whole.distortion_sigma = { 3e-4 };
	PartAnswer part{ whole, Told() };
	part.geometry.states[0].poses = { { 0, 0, -M_PI + 0.01, 10, 20, 600.5 } };
	part.geometry.states[0].pose_sigmas = { { 0, 0, 0, 0, 0, 0.4 } };
	part.geometry.states[0].principal_point = { 0.6, 0 };
	part.geometry.states[0].principal_point_sigma = { 0.3, 0 };
	part.geometry.states[0].lens_centre.z = 0.2;
	part.geometry.states[0].lens_centre_sigma.z = 0;
	part.geometry.distortion = { 0.008 };
	Geometry told = whole;
	WidenPlacesByParts(whole, { part }, told);
	const StateGeometry& wide = told.states[0];
	EXPECT_NEAR(wide.pose_sigmas[0][2], std::hypot(1e-4, 0.02), 1e-9);
	EXPECT_NEAR(wide.pose_sigmas[0][3], 0.1, 1e-12);
	EXPECT_NEAR(wide.pose_sigmas[0][5], std::hypot(0.3, 0.3), 1e-9);
	EXPECT_NEAR(wide.principal_point_sigma[0], std::sqrt(0.09 + 0.36 - 0.09), 1e-12);
	EXPECT_NEAR(wide.principal_point_sigma[1], 0.4, 1e-12);
	EXPECT_NEAR(wide.lens_centre_sigma.z, std::hypot(0.1, 0.2), 1e-12);
	EXPECT_NEAR(told.distortion_sigma[0], std::sqrt(3e-4 * 3e-4 + 0.004 * 0.004 - 3e-4 * 3e-4), 1e-12);
	EXPECT_EQ(told.distortion_sigma[1], 0) << "held";
}

// Parts of what one thin lens made agree with the whole: they differ by less than they scatter themselves. Of twelve numbers one is beyond
// 4 sigma once in 1300 runs.
TEST(BetweenParts, AThinLensIsNotPutApart)
{
	const Task task = synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 });
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::OWN });
	int without_answer = 0;
	const std::vector<PartAnswer> parts = SolveParts(c, without_answer);
	ASSERT_EQ(parts.size(), 4u);
	EXPECT_EQ(without_answer, 0);
	for (const PartAnswer& part : parts)
		for (Estimate Solution::* number : { &Solution::w_mm, &Solution::focal_length, &Solution::aperture_diameter })
			EXPECT_LT(std::abs((part.solution.*number).value - (c.solution.*number).value), 4 * (part.solution.*number).sigma);
}

// An opening that grows with the field, by 3 % at the farthest edge, which the noise of each edge hides: d, which is told as it is on the axis, is off by a's mean over
// the edges. Of edges that lie evenly over the picture's circle the inner half's mean is a quarter, the whole's a half: off by twice what the sigma holds.
TEST(BetweenParts, GlassThatNoiseHidesIsHeld)
{
	const synthetic::Lens lens;
	Task task = synthetic::TwoStates(lens, synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 });
	const auto squared_radius = [&](const Edge& e) { return std::pow(e.x - 0.5 * (task.width - 1), 2) + std::pow(e.y - 0.5 * (task.height - 1), 2); };
	double farthest = 0;
	ForEachEdge(task, [&](size_t, size_t, const Edge& edge) { farthest = std::max(farthest, squared_radius(edge)); });
	for (State& state : task.states)
		for (Photo& photo : state.photos)
			for (Edge& edge : photo.edges)
				edge.blur *= 1 + 0.03 * squared_radius(edge) / farthest;
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::OWN });
	ASSERT_FALSE(MoreThanNoiseIsLeftOver(c));
	const Estimate& d = c.solution.aperture_diameter;
	EXPECT_GT(std::abs(d.value - lens.d), 4 * SigmaIn(c.solution.covariance, "aperture_diameter_mm")) << "too little to judge by";
	EXPECT_LT(std::abs(d.value - lens.d), 3 * d.sigma);
}

// A part that says nothing leaves the sigmas as small as they were: that is told.
TEST(BetweenParts, PartsWithoutAnAnswerAreInTheVerdict)
{
	Calibration c = Calibrate(synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 }), { Model::PLANE, Poses::OWN });
	ASSERT_EQ(c.fits_without_answer, 0);
	const auto told = [&]
	{
		const Verdict verdict = Judge(c);
		return std::any_of(verdict.remarks.begin(), verdict.remarks.end(), [](const Remark& r) { return r.grade == Grade::FAIR && r.text.find("4 of the fits") == 0; });
	};
	EXPECT_FALSE(told());
	// Halves of one edge a photograph tell no lens.
	for (State& state : c.task.states)
		for (Photo& photo : state.photos)
			photo.edges.resize(1);
	EXPECT_EQ(SolveParts(c, c.fits_without_answer).size(), 0u);
	EXPECT_EQ(c.fits_without_answer, 4);
	EXPECT_TRUE(told());
}

// What to do about a tilt that is not known well depends on why it is not; and it is judged as it is told.
TEST(BetweenParts, TheVerdictSaysWhatMorePhotographsDoNotMend)
{
	Calibration c = Calibrate(synthetic::TwoStates(synthetic::Lens(), synthetic::Tilted(5, 30), { 0.03, 0.06, 1 }, { 0.03, 0.06, 2 }), { Model::PLANE, Poses::OWN });
	const auto remark = [&](const char* about)
	{
		for (const Remark& r : Judge(c).remarks)
			if (r.text.find("tilt is known to 0.10 degrees only") != std::string::npos && r.text.find(about) != std::string::npos)
				return true;
		return false;
	};
	ASSERT_LT(c.solution.states[1].lens_tilt.sigma, 0.03);
	c.thin_as_it_scatters = c.solution.states;
	EXPECT_FALSE(remark(""));
	c.solution.states[1].lens_tilt.sigma = 0.1;
	EXPECT_TRUE(remark("more photographs do not"));
	c.thin_as_it_scatters[1].lens_tilt.sigma = 0.08;
	EXPECT_TRUE(remark("photograph the board in more poses"));
	// Squares known to 2 %: a tilt of 5 degrees to 0.1, which is all of it.
	c.task.board.square_sigma_mm = 0.02 * c.task.board.square_mm;
	EXPECT_TRUE(remark("measure its squares better"));
	c.task.board.square_sigma_mm = 0;
	c.thin_as_it_scatters.clear();
	EXPECT_TRUE(remark("photograph the board in more poses"));
	RealLens lens;
	lens.used = true;
	lens.states.resize(2);
	lens.states[1].lens.lens_tilt = { 5, 0.01 };
	c.real_lens = lens;
	EXPECT_FALSE(remark("")) << "the tilt that is told is the real lens's";
}

// The textbooks' lens of magnification M and pupil magnification m: the object lies f (1/m + 1/M) before the entrance pupil, the picture f (m + M)
// behind the exit pupil (Jacobson, "Photographic Lenses Tutorial"); the picture of a thin lens f (m + M) / m behind it.
TEST(BetweenParts, TheThinLensOfAnyPupilMagnificationHasTheRealLensesFocalLength)
{
	const double f = 45, M = 0.07;
	for (const double m : { 0.5, 0.9, 1.0, 1.07, 1.7 })
	{
		const double U = f * (1 / m + 1 / M), w = f * (m + M) / m, thin_power = 1 / U + 1 / w;
		EXPECT_NEAR(FocalLengthOfReal(m, thin_power, 1, w), f, 1e-12 * f) << m;
		EXPECT_NEAR(PowerOfThinLens(m, 1 / f, 1.0, w), thin_power, 1e-12 / f) << m;
	}
}

// To first order an unknown pupil magnification makes f unknown by f (f/U) of its sigma; the second order, even, cancels, the third is below the square of that of it.
TEST(BetweenParts, SigmaOfTheFocalLengthHoldsAnUnknownPupilMagnification)
{
	Solution s = Told();
	s.focus_distance.value = 1 / (1 / s.focal_length.value - 1 / s.w_mm.value);
	s.states.clear();
	const double first_order = PUPIL_MAGNIFICATION_SIGMA * s.focal_length.value * s.focal_length.value / s.focus_distance.value;
	WidenByPupils(s);
	EXPECT_NEAR(s.focal_length.sigma, std::hypot(0.01, first_order), PUPIL_MAGNIFICATION_SIGMA * PUPIL_MAGNIFICATION_SIGMA * first_order);
	EXPECT_EQ(s.w_mm.sigma, 0.03);
	// What EXIF knows to 10 % says less of f than that does; a --fix says all, and what scatters stays.
	const double by_pupils = s.focal_length.sigma;
	for (const auto& [known, told] : { std::pair{ 4.5, by_pupils }, std::pair{ 0.1, 0.1 }, std::pair{ 1e-5, 0.01 } })
	{
		s.focal_length.sigma = 0.01;
		WidenByPupils(s, known);
		EXPECT_EQ(s.focal_length.sigma, told) << known;
	}
}
