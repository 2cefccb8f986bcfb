// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Vignetting recovered from white patches and flat fields of a lens that is known.

#include "calibrate/thin_lens.h"
#include "measure/bright_patches.h"
#include <tiltcal/photo.h>
#include "effects/effects.h"
#include "effects/rim_fit.h"
#include <tiltcal/error.h>
#include "support/code_of.h"
#include "support/shaded_lens.h"
#include "effects/vignetting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace tiltcal;
using synthetic::Lens;
using synthetic::Shade;

namespace
{

const Shade RIM{ true, 15, 33, 0 };
/// Boards that a lamp lights from one side, through the same rim: their places are the lens's, their brightness would say something else.
const Shade LIT_OTHERWISE{ false, 15, 33, 0.2 };
const Shade ON_BOTH_SIDES{ true, 12.5, 21, 0, 8.8, 13 };

std::vector<Lens> TiltedBothWays()
{
	Lens up, down;
	up.tilt = 5;
	down.tilt = -5;
	return { Lens(), up, down };
}

Calibration Estimated(Calibration c)
{
	c.vignetting = EstimateVignetting(c);
	ChooseEffects({}, c);
	return c;
}

double Off(const Estimate& e, double truth) { return std::abs(e.value - truth) / e.sigma; }

}

// 2.6 sigma: six numbers are looked at in all, of which one beyond 2 would be no surprise; the seed is fixed.
TEST(CalibrateVignetting, FindsTheRimFromTiltedStates)
{
	const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), RIM, 0.005, 1));
	ASSERT_EQ(c.vignetting.failure, "");
	const FalloffAnswer& found = FalloffOf(c);
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_NATURAL));
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL));
	EXPECT_LT(Off(found.radius_mm, 15), 2.6) << found.radius_mm.value << " +- " << found.radius_mm.sigma;
	EXPECT_LT(Off(found.distance_mm, 33), 2.6) << found.distance_mm.value << " +- " << found.distance_mm.sigma;
	EXPECT_LT(found.radius_mm.sigma, 0.5);     // half a per cent of noise on some 400 patches: 3 %
	EXPECT_NEAR(found.rms, 0.005, 0.001);      // the noise that was put in
	EXPECT_GT(found.darkening.value, 0.1);
}

// A rim before and one behind the lens, about as in a double Gauss lens. 2.6 sigma as above, of four numbers in three sets. One rim predicts brightness
// nearly as well, but moves edges to one side.
TEST(CalibrateVignetting, FindsRimsOnBothSides)
{
	for (unsigned seed = 1; seed <= 3; ++seed)
	{
		const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), ON_BOTH_SIDES, 0.005, seed));
		const FalloffAnswer& found = FalloffOf(c);
		EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_NATURAL)) << EffectsText(c);
		EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL)) << EffectsText(c);
		ASSERT_EQ(found.rims.size(), 2u) << EffectsText(c);
		const double truth[] = { 12.5, 21, 8.8, -13 };
		for (size_t k = 0; k < 4; ++k)
		{
			const Estimate& e = k % 2 ? found.rims[k / 2].distance_mm : found.rims[k / 2].radius_mm;
			EXPECT_LT(Off(e, truth[k]), 2.6) << e.value << " +- " << e.sigma << " for " << truth[k];
			EXPECT_LT(e.sigma, 0.25 * std::abs(truth[k]));
		}
		EXPECT_EQ(found.radius_mm.value, found.rims[0].radius_mm.value);
		EXPECT_GE(found.second.sigmas, 4);
		EXPECT_LT(found.second.held_out_with, found.second.held_out_without);
	}
}

// With little noise one rim beside the others' places is dear at first, and a second one that cuts nothing is not: the search must not begin with such. 3 sigma, of one set.
TEST(CalibrateVignetting, FindsBothRimsWhereNoiseIsLittle)
{
	const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), ON_BOTH_SIDES, 0.0005, 1));
	const FalloffAnswer& found = FalloffOf(c);
	ASSERT_EQ(found.rims.size(), 2u) << EffectsText(c);
	EXPECT_GT(found.rims[0].distance_mm.value, 0);
	EXPECT_LT(found.rims[1].distance_mm.value, 0);
	EXPECT_LT(Off(found.rims[1].radius_mm, 8.8), 3) << found.rims[1].radius_mm.value << " +- " << found.rims[1].radius_mm.sigma;
}

// The same number of rims as there are: no second one is made up for noise. Of ten sets chance shows one at 4 sigma once in a thousand times, and it must then predict better too.
TEST(CalibrateVignetting, OneRimStaysOne)
{
	int second = 0;
	for (unsigned seed = 1; seed <= 10; ++seed)
	{
		const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), RIM, 0.005, seed));
		EXPECT_NE(FalloffOf(c).second.why, "") << "it was not asked";
		second += FalloffOf(c).rims.size() > 1;
	}
	EXPECT_EQ(second, 0);
}

