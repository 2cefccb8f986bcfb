// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Chromatic aberration from the colours of edges; blades; what the writers make of the effects that are used.

#include <tiltcal/calibrate.h>
#include "camera/camera_block.h"
#include "effects/chromatic_fit.h"
#include "effects/effects.h"
#include <tiltcal/error.h>
#include "base/files.h"
#include "picture/image_io.h"
#include "effects/fixed_blades.h"
#include "measure/measure.h"
#include "measure/measure_colours.h"
#include "camera/pose.h"
#include "support/comma_locale.h"
#include "support/shaded_lens.h"
#include "support/thin_lens_picture.h"
#include "effects/vignetting.h"
#include "camera/write_inc.h"
#include "report/write_json.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <cstdlib>
#include <random>

using namespace tiltcal;
using synthetic::Lens;
using testing::HasSubstr;
using testing::Not;

namespace
{

const double RED = 3e-4, BLUE = -2e-4;   // 0.3 and 0.2 px at 1000 px from the axis

/// Where a lens whose image is (1 + lateral) times as large about its axis puts what else is at (u, v): by turning into the
/// lens's axes and back.
Eigen::Vector2d Enlarged(const Lens& lens, double lateral, double u, double v)
{
	const double t = lens.tilt * M_PI / 180, phi = lens.direction * M_PI / 180;
	const Eigen::Vector3d n(-std::sin(phi) * std::sin(t), -std::cos(phi) * std::sin(t), std::cos(t));
	const Eigen::Matrix3d lens_from_camera = Eigen::Quaterniond::FromTwoVectors(n, Eigen::Vector3d::UnitZ()).toRotationMatrix();
	Eigen::Vector3d d = lens_from_camera * Eigen::Vector3d((u - lens.cx) * synthetic::PITCH, -(v - lens.cy) * synthetic::PITCH, lens.w);
	d.head<2>() *= 1 + lateral;
	d = lens_from_camera.transpose() * d;
	return { lens.cx + d.x() / d.z() * lens.w / synthetic::PITCH, lens.cy - d.y() / d.z() * lens.w / synthetic::PITCH };
}

/// As synthetic::Shaded, with every third edge measured in three colours.
Calibration Coloured(const std::vector<Lens>& lenses, double red, double blue, double noise, unsigned seed)
{
	Calibration c = synthetic::Shaded(lenses, { false, 0, 0, 0 }, 0.005, seed);
	std::mt19937 random(seed);
	std::normal_distribution<double> normal(0, noise);
	c.solution.psf_floor_squared = { 1, 0 };
	for (size_t s = 0; s < lenses.size(); ++s)
	{
		for (Photo& photo : c.task.states[s].photos)
		{
			c.geometry.states[s].poses.push_back({ 0.5, 0, 0, -125, 87, 630 });   // for the blur only, which is the same in all colours here
			photo.coloured = true;
			for (size_t k = 0; k < photo.edges.size(); k += 3)
			{
				ColourEdge e;
				e.green = photo.edges[k];
				for (size_t i = 0; i < 2; ++i)
				{
					const Eigen::Vector2d moved = Enlarged(lenses[s], i ? blue : red, e.green.x, e.green.y) - Eigen::Vector2d(e.green.x, e.green.y);
					e.shift[i] = moved.x() * e.green.nx + moved.y() * e.green.ny + normal(random);
					e.shift_sigma[i] = noise;
					e.widening[i] = normal(random);
					e.widening_sigma[i] = noise;
				}
				photo.colours.push_back(e);
			}
		}
	}
	c.pinhole = c.geometry;
	c.render = c.solution;
	return c;
}

std::vector<Lens> Tilted()
{
	Lens up, aside;
	up.tilt = 6;
	aside.tilt = 5;
	aside.direction = 90;
	return { Lens(), up, aside };
}

double Off(const Estimate& e, double truth) { return std::abs(e.value - truth) / e.sigma; }

Calibration Chosen(Calibration c, const char* effects = "auto")
{
	c.vignetting = EstimateVignetting(c);
	c.chromatic = EstimateChromatic(c);
	ChooseEffects(ParseEffects(effects), c);
	return c;
}

}

