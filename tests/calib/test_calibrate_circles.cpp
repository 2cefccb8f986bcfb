// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From pictures of grids of circles to the tilt of the lens.

#include <tiltcal/calibrate.h>
#include "base/files.h"
#include <tiltcal/error.h>
#include "measure/measure_circles.h"
#include "report/overlay.h"
#include "report/report_html.h"
#include "solve/held_out_corners.h"
#include "support/thin_lens_picture.h"
#include "report/write_json.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

using namespace tiltcal;
using namespace synthetic;

const double PITCH = 0.06, W = 800 * PITCH, F = 45, D = 18;   // mm
const double TILT = 5, DIRECTION = 35;                        // degrees
const int LENS_POINTS = 80;

State Photograph(const std::string& name, double tilt, const Board& board, size_t photos)
{
	State state;
	state.name = name;
	state.tilted = tilt != 0;
	const Eigen::Vector2d middle = 0.5 * board.square_mm * Eigen::Vector2d(board.CircleColumn(board.columns - 1, board.rows - 1), board.rows - 1);
	// Incline and its direction; before and behind the plane of focus at 720 mm.
	const struct { double incline, direction, distance; } poses[] = { { 30, 0, 640 }, { 35, 95, 690 }, { 30, 200, 740 }, { 35, 290, 700 } };
	for (size_t k = 0; k < photos; ++k)
	{
		const auto& pose = poses[k];
		Scene scene;
		scene.aperture = D;
		scene.lens_normal = LensNormal(tilt, DIRECTION);
		FocusOn(scene, W, F);
		Aim(scene, middle.x(), middle.y(), pose.distance, pose.incline, pose.direction, 4);
		scene.noise = 0.006;
		scene.seed = unsigned(state.photos.size()) + 1 + (tilt != 0 ? 10 : 0);
		scene.lens_points = LENS_POINTS;
		const cv::Mat picture = TakePicture(scene, Circles(board.columns, board.rows, board.square_mm, board.circle_diameter_mm, board.kind == TargetKind::ASYMMETRIC_CIRCLES));
		Photo photo;
		photo.file = name;
		photo.width = scene.width;
		photo.height = scene.height;
		MeasureCircles(picture, board, {}, photo);
		std::printf("%s: %s, %d left out, %s\n", name.c_str(), CountText(photo).c_str(), photo.edges_dropped, RatioText(photo).c_str());
		state.photos.push_back(photo);
	}
	return state;
}

void TiltIsFound(const Board& board, size_t photos)
{
	Task task;
	task.board = board;
	task.pitch_mm = PITCH;
	task.width = 640;
	task.height = 480;
	task.states = { Photograph("untilted", 0, board, photos), Photograph("plus5", TILT, board, photos) };
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::AUTO });
	// Every second circle tells the geometry, too; a real lens is of edges that are straight.
	EXPECT_GT(CornersLeftOut(c.task, { 0, {}, c.geometry.shared_poses }), 0);
	EXPECT_THROW(Calibrate(task, { Model::LENS, Poses::AUTO }), Error);
	const StateLens& lens = c.solution.states[1];
	const double phi = lens.tilt_direction.value * M_PI / 180, tilt = lens.lens_tilt.value, true_phi = DIRECTION * M_PI / 180;
	// As a vector: direction and size in one.
	const double error = std::hypot(tilt * std::sin(phi) - TILT * std::sin(true_phi), tilt * std::cos(phi) - TILT * std::cos(true_phi));
	std::printf("tilt %.3f +- %.3f towards %.2f +- %.2f, error %.4f; w %.3f +- %.3f, d %.3f +- %.3f, reprojection %.3f px, blur %.3f px, paper %s %.3f\n", tilt, lens.lens_tilt.sigma,
		lens.tilt_direction.value, lens.tilt_direction.sigma, error, c.solution.w_mm.value, c.solution.w_mm.sigma, c.solution.aperture_diameter.value,
		c.solution.aperture_diameter.sigma, c.geometry.rms, c.solution.rms_blur, c.paper.failure.c_str(), c.paper.failure.empty() ? c.paper.states[1].lens_tilt.value : 0);
	EXPECT_LT(error, 0.05);   // the task's bound
	// Both components within 4 sigma; and the sigma is not so large that this says nothing.
	EXPECT_LT(std::abs(tilt - TILT), 4 * lens.lens_tilt.sigma);
	EXPECT_LT(std::abs(lens.tilt_direction.value - DIRECTION), 4 * lens.tilt_direction.sigma);
	EXPECT_LT(lens.lens_tilt.sigma, 0.03);
	EXPECT_LT(std::abs(c.solution.w_mm.value - W), 4 * c.solution.w_mm.sigma);
	// The spiral's outermost of N points stands at sqrt(1 - 1 / (2 N)) of the radius: edges that are painted with them end that much earlier, 1 / (4 N).
	EXPECT_LT(std::abs(c.solution.aperture_diameter.value - D), D / (4 * LENS_POINTS) + 4 * c.solution.aperture_diameter.sigma);
	// Two coordinates of 0.05 px at the most.
	EXPECT_LT(c.geometry.rms, 0.07);
	EXPECT_EQ(c.paper.failure, "");
	WriteText(testing::TempDir() + NameOf(board.kind) + "-calibration.json", CalibrationJson(c));   // for calib.json_schema.effects
	const nlohmann::json json = nlohmann::json::parse(CalibrationJson(c));
	EXPECT_EQ(json["board"]["kind"], NameOf(board.kind));
	EXPECT_EQ(json["board"]["circles"][0], board.columns);
	EXPECT_EQ(json["board"]["circle_diameter_mm"], board.circle_diameter_mm);
	const cv::Mat overlay = DrawOverlay(cv::Mat(480, 640, CV_32FC1, cv::Scalar(0.5)), c, 1, 0);
	EXPECT_EQ(overlay.cols, 640);
	// The page calls circles circles.
	const std::string page = ReportHtml(c, { "edges", "", "" }, ReportPictures(c.task));
	EXPECT_NE(page.find(fmt::format("{} × {} circles of {:g} mm", board.columns, board.rows, board.circle_diameter_mm)), std::string::npos);
	EXPECT_EQ(page.find("squares of"), std::string::npos);
}

TEST(CalibrateCircles, TiltFromASymmetricGrid) { TiltIsFound(MakeBoard(TargetKind::CIRCLES, "9x7", 27, 16, ""), 4); }
TEST(CalibrateCircles, TiltFromAnAsymmetricGrid) { TiltIsFound(MakeBoard(TargetKind::ASYMMETRIC_CIRCLES, "6x9", 22, 16, ""), 3); }

}