// One photograph cannot be left out: nothing predicts anything, so that no second rim is kept, however much it would fit.
TEST(CalibrateVignetting, OnePhotographHasNoSecondRim)
{
	for (unsigned seed = 1; seed <= 5; ++seed)
	{
		const Calibration c = Estimated(synthetic::Shaded({ Lens() }, ON_BOTH_SIDES, 0.005, seed, 1));
		ASSERT_EQ(c.vignetting.failure, "");
		for (const FalloffAnswer& answer : c.vignetting.answers)
			EXPECT_LE(answer.rims.size(), 1u);
	}
}

// The same through the least squares: without its only group there is nothing to fit.
TEST(CalibrateVignetting, WithoutTheOnlyGroupThereIsNoFit)
{
	FalloffFit light;
	light.lens_radius = 8;
	light.image_distance = 50;
	light.samples.resize(8);
	const RimFit fit(light, std::vector<size_t>(8, 0), {}, 1);
	Rims rims{ { 15, 33 }, { 9, -13 } };
	EXPECT_FALSE(fit.Minimise(rims, 0));
}

TEST(CalibrateVignetting, UnevenLightIsNotTakenForTheLens)
{
	Shade lit = RIM;
	lit.gradient = 0.2;
	const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), lit, 0.005, 2));
	const FalloffAnswer& found = FalloffOf(c);
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_NATURAL));
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL));
	EXPECT_LT(Off(found.radius_mm, 15), 2.6) << found.radius_mm.value << " +- " << found.radius_mm.sigma;
	EXPECT_LT(Off(found.distance_mm, 33), 2.6) << found.distance_mm.value << " +- " << found.distance_mm.sigma;
}

// Standardised errors of R, Z and the darkening over 30 sets of noise: their RMS is 1 where the sigmas are honest. 30 numbers scatter by 13 %, and the larger
// of two sigmas (covariance, jackknife) is some 10 % too large.
TEST(CalibrateVignetting, SigmasAreHonest)
{
	const Calibration truth = synthetic::Shaded(TiltedBothWays(), RIM, 0, 1, 3);
	const double darkening = EstimateVignetting(truth).answers[FalloffKind(true, true)].darkening.value;
	double squares[3] = { 0, 0, 0 };
	const unsigned runs = 30;
	std::mt19937 random(1);
	std::normal_distribution<double> normal(0, 0.01);
	for (unsigned run = 0; run < runs; ++run)
	{
		Calibration c = truth;
		for (State& state : c.task.states)
			for (Photo& photo : state.photos)
				for (BrightPatch& p : photo.white)
				{
					p.value *= 1 + normal(random);
					p.sigma = 0.01 * p.value;
				}
		const Vignetting v = EstimateVignetting(c);
		const FalloffAnswer& found = v.answers[FalloffKind(true, true)];
		squares[0] += std::pow(Off(found.radius_mm, 15), 2) / runs;
		squares[1] += std::pow(Off(found.distance_mm, 33), 2) / runs;
		squares[2] += std::pow(Off(found.darkening, darkening), 2) / runs;
	}
	for (const double s : squares)
	{
		EXPECT_GT(std::sqrt(s), 0.6);
		EXPECT_LT(std::sqrt(s), 1.35);
	}
}

/// The photographs of `truth`, which have no noise, with one of 0.5 % on their patches.
Calibration WithNoise(const Calibration& truth, unsigned seed)
{
	Calibration c = truth;
	std::mt19937 random(seed);
	std::normal_distribution<double> normal(0, 0.005);
	for (State& state : c.task.states)
		for (Photo& photo : state.photos)
			for (BrightPatch& p : photo.white)
			{
				p.value *= 1 + normal(random);
				p.sigma = 0.005 * p.value;
			}
	return c;
}

// A rim is the best of many places, so that what it is worth by chance has no table. Were it made up in one camera of ten, 30 cameras would have none of them once in 24 times (0.9^30).
// A rim that takes a tenth of the light, 20 times the noise of a patch, is seen in each.
TEST(CalibrateVignetting, CamerasWithoutARimGetNoneAndThoseWithOneGetIt)
{
	const Calibration open = synthetic::Shaded(TiltedBothWays(), Shade(), 0, 1, 3), with = synthetic::Shaded(TiltedBothWays(), RIM, 0, 1, 3);
	double most = 0;
	for (unsigned seed = 1; seed <= 30; ++seed)
	{
		const Calibration none = Estimated(WithNoise(open, seed));
		EXPECT_FALSE(Uses(none, EffectId::VIGNETTING_OPTICAL)) << "seed " << seed << "\n" << EffectsText(none);
		if (seed % 5 == 0)
		{
			const Calibration one = Estimated(WithNoise(with, seed));
			EXPECT_TRUE(Uses(one, EffectId::VIGNETTING_OPTICAL)) << "seed " << seed << "\n" << EffectsText(one);
		}
		most = std::max(most, none.vignetting.answers[FalloffKind(true, true)].rim_sigmas);
	}
	RecordProperty("most_sigmas_by_chance", std::to_string(most));
}

