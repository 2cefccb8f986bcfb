// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Lenses focused at infinity, and beyond it as lenses at their stop may be: found as well as any other, and said in words that hold.

#include <tiltcal/calibrate.h>
#include <tiltcal/camera.h>
#include "base/files.h"
#include "camera/write_inc.h"
#include "lens/angles.h"
#include "lens/optics.h"
#include "model/focus_words.h"
#include "model/tilt_angles.h"
#include "report/report_html.h"
#include "report/write_json.h"
#include "report/write_report.h"
#include "support/page_check.h"
#include "support/synthetic_lens.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <ostream>
#include <string>

namespace
{

using namespace tiltcal;
using namespace synthetic;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::Not;

const double RAD = tilt_lens::RadiansPerDegree;

/// f/12 or so: at 620 mm, where the nearer boards are, a blur of 15 px. `q`: 1/U untilted, 1/mm.
Lens Focused(double q, double tilt = 0, double direction = 0)
{
	Lens lens = Tilted(tilt, direction);
	lens.d = 4;
	lens.f = 1 / (1 / lens.w + q);
	return lens;
}

struct Setting
{
	const char* name;
	double q;

	friend void PrintTo(const Setting& s, std::ostream* out) { *out << s.name << " infinity"; }
};

/// 1/U is found to better than SIGMA, 1/mm: a focus at infinity, 10 m beyond, and 20 m before it.
const double SIGMA = 1e-5;
const Setting SETTINGS[] = { { "at", 0 }, { "beyond", -1e-4 }, { "before", 5e-5 } };

/// Two boards at 620 mm, and two at twice that: without a sharp part, it is the distance that tells slope, offset and floor of the blur apart.
State NearAndFar(const std::string& name, const Lens& lens, unsigned seed)
{
	State state = Photograph(name, lens, { 0.03, 0.06, seed }, 4);
	const State far = Photograph(name, lens, { 0.03, 0.06, seed + 50 }, 4, 600);
	for (size_t p = 0; p < state.photos.size(); ++p)
	{
		if (p % 2)
			state.photos[p] = far.photos[p];
		state.photos[p].file = fmt::format("{}-{}.png", name, p + 1);
		for (Edge& e : state.photos[p].edges)
			e.square_px = 90;
	}
	return state;
}

const double TILT = 5, DIRECTION = 30;

Calibration Calibrated(double q)
{
	return Calibrate(MakeTask({ NearAndFar("untilted", Focused(q), 1), NearAndFar("tilted", Focused(q, TILT, DIRECTION), 2) }), { Model::PLANE, Poses::OWN });
}

/// Squares of deviations in their sigmas.
struct Deviations
{
	double squares = 0;
	int count = 0;

