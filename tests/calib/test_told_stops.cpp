// SPDX-License-Identifier: AGPL-3.0-or-later
//
// At which stops photographs were taken: by words, by EXIF, and what is refused.

#include "calibrate/exif_check.h"
#include "calibrate/stops_of_photographs.h"
#include "model/told_state.h"

#include <tiltcal/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ToldPhotographs, AreAStateAnFNumberAndAPattern)
{
	const ToldPhotographs plain = ParseToldPhotographs("plus5=a=b:c-*.png", "--state"), stopped = ParseToldPhotographs("plus5:f_number=5.6=dir=x/*.png", "--state");
	EXPECT_EQ(plain.state.name, "plus5");
	EXPECT_FALSE(plain.state.f_number);
	EXPECT_EQ(plain.pattern, "a=b:c-*.png");
	EXPECT_EQ(stopped.state.name, "plus5");
	EXPECT_EQ(stopped.state.f_number.value_or(0), 5.6);
	EXPECT_EQ(stopped.pattern, "dir=x/*.png");
}

TEST(ToldPhotographs, OtherWordsAndNumbersAreRefused)
{
	for (const char* const text : { "plus5", "plus5:f_number=8", "plus5:f_number" })
		EXPECT_THAT([&] { ParseToldPhotographs(text, "--state"); }, ThrowsMessage<Error>(HasSubstr("GLOB"))) << text;
	for (const char* const number : { "0", "-8", "eight", "", "nan", "inf", "8mm" })
		EXPECT_THAT([&] { ParseToldPhotographs(std::string("plus5:f_number=") + number + "=a", "--state"); }, ThrowsMessage<Error>(HasSubstr("no number above 0"))) << number;
	EXPECT_THAT([] { ParseToldPhotographs("plus5:aperture=8=a", "--state"); }, ThrowsMessage<Error>(HasSubstr("give f_number=N")));
}

/// A photograph of a task that was told and whose EXIF says these f-numbers; 0: not.
Photo Taken(double told, double exif)
{
	Photo photo;
	photo.file = "IMG.jpg";
	if (told > 0)
		photo.f_number = told;
	if (exif > 0)
		photo.facts.f_number = exif;
	return photo;
}

Task Photographed(const std::vector<Photo>& untilted, const std::vector<Photo>& tilted = {})
{
	Task task;
	task.states = { { "untilted", false, untilted }, { "plus5", true, tilted } };
	SetStops(task, {});
	return task;
}

std::vector<size_t> StopsOf(const Task& task)
{
	std::vector<size_t> all;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			all.push_back(photo.stop);
	return all;
}

TEST(SetStops, TheWidestIsTheReference)
{
	const Task task = Photographed({ Taken(8, 0), Taken(2.8, 0) }, { Taken(16, 0), Taken(2.8, 0) });
	ASSERT_EQ(task.stops.size(), 3u);
	EXPECT_EQ(task.stops[0].f_number, 2.8);
	EXPECT_EQ(task.stops[2].f_number, 16);
	EXPECT_EQ(StopsOf(task), (std::vector<size_t>{ 1, 0, 2, 0 }));
}

TEST(SetStops, OneFNumberIsNoStop)
{
	EXPECT_TRUE(Photographed({ Taken(5.6, 0), Taken(5.6, 5.657) }, { Taken(0, 5.6) }).stops.empty());
	EXPECT_TRUE(Photographed({ Taken(0, 0) }, { Taken(0, 0) }).stops.empty());
}

TEST(SetStops, ExifFillsIn)
{
	EXPECT_EQ(StopsOf(Photographed({ Taken(2.8, 0) }, { Taken(0, 8), Taken(0, 2.8) })), (std::vector<size_t>{ 0, 1, 0 }));
	// What is told counts.
	EXPECT_EQ(StopsOf(Photographed({ Taken(2.8, 4) }, { Taken(8, 4) })), (std::vector<size_t>{ 0, 1 }));
	// Nothing was told: of all, or of none.
	EXPECT_EQ(Photographed({ Taken(0, 2.8) }, { Taken(0, 8) }).stops.size(), 2u);
	EXPECT_TRUE(Photographed({ Taken(0, 2.8) }, { Taken(0, 8), Taken(0, 0) }).stops.empty());
}