TEST(Chromatic, LateralIsFoundAboutTheTiltedAxis)
{
	double squares = 0;
	for (unsigned seed = 1; seed <= 5; ++seed)
	{
		const Chromatic found = EstimateChromatic(Coloured(Tilted(), RED, BLUE, 0.03, seed));
		squares += std::pow(Off(found.lateral[0], RED), 2) + std::pow(Off(found.lateral[1], BLUE), 2);
		// Of ten numbers one is beyond 3.9 sigma once in a thousand.
		EXPECT_LT(Off(found.lateral[0], RED), 3.9) << seed;
		EXPECT_LT(Off(found.lateral[1], BLUE), 3.9) << seed;
	}
	// Of ten numbers in their sigmas, chi-squared: beyond each of these once in a thousand.
	EXPECT_LT(squares, 29.6);
	EXPECT_GT(squares, 1.48);
	const Calibration c = Chosen(Coloured(Tilted(), RED, BLUE, 0.03, 1));
	EXPECT_LT(c.chromatic.lateral[0].sigma, 0.03 * RED);   // 0.03 px on 600 edges some 350 px from the axis
	EXPECT_TRUE(Uses(c, EffectId::CHROMATIC_LATERAL));
	EXPECT_FALSE(Uses(c, EffectId::CHROMATIC_AXIAL)) << EffectsText(c);
}

// Exact shifts give the exact numbers: the axis is the tilted lens's own. About the sensor's axis the error would be 3e-5 and more.
TEST(Chromatic, LateralIsExactWithoutNoise)
{
	const Calibration c = Coloured(Tilted(), RED, BLUE, 1e-9, 1);
	const Chromatic found = EstimateChromatic(c);
	EXPECT_NEAR(found.lateral[0].value, RED, 1e-3 * RED);   // the slope is linear, the shift is not quite
	EXPECT_NEAR(found.lateral[1].value, BLUE, 1e-3 * RED);
}

TEST(Chromatic, NothingIsWrittenWhereColoursAgree)
{
	// Of two numbers the larger is beyond 2 sigma nine times in a hundred, and must predict edges left out better, too, as half of chance does at most: of twenty sets seven or more one time in
	// 800, for each of the two effects.
	int lateral = 0, axial = 0;
	for (unsigned seed = 1; seed <= 20; ++seed)
	{
		const Calibration c = Chosen(Coloured(Tilted(), 0, 0, 0.03, seed));
		const bool has_lateral = Uses(c, EffectId::CHROMATIC_LATERAL), has_axial = Uses(c, EffectId::CHROMATIC_AXIAL);
		lateral += has_lateral;
		axial += has_axial;
		if (!has_lateral && !has_axial)
		{
			EXPECT_THAT(CameraInc(c, 0), Not(HasSubstr("\tchromatic")));
			EXPECT_THAT(CameraInc(c, 0), HasSubstr("of chromatic aberration; not used: "));
		}
	}
	EXPECT_LT(lateral, 7);
	EXPECT_LT(axial, 7);
	EXPECT_THAT(CameraInc(Chosen(Coloured(Tilted(), RED, BLUE, 0.03, 1)), 0), HasSubstr("chromatic lateral TiltCal_state0_Lateral_Red, TiltCal_state0_Lateral_Blue\n"));
}

namespace
{

/// A photograph in colour: red and blue through a lens whose image is larger or smaller about the picture's middle.
struct ColourPicture
{
	Photo photo;
	cv::Mat picture;
};

ColourPicture TakeColours(double direction, double red, double blue)
{
	synthetic::Scene scene;
	scene.width = 480;
	scene.height = 360;
	scene.w_px = 600;
	scene.aperture = 6;
	scene.noise = 0.01;
	scene.lens_points = 80;
	synthetic::Aim(scene, 105, 75, 470, 30, direction, 0);
	std::vector<cv::Mat> channels;
	for (const double lateral : { blue, 0.0, red })
	{
		synthetic::Scene coloured = scene;
		coloured.w_px *= 1 + lateral;
		coloured.seed = unsigned(channels.size() + 1);
		channels.push_back(synthetic::TakePicture(coloured, synthetic::Checkerboard(9, 7, 30)));
	}
	ColourPicture result;
	cv::merge(channels, result.picture);
	const Board board = ParseBoard("9x7", 30);
	for (int j = 0; j < board.InnerRows(); ++j)
		for (int i = 0; i < board.InnerColumns(); ++i)
		{
			const Eigen::Vector2d p = synthetic::PixelOf(scene, 30 * i, 30 * j);
			result.photo.corners.push_back({ i, j, p.x(), p.y(), 0.05 });
		}
	MeasureEdges(channels[1], board, result.photo, { 30, 0 });
	return result;
}

/// A task of such photographs, as if solved.
Calibration FromPictures(std::vector<ColourPicture> pictures)
{
	Calibration c;
	c.task.board = ParseBoard("9x7", 30);
	c.task.pitch_mm = 0.02;
	c.task.width = 480;
	c.task.height = 360;
	State state;
	c.geometry.states.resize(1);
	for (ColourPicture& p : pictures)
	{
		MeasureColours(p.picture, c.task.board, p.photo);
		state.photos.push_back(p.photo);
		c.geometry.states[0].poses.push_back({ 0.5, 0, 0, -105, 75, 470 });
	}
	c.task.states = { state };
	c.geometry.w_px = 600;
	c.geometry.states[0].principal_point = { 239.5, 179.5 };
	c.solution.model = Model::PLANE;
	c.solution.aperture_diameter = { 6, 0 };
	c.solution.psf_floor_squared = { 1, 0 };
	c.solution.states.resize(1);
	c.solution.states[0].q = { 0, 0, 1 / 500. };
	return c;
}

}

