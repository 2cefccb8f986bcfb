// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Cameras held upright: pictures higher than wide, and those whose files lie on their side and say so in EXIF.

#include "closed_loop.h"
#include "model/tilt_angles.h"

#include <exiv2/exiv2.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>

namespace
{

using namespace tiltcal;
using cameras::Answer;
using testing::Contains;
using testing::HasSubstr;

/// A camera of 640 x 480 pixels, held upright.
const cameras::Negatives& Upright()
{
	static const cameras::Negatives negatives = []
	{
		cameras::Camera camera = cameras::RandomCamera(7);
		camera.pitch *= double(camera.width) / 640;
		camera.width = 480;
		camera.height = 640;
		camera.photos = 3;
		return cameras::Photograph(camera, 7);
	}();
	return negatives;
}

const cameras::Light LIGHT = cameras::LightOf("snr200");

std::vector<StateFiles> Files(const std::string& folder) { return cameras::DevelopAll(Upright(), LIGHT, 1, testing::TempDir() + folder); }

TEST(Portrait, PicturesHigherThanWideAreCalibratedAsAnyOther)
{
	ASSERT_GT(Upright().camera.height, Upright().camera.width);
	const Answer a = cameras::CalibrateFiles(Upright(), LIGHT, Files("portrait"));
	ASSERT_EQ(a.refusal, "");
	// Some 12 numbers: 4 sigma each, by chance once in 1300 sets.
	EXPECT_GT(a.deviations.size(), 8u);
	for (const cameras::Deviation& d : a.deviations)
		EXPECT_LT(std::abs(d.InSigmas()), 4) << d.name;
}

/// As the sensor of a camera held upright has them, with EXIF that says how a viewer is to turn them.
void LayOnTheirSide(const std::vector<StateFiles>& states)
{
	for (const StateFiles& state : states)
		for (const std::string& file : state.files)
		{
			cv::Mat picture = cv::imread(file, cv::IMREAD_UNCHANGED);
			cv::rotate(picture, picture, cv::ROTATE_90_COUNTERCLOCKWISE);
			cv::imwrite(file, picture, { cv::IMWRITE_TIFF_COMPRESSION, 1 });
			const auto image = Exiv2::ImageFactory::open(file);
			image->readMetadata();
			image->exifData()["Exif.Image.Orientation"] = uint16_t(6);
			image->writeMetadata();
		}
}

TEST(Portrait, FilesOnTheirSideAreRefusedOrTakenAsTheSensorHadThem)
{
	const std::vector<StateFiles> files = Files("portrait-exif");
	const Answer upright = cameras::CalibrateFiles(Upright(), LIGHT, files);
	LayOnTheirSide(files);
	EXPECT_THAT(cameras::CalibrateFiles(Upright(), LIGHT, files).refusal, HasSubstr("the board stands on its side"));

	std::vector<std::string> said;
	MeasureOptions measure;
	measure.any_orientation = true;
	measure.log = Log([&](Severity, const std::string& text) { said.push_back(text); });
	const Answer lying = cameras::CalibrateFiles(Upright(), LIGHT, files, measure);
	ASSERT_EQ(upright.refusal + lying.refusal, "");
	EXPECT_THAT(said, Contains(HasSubstr("EXIF orientation is not applied")));
	EXPECT_EQ(lying.calibration.task.width, Upright().camera.height);
	// The same light in the same pixels, so that a difference of one sigma would be another measurement. What was up lies on the left.
	const Solution &a = upright.calibration.solution, &b = lying.calibration.solution;
	EXPECT_NEAR(a.w_mm.value, b.w_mm.value, a.w_mm.sigma);
	EXPECT_NEAR(a.aperture_diameter.value, b.aperture_diameter.value, a.aperture_diameter.sigma);
	const StateLens &tilted = a.states[1], &turned = b.states[1];
	const Eigen::Vector2d difference = TiltVector(tilted.lens_tilt.value, tilted.tilt_direction.value - 90) - TiltVector(turned.lens_tilt.value, turned.tilt_direction.value);
	EXPECT_LT(difference.norm(), tilted.lens_tilt.sigma);
}

}
