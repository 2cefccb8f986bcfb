// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What EXIF makes the calibrator say: photographs that are not of one camera, and an answer that is not of the lens that wrote it.

#include "calibrate/exif_check.h"
#include "closed_loop.h"

#include <exiv2/exiv2.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

namespace
{

using namespace tiltcal;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What the library says, by its severity.
struct Heard
{
	std::vector<std::string> warnings, infos;

	Log Listen()
	{
		return Log([this](Severity severity, const std::string& text) { (severity == Severity::WARNING ? warnings : infos).push_back(text); });
	}
};

/// Two photographs of one camera and one setting, but for what `change` does to the second.
Heard OfTwo(const std::function<void(PhotographFacts&)>& change, bool stops = false)
{
	Photo a, b;
	a.file = "a.jpg";
	b.file = "b.jpg";
	a.facts.make = "Canon";
	a.facts.model = "EOS 6D";
	a.facts.lens = "TS-E45mm f/2.8";
	a.facts.focal_length_mm = 45;
	a.facts.f_number = 2.8;
	b.facts = a.facts;
	change(b.facts);
	Task task;
	task.states = { { "untilted", false, { a, b } } };
	if (stops)
		task.stops.resize(2);
	Heard heard;
	LogFacts(task, heard.Listen());
	return heard;
}

TEST(ExifWarnings, PhotographsOfOneSettingAreLeftInPeace)
{
	const Heard heard = OfTwo([](PhotographFacts&) {});
	EXPECT_THAT(heard.warnings, IsEmpty());
	EXPECT_THAT(heard.infos, ElementsAre(HasSubstr("TS-E45mm")));
	// One that says nothing contradicts nothing.
	EXPECT_THAT(OfTwo([](PhotographFacts& f) { f = {}; }).warnings, IsEmpty());
}

TEST(ExifWarnings, EachDifferenceIsNamedWithItsFiles)
{
	const auto says = [](const std::string& what, const std::function<void(PhotographFacts&)>& change)
	{
		EXPECT_THAT(OfTwo(change).warnings, ElementsAre(AllOf(HasSubstr("different " + what), HasSubstr("a.jpg"), HasSubstr("b.jpg"))));
	};
	says("cameras", [](PhotographFacts& f) { f.model = "EOS 5D"; });
	says("lenses", [](PhotographFacts& f) { f.lens = "TS-E90mm f/2.8"; });
	says("focal lengths", [](PhotographFacts& f) { f.focal_length_mm = 50; });
	says("f-numbers", [](PhotographFacts& f) { f.f_number = 4; });
	says("orientations", [](PhotographFacts& f) { f.orientation = 6; });
	EXPECT_THAT(OfTwo([](PhotographFacts& f) { f.f_number = 4; }, true).warnings, IsEmpty()) << "stops are told";
}

/// Adds to a file what `fill` says.
void AddExif(const std::string& file, const std::function<void(Exiv2::ExifData&)>& fill)
{
	const auto image = Exiv2::ImageFactory::open(file);
	image->readMetadata();
	fill(image->exifData());
	image->writeMetadata();
}

// Photographs whose EXIF is of a lens twice as long as the one that made them, one of them turned: read from files, measured and calibrated.
TEST(ExifWarnings, ReachWhoeverListensFromFiles)
{
	cameras::Camera camera = cameras::RandomCamera(7);
	camera.photos = 3;
	const cameras::Negatives negatives = cameras::Photograph(camera, 7);
	cameras::Light light = cameras::LightOf("jpeg");
	const auto files = cameras::DevelopAll(negatives, light, 1, testing::TempDir() + "exif-warnings");
	for (const StateFiles& state : files)
		for (const std::string& file : state.files)
			AddExif(file, [&](Exiv2::ExifData& exif)
			{
				exif["Exif.Photo.FocalLength"] = Exiv2::URational(uint32_t(2000 * negatives.camera.focal_length), 1000);
				exif["Exif.Photo.FNumber"] = Exiv2::URational(uint32_t(100 * negatives.camera.f_number), 100);
				exif["Exif.Image.Orientation"] = uint16_t(file == files[0].files[0] ? 6 : 1);
			});
	Heard heard;
	MeasureOptions measure;
	measure.log = heard.Listen();
	const cameras::Answer answer = cameras::CalibrateFiles(negatives, light, files, measure);
	ASSERT_EQ(answer.refusal, "");
	EXPECT_THAT(heard.warnings, Contains(HasSubstr("different orientations")));
	EXPECT_THAT(heard.infos, Contains(HasSubstr("EXIF orientation is not applied")));
	// Of f alone: the f-number is the camera's.
	EXPECT_THAT(CompareWithExif(answer.calibration), ElementsAre(HasSubstr("focal length f")));
	EXPECT_THAT(answer.calibration.verdict.remarks, Contains(AllOf(testing::Field(&Remark::grade, Grade::FAIR), testing::Field(&Remark::text, HasSubstr("EXIF")))));
}

}