// 2.5 sigma: of two normal numbers one is beyond once in 40 draws of the pictures' noise.
TEST(Chromatic, PicturesInThreeColoursTellIt)
{
	const double red = 2e-3, blue = -1e-3;   // 0.4 and 0.2 px in this small picture
	std::vector<ColourPicture> pictures{ TakeColours(10, red, blue), TakeColours(100, red, blue) };
	const Chromatic found = EstimateChromatic(FromPictures(pictures));
	ASSERT_EQ(found.failure, "");
	EXPECT_LT(Off(found.lateral[0], red), 2.5) << found.lateral[0].value << " +- " << found.lateral[0].sigma;
	EXPECT_LT(Off(found.lateral[1], blue), 2.5) << found.lateral[1].value << " +- " << found.lateral[1].sigma;
	EXPECT_LT(found.lateral[0].sigma, 0.1 * red);
}

// OpenCV writes 4:2:0, of which a shift of 0.4 px comes back as 0.14 at any quality, and surely so: nothing is said then.
TEST(Chromatic, SubsampledColoursTellNothing)
{
	ColourPicture p = TakeColours(10, 2e-3, -1e-3);
	cv::Mat coded;
	cv::pow(p.picture, 1 / 2.2, coded);
	coded.convertTo(coded, CV_8UC3, 255);
	for (const char* const suffix : { "jpg", "png" })
	{
		const std::string file = testing::TempDir() + "colours." + suffix;
		cv::imwrite(file, coded, { cv::IMWRITE_JPEG_QUALITY, 98 });
		p.picture = ReadLinear(file, ParseTransfer("2.2"), &p.photo.facts);
		EXPECT_EQ(p.photo.facts.subsampled_colour, std::string(suffix) == "jpg");
		const Chromatic found = EstimateChromatic(FromPictures({ p, p }));
		if (p.photo.facts.subsampled_colour)
			EXPECT_THAT(found.failure, HasSubstr("half the size"));
		else
			EXPECT_EQ(found.failure, "");
	}
}

// Light in floating point may be of any unit.
TEST(Chromatic, DarkFloatingPointIsNoGrey)
{
	const Board board = ParseBoard("9x7", 30);
	ColourPicture p = TakeColours(10, 2e-3, -1e-3);
	p.picture *= 1e-4;
	MeasureColours(p.picture, board, p.photo);
	EXPECT_FALSE(p.photo.coloured) << "less than a code of 8 bits";
	p.photo.facts.floating_point = true;
	MeasureColours(p.picture, board, p.photo);
	EXPECT_TRUE(p.photo.coloured);
}

TEST(Chromatic, GreyPicturesTellNothing)
{
	const Board board = ParseBoard("9x7", 30);
	ColourPicture p = TakeColours(10, 0, 0);
	std::vector<cv::Mat> channels;
	cv::split(p.picture, channels);
	MeasureColours(channels[1], board, p.photo);
	EXPECT_FALSE(p.photo.coloured);
	cv::merge(std::vector<cv::Mat>{ channels[1], channels[1], channels[1] }, p.picture);
	const Chromatic found = EstimateChromatic(FromPictures({ p }));
	EXPECT_THAT(found.failure, HasSubstr("grey"));
}