TEST(CalibrateVignetting, NothingIsWrittenWhereNothingDarkens)
{
	Shade none;
	none.natural = false;
	const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), none, 0.005, 3));
	EXPECT_FALSE(Uses(c, EffectId::VIGNETTING_NATURAL)) << EffectsText(c);
	EXPECT_FALSE(Uses(c, EffectId::VIGNETTING_OPTICAL)) << EffectsText(c);
}

TEST(CalibrateVignetting, NaturalFallOffAloneHasNoRim)
{
	const Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), Shade(), 0.005, 4));
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_NATURAL)) << EffectsText(c);
	EXPECT_FALSE(Uses(c, EffectId::VIGNETTING_OPTICAL)) << EffectsText(c);
}

// One picture of 1040 cells, without a photograph that could be left out: it is left out by quarters.
TEST(CalibrateVignetting, FlatFieldsTellItBetterThanTheBoard)
{
	Calibration c = synthetic::Shaded(TiltedBothWays(), LIT_OTHERWISE, 0.005, 5);
	for (const bool several : { false, true })
	{
		c.task.flat_fields.clear();
		for (size_t s = 0; s < (several ? 3u : 1u); ++s)
			c.task.flat_fields.push_back(synthetic::ShadedField(TiltedBothWays()[s], s, RIM, 0.005, unsigned(s + 1)));
		const Calibration e = Estimated(c);
		const FalloffAnswer& found = FalloffOf(e);
		EXPECT_TRUE(e.vignetting.flat_field);
		EXPECT_TRUE(Uses(e, EffectId::VIGNETTING_NATURAL)) << EffectsText(e);
		EXPECT_TRUE(Uses(e, EffectId::VIGNETTING_OPTICAL)) << EffectsText(e);
		EXPECT_LT(Off(found.radius_mm, 15), 2.6) << found.radius_mm.value << " +- " << found.radius_mm.sigma;
		EXPECT_LT(Off(found.distance_mm, 33), 2.6) << found.distance_mm.value << " +- " << found.distance_mm.sigma;
		EXPECT_LT(found.radius_mm.sigma, 0.3);
	}
}

// A lens whose image circle ends within the picture: black cells say nothing, and must not end the fit.
TEST(CalibrateVignetting, BlackCellsOfAFlatFieldAreLeftOut)
{
	Calibration c = synthetic::Shaded(TiltedBothWays(), LIT_OTHERWISE, 0.005, 5);
	c.task.flat_fields = { synthetic::ShadedField(TiltedBothWays()[0], 0, RIM, 0.005, 1) };
	for (size_t k = 0; k < 20; ++k)
		c.task.flat_fields[0].patches[k].value = k < 10 ? 0 : -1e-6;
	const Calibration e = Estimated(c);
	EXPECT_TRUE(Uses(e, EffectId::VIGNETTING_OPTICAL)) << EffectsText(e);
	EXPECT_LT(Off(FalloffOf(e).radius_mm, 15), 2.6);
}

TEST(CalibrateVignetting, EffectsAskedForAreTakenOrRefused)
{
	Calibration c = synthetic::Shaded(TiltedBothWays(), RIM, 0.005, 1);
	c.vignetting = EstimateVignetting(c);
	ChooseEffects(ParseEffects("vignetting_optical"), c);
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL));
	EXPECT_FALSE(Uses(c, EffectId::VIGNETTING_NATURAL));
	// A rim that must make up for the natural fall-off is another.
	EXPECT_EQ(&FalloffOf(c), &c.vignetting.answers[FalloffKind(false, true)]);
	ChooseEffects(ParseEffects("none"), c);
	for (const Effect& e : c.effects)
		EXPECT_FALSE(e.used) << NameOf(e.id);
	ChooseEffects(ParseEffects("all"), c);
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL));
	EXPECT_FALSE(Uses(c, EffectId::BLADES));   // nobody said how many
	for (const char* const name : { "blades", "distortion", "field_curvature" })
		EXPECT_EQ(CodeOf([&] { ChooseEffects(ParseEffects(std::string("vignetting_natural,") + name), c); }), EXIT_REFUSED) << name;
	for (const char* const text : { "", "vignetting", "auto,none", "blades,", "Blades" })
		EXPECT_EQ(CodeOf([&] { ParseEffects(text); }), EXIT_USAGE) << text;
}

