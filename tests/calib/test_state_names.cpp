// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose.h"
#include "model/state_names.h"
#include "support/posed_camera.h"
#include "target/target.h"
#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;

std::string Refusal(const std::vector<std::string>& names)
{
	try
	{
		CheckStateNames(names);
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_USAGE);
		return e.what();
	}
	return "accepted";
}

TEST(StateNames, AreWrittenWithUnderscores)
{
	EXPECT_EQ(WithUnderscores("tilt37-az030"), "tilt37_az030");
	EXPECT_EQ(WithUnderscores("f 2.8"), "f_2_8");
	EXPECT_EQ(WithUnderscores("../up"), "../up");   // refused as it was given
	EXPECT_EQ(WithUnderscores(""), "");
}

TEST(StateNames, AreIdentifiersOrAnotherIsOffered)
{
	for (const char* const good : { "untilted", "plus5", "_a", "rim", "Rims", "Distortion1" })
		EXPECT_EQ(Refusal({ good }), "accepted") << good;
	const std::pair<const char*, const char*> bad[] = { { "", "such as plus5" }, { "5", "call it state_5" }, { "a/b", "call it a_b" }, { "a+", "call it a" }, { "f\xFCr 1", "call it f_r_1" },
		{ "f\xC3\xBCr", "call it f_r" }, { "+", "such as plus5" }, { "Rim", "call it state_Rim" }, { "Target_Black", "call it state_Target_Black" }, { "a\n#error", "call it a_error" } };
	for (const auto& [name, words] : bad)
	{
		EXPECT_THAT(Refusal({ name }), HasSubstr(words));
		EXPECT_EQ(Refusal({ name }).find('\n'), std::string::npos);
	}
}

TEST(StateNames, HaveNoIdentifierInCommon)
{
	EXPECT_EQ(Refusal({ "untilted", "up", "up_1", "up_pose", "upPose" }), "accepted");
	EXPECT_THAT(Refusal({ "untilted", "up", "up" }), HasSubstr("already taken"));
	EXPECT_THAT(Refusal({ "up", "up_Photo_12_Look_At" }), HasSubstr("of state up calls"));
	EXPECT_THAT(Refusal({ "up_Body", "up" }), HasSubstr("up_Body"));
}

/// The door of the library: other programs name states too.
TEST(StateNames, AreCheckedBeforePhotographsAreRead)
{
	EXPECT_THROW(MeasureAll({ { "a\nb", { "nowhere.png" } } }, ParseBoard("12x9", 25), 0.02, {}), Error);
}

TEST(StateNames, OfOtherFilesAreTaken)
{
	const std::string incs = PoseInc(TiltedCamera(), CameraPose(), 1) + TargetInc(LayOut(MakeBoard(TargetKind::CIRCLES, "7x6", 18, 0, ""), "auto", 10));
	const std::regex declared("#declare TiltCal_([A-Za-z0-9_]+)");
	size_t seen = 0;
	for (auto at = std::sregex_iterator(incs.begin(), incs.end(), declared); at != std::sregex_iterator(); ++at, ++seen)
		EXPECT_THAT(Refusal({ (*at)[1] }), HasSubstr("something else")) << (*at)[1];
	EXPECT_GE(seen, 12u);
}

}