// The second moment of a regular polygon of circumradius 1 about its centre, over its area: (2 + cos(2 pi/N)) / 6 (Steiner's theorem on its triangles).
TEST(Blades, HaveTheDiscsSecondMoment)
{
	for (const int count : { 3, 5, 8, 64 })
	{
		const FixedBlades straight{ count, 17, 0 }, round{ count, 17, 1 }, between{ count, 0, 0.5 };
		const double exact = (2 + std::cos(2 * M_PI / count)) / 6;
		EXPECT_NEAR(MeanSquareRadius(straight), exact, 1e-5);   // 512 x 512 points
		EXPECT_NEAR(WideningForBlades(straight), std::sqrt(0.5 / exact), 2e-5);
		EXPECT_NEAR(WideningForBlades(round), 1, 1e-5);
		EXPECT_GT(WideningForBlades(between), 1);
		EXPECT_LT(WideningForBlades(between), WideningForBlades(straight));
	}
	EXPECT_EQ(WideningForBlades({}), 1);
}

TEST(Blades, AreTakenFromFixOrRefused)
{
	FixedBlades blades;
	EXPECT_FALSE(TakeBlades("f_number=2.8", blades));
	EXPECT_TRUE(TakeBlades("blades=8", blades));
	EXPECT_TRUE(TakeBlades("blade_rotation=-22.5", blades));
	EXPECT_TRUE(TakeBlades("blade_curvature=0.3", blades));
	EXPECT_EQ(blades.count, 8);
	EXPECT_EQ(blades.rotation_deg, -22.5);
	EXPECT_EQ(blades.curvature, 0.3);
	for (const char* const text : { "blades=2", "blades=65", "blades=7.5", "blades", "blades=x", "blade_rotation=inf", "blade_curvature=1.1", "blade_curvature=" })
		EXPECT_THROW(TakeBlades(text, blades), Error) << text;
	EXPECT_THROW(CheckBlades({ 0, 10, 0 }), Error);
	EXPECT_NO_THROW(CheckBlades(blades));
}

TEST(EffectWords, AreAbsentUnlessGiven)
{
	const auto lines = [](const StateCamera& camera) { return EffectLines(camera, PlainNumbers(1), {}); };
	EXPECT_EQ(lines({}), "");
	StateCamera words;
	words.natural_vignetting = true;
	words.axial_per_mm = { 1, 2 };
	EXPECT_EQ(lines(words), "\t\tvignetting natural\n\t\tchromatic axial 1, 2\n");
	words.lateral = { 3, 4 };
	words.rims_mm = { { 5, 6 } };
	words.blades = { 7, 0, 1 };
	EXPECT_EQ(lines(words), "\t\tvignetting natural\n\t\tvignetting optical 5, 6\n\t\tchromatic lateral 3, 4 axial 1, 2\n\t\tblades 7 rotation 0 curvature 1\n");
}

namespace
{

/// A whole calibration of exact measurements, with everything that can be used.
Calibration Everything(const char* effects)
{
	Calibration c = Coloured(Tilted(), RED, BLUE, 0.03, 1);
	const Calibration shaded = synthetic::Shaded(Tilted(), { true, 12.5, 21, 0, 8.8, 13 }, 0.005, 1);
	c.task.states[0].photos[0].file = "a.png";
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
		{
			Photo& photo = c.task.states[s].photos[p];
			const Photo& other = shaded.task.states[s].photos[p];
			photo.white = other.white;
			for (size_t k = 0; k < photo.edges.size(); ++k)
			{
				photo.edges[k].x = other.edges[k].x;
				photo.edges[k].y = other.edges[k].y;
				photo.edges[k].offset_sigma = other.edges[k].offset_sigma;
			}
		}
	c.task.blades = { 8, 10, 0.25 };
	return Calibrate(c.task, { Model::PLANE, Poses::SHARED, Refinement::NONE, ParseEffects(effects) });
}

}

TEST(Effects, AreWrittenWithPointsInAnyLocale)
{
	const Calibration c = Everything("vignetting_natural,vignetting_optical,chromatic_lateral,chromatic_axial,blades");
	const std::string inc = CameraInc(c, 1), json = CalibrationJson(c);
	const CommaLocale comma;
	EXPECT_EQ(CameraInc(c, 1), inc);
	EXPECT_EQ(CalibrationJson(c), json);
}