TEST(SetStops, APhotographThatSaysNoneBesideOthersIsRefused)
{
	EXPECT_THAT([] { Photographed({ Taken(2.8, 0) }, { Taken(0, 0) }); }, ThrowsMessage<Error>(HasSubstr("give `state` plus5:f_number=N='IMG.jpg'")));
}

// A chip in an adapter writes one f-number whatever the ring says.
TEST(FNumberOfReference, IsWhatWasTold)
{
	const auto of = [](const Task& task) { return FNumberOfReference(task); };
	const auto stopped = of(Photographed({ Taken(2.8, 1.4) }, { Taken(8, 1.4) }));
	ASSERT_TRUE(stopped);
	EXPECT_EQ(stopped->value, 2.8);
	EXPECT_TRUE(stopped->told);
	// Told of all alike it is known too, though there is one stop.
	const Task one = Photographed({ Taken(5.6, 0) }, { Taken(5.6, 0) });
	ASSERT_TRUE(of(one));
	EXPECT_EQ(of(one)->value, 5.6);
	EXPECT_TRUE(PriorsFromExif(one, {}).empty()) << "one f-number is no stop and no prior";
	const std::vector<Prior> corrected = PriorsFromExif(Photographed({ Taken(5.6, 1.4) }, { Taken(5.6, 1.4) }), {});
	ASSERT_EQ(corrected.size(), 1u);
	EXPECT_EQ(corrected[0].value, 5.6);
	const auto exif = of(Photographed({ Taken(0, 4) }, { Taken(0, 4) }));
	ASSERT_TRUE(exif);
	EXPECT_FALSE(exif->told);
	EXPECT_FALSE(of(Photographed({ Taken(0, 4) }, { Taken(0, 5.6), Taken(0, 0) }))) << "they differ";
}

// Vignetting is of one opening.
TEST(FlatFields, OfAnotherSettingAreNamed)
{
	std::vector<std::string> warnings;
	const Log log([&](Severity, const std::string& text) { warnings.push_back(text); });
	const auto warn = [&](const Task& task, double f_number)
	{
		PhotographFacts facts;
		facts.f_number = f_number;
		warnings.clear();
		WarnOfOtherSetting(task, "wall.jpg", facts, log);
	};
	const Task stopped = Photographed({ Taken(2.8, 0) }, { Taken(8, 0) });
	warn(stopped, 2.83);
	EXPECT_THAT(warnings, testing::IsEmpty());
	warn(stopped, 8);
	EXPECT_THAT(warnings, testing::ElementsAre(testing::AllOf(HasSubstr("wall.jpg"), HasSubstr("f/8"), HasSubstr("widest stop are of f/2.8"))));
	warn(Photographed({ Taken(0, 0) }, { Taken(0, 0) }), 8);
	EXPECT_THAT(warnings, testing::IsEmpty()) << "nothing contradicts it";
}

TEST(CheckStops, RefusesWhatIsNone)
{
	Task task;
	task.stops = { { 2.8 }, { 8 } };
	EXPECT_NO_THROW(CheckStops(task));
	task.stops = { { 8 }, { 2.8 } };
	EXPECT_THROW(CheckStops(task), Error);
	task.stops = { { 2.8 }, { 0 } };
	EXPECT_THROW(CheckStops(task), Error);
	task.stops.clear();
	task.states.resize(1);
	task.states[0].photos.resize(1);
	task.states[0].photos[0].stop = 1;
	EXPECT_THROW(CheckStops(task), Error);
}

}