	void Add(double error, double sigma, const std::string& what)
	{
		EXPECT_LT(std::abs(error), 4 * sigma) << what << " is off by " << error;
		squares += error * error / (sigma * sigma);
		++count;
	}
};

void ExpectWithinItsSigmas(const Calibration& c, double q)
{
	const Lens truth = Focused(q), tilted = Focused(q, TILT, DIRECTION);
	const StateLens &untilted = c.solution.states[0], &found = c.solution.states[1];
	Deviations all;
	all.Add(c.solution.w_mm.value - truth.w, c.solution.w_mm.sigma, "w");
	all.Add(c.solution.aperture_diameter.value - truth.d, c.solution.aperture_diameter.sigma, "d");
	all.Add(c.solution.focal_length.value - truth.f, c.solution.focal_length.sigma, "f");
	all.Add(untilted.q.z - q, untilted.q_sigma.z, "1/U");
	const Vec3<double> truth_q = tilt_lens::PlaneFromLens(tilt_lens::LensNormalFromTilt(TILT * RAD, DIRECTION * RAD), 1 / tilted.f, 1 / tilted.w);
	all.Add(found.q.x - truth_q.x, found.q_sigma.x, "q_x");
	all.Add(found.q.y - truth_q.y, found.q_sigma.y, "q_y");
	all.Add(found.q.z - truth_q.z, found.q_sigma.z, "q_z");
	// 7 numbers, correlated: as if there were 4 of them, 4 sigma of chi-square over its number are 4 sqrt(2/4).
	EXPECT_LT(all.squares / all.count, 1 + 4 * std::sqrt(2 / 4.));
	EXPECT_LT(untilted.q_sigma.z, SIGMA);
	// As the verdict asks of every lens.
	EXPECT_LT(found.lens_tilt.sigma, 0.03);
	EXPECT_FALSE(found.chosen_by_power);
	// No blur is below 7 px: nothing is said of the camera's sharpening, which only sharp edges tell.
	EXPECT_TRUE(std::isnan(c.light.sharpening.value));
	EXPECT_EQ(c.verdict.grade, Grade::GOOD) << [&]
	{
		std::string text;
		for (const Remark& r : c.verdict.remarks)
			text += r.text + "\n";
		return text;
	}();
	EXPECT_THAT(c.verdict.remarks, Not(Contains(Field(&Remark::text, HasSubstr("untilted: 100 % of the edges")))));
}

/// The number that the .inc declares.
double Declared(const std::string& inc, const std::string& name)
{
	const size_t at = inc.find("#declare " + name + " = ");
	EXPECT_NE(at, std::string::npos) << name;
	return std::stod(inc.substr(at + name.size() + 12));
}

void ExpectNoNonsense(const std::string& text)
{
	for (const char* const word : { "nan", " inf ", "inf,", "-inf ", "inf;", "-inf" })
		EXPECT_EQ(text.find(word), std::string::npos) << word;
}

/// What tilt_lens makes of the block's words. It has no focal_plane_tilt of 90 degrees; ten digits are written.
void ExpectSamePlane(const Calibration& c, size_t s, bool of_lens, const std::string& json_file)
{
	const Vec3<double>& q = c.solution.states[s].q;
	const std::string inc = CameraInc(c, s), p = "TiltCal_" + c.task.states[s].name + "_";
	ExpectNoNonsense(inc);
	EXPECT_EQ(inc.find("\t\tlens_tilt ") != std::string::npos, of_lens);
	EXPECT_EQ(inc.find("\t\tfocal_plane_tilt ") == std::string::npos, of_lens);
	const double direction = Declared(inc, p + "Tilt_Direction") * RAD, w = Declared(inc, p + "Image_Distance"), inverse = 1 / Declared(inc, p + "Focus_Distance");
	const Vec3<double> written = of_lens ? tilt_lens::PlaneFromLensTilt(tilt_lens::LensNormalFromTilt(Declared(inc, p + "Lens_Tilt") * RAD, direction), 1 / w, inverse)
		: tilt_lens::PlaneAtDistance(tilt_lens::FocalPlaneDirection(Declared(inc, p + "Focal_Plane_Tilt") * RAD, direction), inverse);
	EXPECT_LT(Length(written - q), 1e-9 / w);
	EXPECT_LT(Length(ReadStateCamera(json_file, c.task.states[s].name).PlaneOfFocus() - q), 1e-9 / w);
}

void ExpectWrittenAsItIs(const Calibration& c, double q)
{
	const bool at = q == 0, beyond = q < 0;
	const std::string json = CalibrationJson(c), text = SummaryTable(c);
	const auto parsed = nlohmann::json::parse(json);
	EXPECT_EQ(parsed.at("focus_distance_mm").is_null(), at);
	EXPECT_EQ(parsed.at("focus_distance_sigma_mm").is_null(), at);
	EXPECT_EQ(parsed.at("states")[0].at("focus_distance_mm").is_null(), at);
	if (!at)
	{
		EXPECT_EQ(parsed.at("focus_distance_mm").get<double>() < 0, beyond);
	}
	const char* const words = at ? "at infinity: beyond " : beyond ? "beyond infinity: 1/U -0.1" : " mm";
	ReportPictures pictures(c.task);
	for (size_t k = 0; k < 8; ++k)
		pictures.Add(cv::Mat(c.task.height, c.task.width, CV_8UC3, cv::Scalar(1, 2, 3)));
	const Page page = ReadPage(ReportHtml(c, { "edges", "", "" }, pictures));
	EXPECT_EQ(page.complaint, "");
	for (const std::string& out : { text, page.text, CameraInc(c, 0) })
	{
		EXPECT_NE(out.find(words), std::string::npos) << words;
		ExpectNoNonsense(out);
	}
	const std::string file = testing::TempDir() + "far-focus-calibration" + (at ? "-at" : beyond ? "-beyond" : "-before") + ".json";
	WriteText(file, json);
	ExpectSamePlane(c, 0, at || beyond, file);
	ExpectSamePlane(c, 1, true, file);
}

class FarFocus : public testing::TestWithParam<Setting> {};

TEST_P(FarFocus, IsFoundAndWritten)
{
	const Calibration c = Calibrated(GetParam().q);
	ExpectWithinItsSigmas(c, GetParam().q);
	ExpectWrittenAsItIs(c, GetParam().q);
}

INSTANTIATE_TEST_SUITE_P(Infinity, FarFocus, testing::ValuesIn(SETTINGS), [](const auto& tested) { return tested.param.name; });

TEST(FocusWords, FollowTheSigmaOfTheReciprocal)
{
	EXPECT_EQ(FocusWords({ 1 / 620., 1e-6 }), std::nullopt);
	EXPECT_EQ(FocusWords({ 1 / 620., 0 }), std::nullopt);
	EXPECT_EQ(FocusWords({ 0, 0 }), "at infinity");
	EXPECT_EQ(FocusWords({ 5e-6, 1e-5 }), "at infinity: beyond 40.0 m (2 sigma)");
	EXPECT_EQ(FocusWords({ -5e-6, 1e-5 }), "at infinity: beyond 66.7 m (2 sigma)");
	EXPECT_EQ(FocusWords({ -5e-5, 1e-5 }), "beyond infinity: 1/U -0.05 +- 0.01 per metre");
	EXPECT_EQ(FocusWords({ 4e-5, 1e-5 }), "25.0 m (16.7 m to 50.0 m, 2 sigma)");
	EXPECT_EQ(FocusInShort({ 4e-5, 1e-5 }), std::nullopt);
	EXPECT_EQ(FocusInShort({ 0, 1e-5 }), "at infinity");
}

TEST(TiltAngles, SigmasOfAPlaneParallelToTheAxis)
{
	const double s = 1e-6, across = 0.0018;
	Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
	covariance(2, 2) = s * s;
	for (const double z : { 0.0, 1e-9, -1e-9, 1e-7 })
	{
		StateLens lens;
		FillStateLens({ 0, -across, z }, 48, covariance, lens);
		// atan(across / z) turns by dz / across, on both sides of 90 degrees alike; steps are exact to 1e-6 of it.
		EXPECT_NEAR(lens.focal_plane_tilt.sigma, s / across / RAD, 1e-5 * lens.focal_plane_tilt.sigma) << z;
		EXPECT_NEAR(std::abs(lens.focal_plane_tilt.value), 90, 0.01);
		EXPECT_TRUE(std::isfinite(lens.lens_tilt.sigma) && std::isfinite(lens.focal_length.sigma) && !std::isnan(lens.focus_distance.sigma));
	}
	StateLens none;
	FillStateLens({ 0, 0, 0 }, 48, covariance, none);
	EXPECT_EQ(none.focal_plane_tilt.value, 0);
	// f = 1 / (q_z + 1/w).
	EXPECT_NEAR(none.focal_length.sigma, 48 * 48 * s, 1e-4 * none.focal_length.sigma);
}

}
