// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What other programs rely on: names, inputs in messages, what is refused at the door, the camera of a state.

#include "model/names.h"
#include "program/spelling.h"
#include "support/synthetic_lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiltcal/calibrate.h>
#include <tiltcal/camera.h>
#include <tiltcal/error.h>

#include <functional>
#include <set>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;

std::string Refusal(const std::function<void()>& run, ExitCode code)
{
	try
	{
		run();
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), code);
		return e.what();
	}
	ADD_FAILURE() << "not refused";
	return "";
}

TEST(Names, EveryModelAndEffectHasItsOwn)
{
	std::set<std::string> names;
	for (const Model model : { Model::PAPER, Model::RIGID, Model::PLANE, Model::CURVED, Model::LENS })
	{
		EXPECT_EQ(ModelNamed(NameOf(model)), model);
		EXPECT_STRNE(MeaningOf(model), "");
		names.insert(NameOf(model));
	}
	for (const EffectId effect : ALL_EFFECTS)
	{
		EXPECT_EQ(EffectNamed(NameOf(effect)), effect);
		names.insert(NameOf(effect));
	}
	EXPECT_EQ(names.size(), MODELS.size() + ALL_EFFECTS.size());
	EXPECT_FALSE(ModelNamed("auto") || EffectNamed("") || EffectNamed("vignetting"));
}

TEST(Spelling, InputsBecomeOptionsAndNothingElseDoes)
{
	EXPECT_EQ(SpelledAsOptions("`pitch` 3: give `flat_field`, `any_orientation`"), "--pitch 3: give --flat-field, --any-orientation");
	for (const char* const text : { "", "`", "``", "`x`.png", "`Pitch`", "`pitch", "pitch`", "` pitch`" })
		EXPECT_EQ(SpelledAsOptions(text), text);
	// As a person sees them; the library's own words are tested where they are made (Degenerate, Circles).
	EXPECT_EQ(SpelledAsOptions("give `circle_diameter` 13 if `square` 27 is right"), "give --circle-diameter 13 if --square 27 is right");
}

TEST(Library, RefusesWhatIsNoTask)
{
	EXPECT_THAT(Refusal([] { Calibrate({}); }, EXIT_USAGE), HasSubstr("`pitch`"));
	Task task;
	task.pitch_mm = 0.02;
	EXPECT_THAT(Refusal([&] { Calibrate(task); }, EXIT_USAGE), HasSubstr("no states"));
	task.states.push_back({ "untilted", false, {} });
	EXPECT_THAT(Refusal([&] { Calibrate(task); }, EXIT_USAGE), HasSubstr("state untilted: no photographs"));
	task.states[0].photos.resize(1);
	EXPECT_THAT(Refusal([&] { Calibrate(task); }, EXIT_USAGE), HasSubstr("width and height"));
	EXPECT_THAT(Refusal([&] { AddFlatField(task, 1, "wall.png"); }, EXIT_USAGE), HasSubstr("no state 1"));
	EXPECT_THAT(Refusal([] { CameraOfState({}, 0); }, EXIT_USAGE), HasSubstr("no state 0"));
	EXPECT_THAT(Refusal([] { MeasureAll({ { "untilted", { "nowhere.png" } } }, ParseBoard("12x9", 25), 0.02); }, EXIT_FILE), HasSubstr("nowhere.png"));
}

TEST(Library, IsHeardByItsListenerOnly)
{
	std::vector<std::string> heard;
	CalibrateOptions options;
	options.model = Model::PLANE;
	options.log = Log([&](Severity, const std::string& message) { heard.push_back(message); });
	testing::internal::CaptureStdout();
	testing::internal::CaptureStderr();
	const Calibration c = Calibrate(synthetic::TwoStates({}, synthetic::Tilted(5), { 0.03, 0.06, 3 }), options);
	EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
	EXPECT_THAT(heard, testing::Contains(HasSubstr("solving geometry and lens (plane)")));

	// A point in the plane of focus is sharp, and the camera's two ways are each other's inverse: rounding of some thousand pixels.
	const StateCamera camera = CameraOfState(c, 1);
	const Vec3<double> q = camera.PlaneOfFocus(), v = Unproject(camera, { 400, 300 }).value();
	const Vec3<double> P = (1 / Dot(q, v)) * v;
	EXPECT_NEAR(BlurWidth(camera, P), 0, 1e-9);
	EXPECT_GT(BlurWidth(camera, 1.1 * P), 1);
	const std::optional<Point> pixel = Project(camera, P);
	ASSERT_TRUE(pixel);
	EXPECT_NEAR((*pixel)[0], 400, 1e-6);
	EXPECT_NEAR((*pixel)[1], 300, 1e-6);
	EXPECT_FALSE(Project(camera, -1.0 * P));
	EXPECT_NEAR(q.x, c.solution.states[1].q.x, 1e-9);
	EXPECT_NEAR(q.y, c.solution.states[1].q.y, 1e-9);
	EXPECT_NEAR(q.z, c.solution.states[1].q.z, 1e-12);
}

}
