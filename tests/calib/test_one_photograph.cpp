// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What hangs on one photograph, of the untilted state too, is said; and a set in which nothing does is left in peace.

#include <tiltcal/calibrate.h>
#include "closed_loop.h"
#include "model/predict.h"
#include "support/synthetic_lens.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace
{

using namespace tiltcal;
using synthetic::Lens;
using synthetic::Noise;
using synthetic::Tilted;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

auto Says(const std::string& words) { return Contains(Field(&Remark::text, HasSubstr(words))); }

/// As measured in clean renders.
Noise NoiseOf(unsigned seed) { return { 0.03, 0.06, seed }; }

/// Three photographs a state; the last of the untilted ones with the lens `focused` elsewhere, as a share of 1/U.
Task ThreeEach(unsigned seed, double focused)
{
	const Lens lens;
	Lens other = lens;
	other.f = 1 / (1 / lens.f + focused / lens.FocusDistance());
	State untilted = synthetic::Photograph("untilted", lens, NoiseOf(seed), 3), tilted = synthetic::Photograph("tilted", Tilted(5), NoiseOf(seed + 100), 3);
	untilted.photos[2] = synthetic::Photograph("untilted", other, NoiseOf(seed), 3).photos[2];
	for (State* state : { &untilted, &tilted })
		for (size_t p = 0; p < state->photos.size(); ++p)
			state->photos[p].file = fmt::format("{}-{}.png", state->name, p + 1);
	return synthetic::MakeTask({ untilted, tilted });
}

// Focused by a hundredth nearer than the others: the field's curvature and d take most of it up, so that it does not stand out by its blur. Sigmas that hold how photographs scatter
// grow by as much as the answer moves. Which one it is, three photographs need not tell. A real lens has still more numbers to take it up.
TEST(OnePhotograph, OfTheUntiltedStateIsNamedWhereTheAnswerHangsOnIt)
{
	for (const Model model : { Model::CURVED, Model::PLANE, Model::RIGID })
		for (unsigned seed = 1; seed <= 3; ++seed)
		{
			SCOPED_TRACE(NameOf(model));
			const CalibrateOptions asked{ model, Poses::AUTO };
			const Calibration good = Calibrate(ThreeEach(seed, 0), asked);
			ASSERT_EQ(good.solution.left_out.size(), 6u);
			EXPECT_THAT(good.verdict.remarks, Not(Says(": without ")));
			const Calibration c = Calibrate(ThreeEach(seed, 0.01), asked);
			// Where f ties all states together, one of six moves the answer too little to be seen.
			if (model != Model::RIGID)
			{
				EXPECT_THAT(c.verdict.remarks, Says("state untilted: without untilted-"));
			}
			EXPECT_GT(c.verdict.grade, Grade::GOOD);
		}
}

TEST(OnePhotograph, AloneInTheUntiltedStateIsSaid)
{
	Task task = ThreeEach(1, 0);
	task.states[0].photos.resize(1);
	EXPECT_THAT(Calibrate(task, { Model::CURVED, Poses::AUTO }).verdict.remarks, Says("state untilted: one photograph alone"));
}

/// A lens that distorts, whose boards stood still between the states: where the axis of its distortion lies is seen.
const cameras::Negatives& Distorted()
{
	static const cameras::Negatives negatives = []
	{
		cameras::Camera camera = cameras::Quick(cameras::RandomCamera(1001), 0.3);
		camera.k1 = -0.1;
		camera.tilts = { { 5, 40 } };
		camera.shared_poses = true;
		return cameras::Photograph(camera, 1001);
	}();
	return negatives;
}

TEST(OnePhotograph, BlurOfTheUntiltedStateIsHeldAgainstItsPlaces)
{
	const cameras::Light light = cameras::LightOf("snr200");
	const cameras::Answer answer = cameras::CloseTheLoop(Distorted(), light, 1, testing::TempDir() + "blur-against-places", { Model::PLANE, Poses::SHARED });
	ASSERT_EQ(answer.refusal, "");
	const Calibration& good = answer.calibration;
	ASSERT_TRUE(good.untilted_check.by_places);
	// Nothing is tilted: by chance beyond 4 sigma once in 3000, as a vector.
	EXPECT_LT(std::abs(good.untilted_check.by_places->lens_tilt.value), 4 * good.untilted_check.by_places->lens_tilt.sigma);
	EXPECT_LT(good.untilted_check.by_places->lens_tilt.sigma, 1);
	EXPECT_THAT(good.verdict.remarks, Not(Says("blur and geometry")));
	// The blur of a lens tilted by 5 degrees on the places of one that is not.
	Task task = good.task;
	for (size_t p = 0; p < task.states[0].photos.size(); ++p)
		for (Edge& e : task.states[0].photos[p].edges)
			e.blur = PredictedBlurAs(good, 1, 0, p, e);
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::SHARED });
	EXPECT_THAT(c.verdict.remarks, Says("state untilted: blur and geometry, each alone, disagree"));
	EXPECT_GT(c.verdict.grade, Grade::GOOD);
}

}