TEST(Effects, ReachTheIncAndThePoseThroughTheJson)
{
	const Calibration c = Everything("vignetting_natural,vignetting_optical,chromatic_lateral,chromatic_axial,blades");
	const std::string inc = CameraInc(c, 1);
	for (const char* const words : { "\t\tvignetting natural\n", "\t\tvignetting optical TiltCal_state1_Rim_Radius, TiltCal_state1_Rim_Distance, TiltCal_state1_Rim2_Radius, TiltCal_state1_Rim2_Distance\n", "chromatic lateral TiltCal_state1_Lateral_Red, TiltCal_state1_Lateral_Blue axial ",
		"\t\tblades 8 rotation 10 curvature 0.25\n", "of the circle through the blades' corners" })
		EXPECT_THAT(inc, HasSubstr(words));
	for (const char* const words : { "distortion", "field_curvature" })
		EXPECT_THAT(inc.substr(inc.find("tilt_lens {")), Not(HasSubstr(words)));

	const std::string file = testing::TempDir() + "effects-calibration.json";
	WriteText(file, CalibrationJson(c));
	const StateCamera camera = ReadStateCamera(file, "state1");
	EXPECT_TRUE(camera.natural_vignetting);
	ASSERT_TRUE(camera.lateral && camera.axial_per_mm);
	ASSERT_EQ(camera.rims_mm.size(), 2u);
	EXPECT_EQ(camera.rims_mm[0][0], FalloffOf(c).radius_mm.value);
	EXPECT_EQ(camera.rims_mm[0][1], FalloffOf(c).distance_mm.value);
	EXPECT_EQ(camera.rims_mm[1][0], FalloffOf(c).rims[1].radius_mm.value);
	EXPECT_EQ(camera.rims_mm[1][1], FalloffOf(c).rims[1].distance_mm.value);
	EXPECT_LT(camera.rims_mm[1][1], 0);
	// Files of earlier versions know one rim.
	std::string old = CalibrationJson(c);
	old.replace(old.find("\"rims\""), 6, "\"else\"");
	const std::string old_file = testing::TempDir() + "old-calibration.json";
	WriteText(old_file, old);
	EXPECT_EQ(ReadStateCamera(old_file, "state1").rims_mm, decltype(camera.rims_mm)(1, camera.rims_mm[0]));
	EXPECT_EQ((*camera.lateral)[0], c.chromatic.lateral[0].value);
	EXPECT_EQ((*camera.axial_per_mm)[1], c.chromatic.axial_per_mm[1].value);
	EXPECT_EQ(camera.blades.count, 8);
	EXPECT_NEAR(camera.aperture_diameter_mm, c.solution.aperture_diameter.value * WideningForBlades(c.task.blades), 1e-9);
	const std::string block = PoseInc(camera, CameraPose(), 10);   // a scene unit of 10 mm
	EXPECT_THAT(block, HasSubstr("vignetting natural\n"));
	EXPECT_NEAR(std::atof(block.substr(block.find("vignetting optical ") + 19).c_str()), FalloffOf(c).radius_mm.value / 10, 1e-6);
	EXPECT_THAT(block, HasSubstr(fmt::format(", {:.10g}, {:.10g}\n", camera.rims_mm[1][0] / 10, camera.rims_mm[1][1] / 10)));
	EXPECT_NEAR(std::atof(block.substr(block.find(" axial ") + 7).c_str()), c.chromatic.axial_per_mm[0].value * 10, 1e-9);
	EXPECT_THAT(block, HasSubstr("blades 8 rotation 10 curvature 0.25\n"));
}

TEST(Effects, NoneLeavesABareLens)
{
	const Calibration c = Everything("none");
	const std::string inc = CameraInc(c, 1), block = inc.substr(inc.find("tilt_lens {"));
	for (const char* const word : { "vignetting", "chromatic", "blades", "distortion", "field_curvature" })
		EXPECT_THAT(block.substr(0, block.find('}')), Not(HasSubstr(word)));
	const std::string file = testing::TempDir() + "none-calibration.json";
	WriteText(file, CalibrationJson(c));
	const StateCamera camera = ReadStateCamera(file, "");
	EXPECT_FALSE(camera.natural_vignetting || !camera.rims_mm.empty() || camera.lateral || camera.axial_per_mm || camera.blades.count);
	EXPECT_EQ(camera.aperture_diameter_mm, c.solution.aperture_diameter.value);
}