// Of a lens whose exit pupil is the larger one: rims alone predict better than the natural fall-off alone, and beside it they are nothing.
TEST(CalibrateVignetting, OfTheTwoAloneTheBetterIsWritten)
{
	Calibration c = synthetic::Shaded(TiltedBothWays(), RIM, 0.005, 1);
	c.vignetting = {};
	for (FalloffAnswer& a : c.vignetting.answers)
	{
		a.fitted = a.rim_seen = true;
		a.rims.resize(1);
	}
	const size_t none = FalloffKind(false, false), natural = FalloffKind(true, false), optical = FalloffKind(false, true), both = FalloffKind(true, true);
	c.vignetting.answers[none].held_out = 0.1;
	c.vignetting.answers[natural].held_out = c.vignetting.answers[both].held_out = 0.04;
	c.vignetting.answers[optical].rim_sigmas = 10;
	for (const double alone : { 0.005, 0.05 })
	{
		c.vignetting.answers[optical].held_out = alone;
		ChooseEffects({}, c);
		EXPECT_EQ(Uses(c, EffectId::VIGNETTING_OPTICAL), alone < 0.04) << EffectsText(c);
		EXPECT_EQ(Uses(c, EffectId::VIGNETTING_NATURAL), alone > 0.04) << EffectsText(c);
	}
}

// Of one edge a photograph there is no second answer, through the rims: the first one stays, and it is said.
TEST(CalibrateVignetting, RimsWithoutAnAnswerLeaveTheFirst)
{
	Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), RIM, 0.005, 1));
	c.solution.states[0].focus_distance.value = Lens().FocusDistance();
	ASSERT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL));
	Task measured = c.task;
	for (State& state : measured.states)
		for (Photo& photo : state.photos)
			photo.edges.resize(1);
	std::vector<std::string> said;
	CalibrateOptions options;
	options.log = Log([&said](Severity, const std::string& text) { said.push_back(text); });
	const Calibration before = c;
	const Task task = SolveThroughRims(measured, options, c);
	EXPECT_THAT(said, testing::Contains(testing::HasSubstr("with the rims there is no answer (state ")));
	EXPECT_EQ(task.states[0].photos[0].edges.size(), before.task.states[0].photos[0].edges.size());
	EXPECT_EQ(c.solution.w_mm.value, before.solution.w_mm.value);
	EXPECT_TRUE(Uses(c, EffectId::VIGNETTING_OPTICAL));
}

// Light shows rims in units of the opening: its 3 % are theirs too, once.
TEST(CalibrateVignetting, RimsAreNoSurerThanTheOpening)
{
	Calibration c = Estimated(synthetic::Shaded(TiltedBothWays(), RIM, 0.005, 1));
	const FalloffAnswer before = FalloffOf(c);
	WidenRimsByOpening({ 16, 0.48 }, c);
	const FalloffAnswer& after = FalloffOf(c);
	EXPECT_NEAR(after.radius_mm.sigma, std::hypot(before.radius_mm.sigma, 0.03 * before.radius_mm.value), 1e-12);
	EXPECT_NEAR(after.rims[0].distance_mm.sigma, std::hypot(before.rims[0].distance_mm.sigma, 0.03 * before.rims[0].distance_mm.value), 1e-12);
	for (const Effect& e : c.effects)
		for (const auto& [name, value] : e.values)
			EXPECT_TRUE(name != "R mm" || value.sigma == after.radius_mm.sigma) << value.sigma;
	// Of an opening that is not known nothing is told.
	WidenRimsByOpening({ 0, 0 }, c);
	EXPECT_NEAR(after.radius_mm.sigma, std::hypot(before.radius_mm.sigma, 0.03 * before.radius_mm.value), 1e-12);
}

TEST(CalibrateVignetting, ClippedWhiteIsNotBelieved)
{
	Calibration c = synthetic::Shaded(TiltedBothWays(), RIM, 0.005, 1);
	for (State& state : c.task.states)
		for (Photo& photo : state.photos)
		{
			photo.white.resize(8);
			photo.white_saturated = 40;
		}
	c.vignetting = EstimateVignetting(c);
	EXPECT_THAT(c.vignetting.failure, testing::HasSubstr("clipped"));
	EXPECT_EQ(CodeOf([&] { ChooseEffects(ParseEffects("vignetting_natural"), c); }), EXIT_REFUSED);
	ChooseEffects({}, c);
	EXPECT_FALSE(Uses(c, EffectId::VIGNETTING_NATURAL));
}
