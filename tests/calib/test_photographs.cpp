// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What `tiltcal calibrate` wrote for the photographs in scenes/boxes/photos (the fixture
// calib.photographs.calibrate ran it): the acceptance numbers of issue 2.

#include "model/state_names.h"
#include "support/page_check.h"
#include <tiltcal/error.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

namespace
{

using Json = nlohmann::json;
const std::string FOLDER = CALIBRATION_FOLDER;

Json Calibration()
{
	std::ifstream in(FOLDER + "/calibration.json");
	EXPECT_TRUE(in) << FOLDER << "/calibration.json is missing";
	return Json::parse(in);
}

Json State(const Json& json, const std::string& name)
{
	for (const Json& state : json.at("states"))
		if (state.at("name") == name)
			return state;
	ADD_FAILURE() << "no state " << name;
	return {};
}

TEST(Photographs, LensTiltAndDirection)
{
	const Json json = Calibration();
	for (const auto& [name, truth] : { std::pair{ "plus5", 5.0 }, std::pair{ "minus5", -5.0 } })
	{
		const Json state = State(json, name);
		// Issue 5: 0.25 degrees of the tilt as a vector, 0.1 aimed at. The plane model, which takes field curvature for
		// tilt, misses that: by the simulation's rays the best plane belongs to 5.4 degrees and more (povray-patch/lens/MODEL.md).
		const double tilt = state.at("lens_tilt_deg"), phi = state.at("tilt_direction_deg").get<double>() * M_PI / 180;
		EXPECT_LT(std::hypot(tilt * std::sin(phi), tilt * std::cos(phi) - truth), 0.1);
		// Noise alone is a small part of that.
		EXPECT_LT(state.at("lens_tilt_sigma_deg").get<double>(), 0.1);
	}
}

// Real glass, which the simulation traced: the thin lens with its bowl is four of its sigmas off, one real lens must not be beyond three; it is what the tilts are told by.
TEST(Photographs, TiltsOfTheRealLensAreWithinTheirSigmas)
{
	const Json lens = Calibration().at("real_lens");
	ASSERT_EQ(lens.at("states").size(), 3u);
	EXPECT_TRUE(lens.at("used").get<bool>());
	EXPECT_LT(lens.at("held_out"), 0.95 * lens.at("held_out_thin").get<double>());
	EXPECT_EQ(State(Calibration(), "plus5").at("lens_tilt_deg"), lens.at("states")[1].at("lens_tilt_deg"));
	EXPECT_NE(State(Calibration(), "plus5").at("thin").at("lens_tilt_deg"), lens.at("states")[1].at("lens_tilt_deg"));
	for (const auto& [at, truth] : { std::pair{ 1, 5.0 }, std::pair{ 2, -5.0 } })
	{
		const Json& state = lens.at("states")[size_t(at)];
		const double tilt = state.at("lens_tilt_deg"), phi = state.at("tilt_direction_deg").get<double>() * M_PI / 180;
		const double along = state.at("lens_tilt_sigma_deg"), across = state.at("tilt_direction_sigma_deg").get<double>() * M_PI / 180 * std::abs(tilt);
		EXPECT_LT(std::abs(tilt * std::cos(phi) - truth), 3 * along);
		EXPECT_LT(std::abs(tilt * std::sin(phi)), 3 * across);
		// What was to be reached at f/2.8, set before it was: 0.02 degrees.
		EXPECT_LT(std::hypot(tilt * std::sin(phi), tilt * std::cos(phi) - truth), 0.02);
		// What the verdict calls good.
		EXPECT_LT(along, 0.03);
		EXPECT_LT(across, 0.03);
	}
	// A double Gauss is under-corrected in the field and has barrel distortion (photos README); both far beyond their noise.
	for (const char* const term : { "curvature", "distortion" })
		EXPECT_GT(std::abs(lens.at("aberrations").at(term).get<double>()), 5 * lens.at("aberrations").at(std::string(term) + "_sigma").get<double>()) << term;
}

// The thin lens that is told beside the real one is wrong about this glass by more than its numbers scatter: sigmas hold that, its tilts' too. By the prescription f is
// 45 mm, and d is 16.07 mm near the axis and that of a disc of 16.44 mm over the picture (tiltcal lens).
TEST(Photographs, TheThinLensHoldsTheGlassInItsSigmas)
{
	const Json c = Calibration();
	const auto off = [&](const char* name, double truth) { return std::abs(c.at(std::string(name) + "_mm").get<double>() - truth) / c.at(std::string(name) + "_sigma_mm").get<double>(); };
	EXPECT_LT(off("focal_length", 45), 3);
	EXPECT_LT(off("aperture_diameter", 45 / 2.8), 3);
	EXPECT_LT(off("aperture_diameter", 16.44), 3);
	for (const auto& [state, truth] : { std::pair{ "plus5", 5.0 }, std::pair{ "minus5", -5.0 } })
	{
		const Json thin = State(c, state).at("thin");
		EXPECT_NEAR(thin.at("lens_tilt_deg").get<double>(), truth, 3 * thin.at("lens_tilt_sigma_deg").get<double>()) << state;
	}
	// What scatters is said as well, and is less.
	EXPECT_LT(c.at("sigma_by_photographs").at("aperture_diameter_mm"), c.at("aperture_diameter_sigma_mm"));
}

// What scenes are seen through: sixteen numbers, and rims that the light tells with the edges. It must say more of photographs left out than six do, and its focal
// length is the prescription's, which six numbers and rims of a thin lens's geometry miss by 0.2 mm: within its own sigmas, three.
/// Within three of its own sigmas; a number of mm.
void NearTruth(const Json& of, const std::string& name, double truth)
{
	EXPECT_NEAR(of.at(name + "_mm").get<double>(), truth, 3 * of.at(name + "_sigma_mm").get<double>()) << name;
}

// photos-45mm's truth.json, and what its lengths make of a tilt of 5 degrees about the pivot.
TEST(Photographs, RealLensesHoldTheGlassInTheirSigmas)
{
	const double exit_pupil = 51.57353116, exit_pupil_before_pivot = exit_pupil - 49.2355578, pitch = 0.02, tilts[3] = { 0, 5, -5 };
	for (const char* name : { "real_lens", "scene_lens" })
	{
		SCOPED_TRACE(name);
		const Json lens = Calibration().at(name);
		NearTruth(lens, "focal_length", 45);
		NearTruth(lens, "aperture_diameter", 16.07142857);
		EXPECT_NEAR(lens.at("pupil_magnification").get<double>(), 17.19452116 / 16.07142857, 3 * lens.at("pupil_magnification_sigma").get<double>());
		// A sigma that says nothing would pass: f to a hundredth.
		EXPECT_LT(lens.at("focal_length_sigma_mm").get<double>(), 0.45);
		for (size_t s = 0; s < 3; ++s)
		{
			const Json& state = lens.at("states")[s];
			const double tilt = tilts[s] * M_PI / 180;
			EXPECT_NEAR(state.at("lens_tilt_deg").get<double>(), tilts[s], 3 * state.at("lens_tilt_sigma_deg").get<double>());
			NearTruth(state, "exit_pupil_to_sensor", exit_pupil - exit_pupil_before_pivot * (1 - std::cos(tilt)));
			for (const size_t axis : { 0, 1 })
				EXPECT_NEAR(state.at("principal_point_px")[axis].get<double>(), axis == 0 ? 899.5 : 599.5 - exit_pupil_before_pivot * std::sin(tilt) / pitch,
					3 * state.at("principal_point_sigma_px")[axis].get<double>());
		}
	}
}

TEST(Photographs, SixteenNumbersForScenes)
{
	const Json lens = Calibration().at("scene_lens");
	EXPECT_TRUE(lens.at("used").get<bool>());
	EXPECT_LT(lens.at("held_out"), 0.99 * lens.at("held_out_six").get<double>());
	// The clear diameters of the first and of the last surface, as they are seen from outside (tiltcal lens).
	ASSERT_EQ(lens.at("rims").size(), 2u);
	const double truth[2][2] = { { 11.25, 15.28 }, { 8.94, -14.75 } };
	for (size_t i = 0; i < 2; ++i)
	{
		NearTruth(lens.at("rims")[i], "radius", truth[i][0]);
		NearTruth(lens.at("rims")[i], "distance", truth[i][1]);
	}
	EXPECT_LT(lens.at("rms_place_px"), Calibration().at("real_lens").at("rms_place_px"));
	EXPECT_LT(lens.at("rms_blur_px"), Calibration().at("real_lens").at("rms_blur_px"));
}

TEST(Photographs, LensAndSensor)
{
	const Json json = Calibration();
	// truth.json: effective image distance 48.205; 0.3 mm because distortion and the pupil's own
	// aberration are described by few numbers only.
	EXPECT_NEAR(json.at("image_distance_mm").get<double>(), 48.2, 0.3);
	// Entrance pupil 16.07 on the axis, smaller off it (vignetting).
	EXPECT_NEAR(json.at("aperture_diameter_mm").get<double>(), 16, 0.5);
	// 618 at the axis to 645 for the best plane over the frame (field curvature).
	EXPECT_GT(json.at("focus_distance_mm").get<double>(), 612);
	EXPECT_LT(json.at("focus_distance_mm").get<double>(), 650);
	EXPECT_NEAR(json.at("focal_length_mm").get<double>(), 45, 0.5);
	// Untilted the axis meets the sensor at its centre; pixels at some 0.4 px sigma.
	EXPECT_NEAR(json.at("principal_point_px")[0].get<double>(), 899.5, 3);
	EXPECT_NEAR(json.at("principal_point_px")[1].get<double>(), 599.5, 3);
	EXPECT_EQ(json.at("model"), "lens");
	EXPECT_EQ(json.at("thin_model"), "curved");
}

TEST(Photographs, FieldCurvature)
{
	const Json json = Calibration();
	// photos-45mm's truth.json: w^2 (1/Z - 1/U) = -0.14 at 12 mm from the axis, so C = -0.14/12^2 = -0.001 for the least
	// spot; the mean of tangential and sagittal curvature lies between that and 0, which they do on both sides.
	const double C = json.at("field_curvature_per_mm");
	EXPECT_NEAR(C, -0.0006, 0.0004);
	// It is there: by four of its sigmas, with what the photographs say against each other.
	EXPECT_LT(json.at("field_curvature_sigma_per_mm").get<double>(), 0.25 * std::abs(C));
	EXPECT_NEAR((json.at("tangential_curvature_per_mm").get<double>() + json.at("sagittal_curvature_per_mm").get<double>()) / 2, C, 1e-9);
}

TEST(Photographs, CornersAreReprojected)
{
	// Issue 2 wants 0.4 px on every photograph.
	const Json json = Calibration();
	for (const Json& state : json.at("states"))
		for (const Json& photo : state.at("photos"))
			EXPECT_LT(photo.at("rms_reprojection_px").get<double>(), 0.4) << photo.at("file");
}

TEST(Photographs, PrincipalPointMovesByAFewPixelsOnly)
{
	const Json json = Calibration();
	ASSERT_EQ(json.at("shared_poses"), true);
	const double untilted = State(json, "untilted").at("principal_point_px")[1];
	// The lens turns about a pivot away from its pupil: the picture moves by about 5 px between the states, down for plus5.
	EXPECT_NEAR(State(json, "plus5").at("principal_point_px")[1].get<double>() - untilted, 5, 3);
	EXPECT_NEAR(State(json, "minus5").at("principal_point_px")[1].get<double>() - untilted, -5, 3);
}

TEST(Photographs, BlurIsExplained)
{
	const Json json = Calibration();
	// As corners are reprojected to, of widths up to 28 px; oblique spherical aberration and the vignetted pupil are no part of the model.
	EXPECT_LT(json.at("rms_blur_px").get<double>(), 0.4);
	EXPECT_GT(json.at("psf_floor_px").get<double>(), 0.2);
	EXPECT_LT(json.at("psf_floor_px").get<double>(), 2);
}

TEST(Photographs, RotationsAreRotationsAndBoardsAreUpright)
{
	const Json json = Calibration();
	for (const Json& state : json.at("states"))
		for (const Json& photo : state.at("photos"))
		{
			const Json& R = photo.at("rotation");
			const auto at = [&](int r, int c) { return R.at(size_t(r)).at(size_t(c)).get<double>(); };
			const double determinant = at(0, 0) * (at(1, 1) * at(2, 2) - at(1, 2) * at(2, 1)) - at(0, 1) * (at(1, 0) * at(2, 2) - at(1, 2) * at(2, 0))
				+ at(0, 2) * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
			EXPECT_NEAR(determinant, 1, 1e-9);
			// x right, y up, z away: all boards were photographed upright from the front.
			EXPECT_GT(at(0, 0), 0.5);
			EXPECT_GT(at(1, 1), 0.5);
			EXPECT_GT(at(2, 2), 0.5);
			// The board is in front of the camera, its first corner to the upper left.
			EXPECT_GT(photo.at("translation_mm")[2].get<double>(), 400);
			EXPECT_LT(photo.at("translation_mm")[0].get<double>(), 0);
			EXPECT_GT(photo.at("translation_mm")[1].get<double>(), 0);
		}
}

TEST(Photographs, EveryEstimateHasItsSigma)
{
	const Json json = Calibration();
	for (const char* const name : { "image_distance_sigma_mm", "focal_length_sigma_mm", "focus_distance_sigma_mm", "aperture_diameter_sigma_mm",
		"principal_point_sigma_px", "field_curvature_sigma_per_mm", "psf_floor_sigma_px" })
		EXPECT_TRUE(json.contains(name)) << name;
	for (const char* const name : { "lens_tilt_sigma_deg", "tilt_direction_sigma_deg", "focal_plane_tilt_sigma_deg", "focus_distance_sigma_mm",
		"principal_point_sigma_px", "inverse_focus_sigma_per_mm" })
		for (const Json& state : json.at("states"))
			EXPECT_TRUE(state.contains(name)) << name;
}

/// As people write it: two digits of sigma.
std::string WithSigma(double value, double sigma)
{
	const int digits = std::max(0, 1 - int(std::floor(std::log10(sigma))));
	char text[100];
	std::snprintf(text, sizeof text, "%s%.*f ± %.*f", value < 0 ? "−" : "", digits, std::abs(value), digits, sigma);
	return text;
}

TEST(Photographs, PageHasAllPhotographsAndNumbers)
{
	std::stringstream text;
	text << std::ifstream(FOLDER + "/report.html").rdbuf();
	const Page page = ReadPage(text.str());
	ASSERT_EQ(page.complaint, "");
	EXPECT_EQ(OutsideResource(page, text.str()), "");
	EXPECT_LT(text.str().size(), 15000000u);
	const Json json = Calibration();
	const auto has = [&](const Json& node, const std::string& name, const std::string& unit)
	{
		EXPECT_THAT(page.text, testing::HasSubstr(WithSigma(node.at(name + unit), node.at(name + "_sigma" + unit)))) << name;
	};
	for (const char* const name : { "image_distance", "focal_length", "focus_distance", "aperture_diameter" })
		has(json, name, "_mm");
	has(json, "psf_floor", "_px");
	EXPECT_THAT(page.text, testing::HasSubstr(WithSigma(1000 * json.at("field_curvature_per_mm").get<double>(), 1000 * json.at("field_curvature_sigma_per_mm").get<double>())));
	for (const Json& state : json.at("states"))
	{
		has(state, "focus_distance", "_mm");
		has(state, "focal_length", "_mm");
		for (const char* const name : { "lens_tilt", "tilt_direction", "focal_plane_tilt" })
			if (state.at("name") != "untilted")
				has(state, name, "_deg");
		for (const Json& photo : state.at("photos"))
			EXPECT_THAT(page.text, testing::HasSubstr(std::filesystem::path(photo.at("file").get<std::string>()).filename().string()));
	}
	for (const Json& remark : json.at("verdict").at("remarks"))
		EXPECT_THAT(page.text, testing::HasSubstr(remark.at("text").get<std::string>()));
	// The answer from model to model, and what each takes.
	for (const char* const model : { "paper", "plane", "curved", "lens (taken)", "lens, fifth order (for scenes)" })
		EXPECT_THAT(page.text, testing::HasSubstr(model));
	for (const char* const lens : { "real_lens", "scene_lens" })
		has(json.at(lens).at("states")[1], "lens_tilt", "_deg");
}

// Two rims stand for those of ten surfaces, one on each side. Radius and distance of a rim are bound to each other, and the two rims too, so that no numbers of theirs are
// the true ones. What is sure: each lets all light of the middle through and cuts some of the corners', or it would not be seen; and what they leave of the light.
TEST(Photographs, Vignetting)
{
	const Json json = Calibration(), v = json.at("vignetting");
	EXPECT_TRUE(v.at("natural").get<bool>());
	EXPECT_TRUE(v.at("optical").at("used").get<bool>());
	const Json& rims = v.at("optical").at("rims");
	ASSERT_EQ(rims.size(), 2u);
	EXPECT_EQ(rims[0].at("radius_mm"), v.at("optical").at("radius_mm"));
	EXPECT_GT(rims[0].at("distance_mm"), 0.0);
	EXPECT_LT(rims[1].at("distance_mm"), 0.0);
	const double w = json.at("image_distance_mm"), U = json.at("focus_distance_mm"), aperture = json.at("aperture_diameter_mm").get<double>() / 2;
	const double corner = std::hypot(18.0, 12.0) / w;     // tangent of the angle to the axis
	for (const Json& rim : rims)
	{
		const double distance = rim.at("distance_mm"), radius = rim.at("radius_mm");
		// The cone of light between the point in focus, or the sensor, and the opening, where the rim stands.
		const double cone = aperture * (1 - (distance > 0 ? distance / U : -distance / w));
		EXPECT_GT(radius, cone) << distance;
		EXPECT_LT(radius, cone + std::abs(distance) * corner) << distance;
	}
	EXPECT_TRUE(v.at("optical").at("second").at("used").get<bool>());
	EXPECT_LT(v.at("optical").at("second").at("held_out_sigmas_with"), v.at("optical").at("second").at("held_out_sigmas_without").get<double>());
	// JPEGs of 8 bits: half a level of the white's some 200 is 0.25 %, a patch of 100 pixels with 1 % of noise 0.1 %. Three times both.
	EXPECT_LT(v.at("rms_percent"), 0.8);
	EXPECT_LT(v.at("held_out_percent").at("both"), 0.5 * v.at("held_out_percent").at("optical").get<double>());
	EXPECT_EQ(v.at("gains").size(), 18u);
	std::map<std::string, bool> used;
	for (const Json& effect : json.at("effects"))
		used[effect.at("name")] = effect.at("used");
	const std::map<std::string, bool> expected{ { "distortion", true }, { "field_curvature", true }, { "vignetting_natural", true }, { "vignetting_optical", true },
		{ "chromatic_lateral", false }, { "chromatic_axial", false }, { "blades", false } };   // the photographs are grey
	EXPECT_EQ(used, expected);
}

// The note in calibration.json tells which camera the .inc holds; so does the .inc itself.
TEST(Photographs, TheNoteSaysWhatTheIncHolds)
{
	const Json json = Calibration();
	EXPECT_EQ(json.at("render").at("note"), "the camera without distortion that the .inc files take where TiltCal_Distortion is set to 0, or where this lens needs no distortion");
	std::ifstream in(FOLDER + "/camera-plus5.inc");
	std::stringstream text;
	text << in.rdbuf();
	const std::string inc = text.str();
	// With it unless the scene says otherwise ..
	EXPECT_THAT(inc, testing::HasSubstr("#ifndef (TiltCal_Distortion)\n\t#declare TiltCal_Distortion = 1;\n#end"));
	// .. and the numbers are the ones of the note: first those with it, behind #else those of `render`; the real lens's come last.
	const auto declared = [&](size_t from) { return std::atof(inc.c_str() + inc.find("_Image_Distance = ", from) + 18); };
	const size_t thin = inc.find("#if (TiltCal_Distortion)"), without = inc.find("#else", thin);
	ASSERT_NE(without, std::string::npos);
	EXPECT_THAT(inc.substr(0, thin), testing::HasSubstr("#ifndef (TiltCal_Real_Lens)\n\t#declare TiltCal_Real_Lens = 1;\n#end\n\n#if (TiltCal_Real_Lens = 0)"));
	// As many digits as the file has.
	EXPECT_NEAR(declared(thin), json.at("image_distance_mm").get<double>(), 1e-7);
	EXPECT_NEAR(declared(without), json.at("render").at("image_distance_mm").get<double>(), 1e-7);
	EXPECT_GT(std::abs(declared(thin) - declared(without)), 1e-3);
}

TEST(Photographs, FilesAreThere)
{
	for (const char* const name : { "camera-untilted.inc", "camera-plus5.inc", "camera-minus5.inc", "report.txt", "report.html", "overlay-untilted-1.png", "overlay-minus5-6.png" })
		EXPECT_GT(std::filesystem::file_size(FOLDER + "/" + name), 500u) << name;
	std::stringstream text;
	text << std::ifstream(FOLDER + "/camera-plus5.inc").rdbuf();
	for (const char* const part : { "#macro TiltCal_plus5(Location, Look_At, Sky)", "tilt_lens {", "field_curvature TiltCal_plus5_Field_Curvature", "focal_plane_tilt", "image_distance", "aperture_diameter",
		"#declare TiltCal_plus5_Photo_6_Sky", "right 36*x", "up 24*y", "\t\tvignetting natural\n", "\t\tvignetting optical TiltCal_plus5_Rim_Radius, TiltCal_plus5_Rim_Distance, TiltCal_plus5_Rim2_Radius, TiltCal_plus5_Rim2_Distance\n" })
		EXPECT_NE(text.str().find(part), std::string::npos) << part;
	for (const char* const part : { "\tchromatic", "\tblades" })
		EXPECT_EQ(text.str().find(part), std::string::npos) << part;
}

/// No other state may be called what a .inc declares (model/state_names.cpp has the list).
TEST(Photographs, IdentifiersOfTheIncAreTaken)
{
	std::ostringstream text;
	text << std::ifstream(FOLDER + "/camera-plus5.inc").rdbuf();
	const std::string inc = text.str();
	const std::regex declared("#(?:declare|macro) TiltCal_([A-Za-z0-9_]+)");
	size_t seen = 0;
	for (auto at = std::sregex_iterator(inc.begin(), inc.end(), declared); at != std::sregex_iterator(); ++at, ++seen)
	{
		const std::string name = (*at)[1];
		if (name == "plus5")
			continue;
		EXPECT_THROW(tiltcal::CheckStateNames({ "plus5", name }), tiltcal::Error) << name;
	}
	EXPECT_GT(seen, 30u);
}

}
