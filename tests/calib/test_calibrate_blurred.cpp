// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From pictures so blurred that edges run into each other to the tilt of the lens.

#include <tiltcal/calibrate.h>
#include "measure/detect.h"
#include "measure/measure.h"
#include "support/thin_lens_picture.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace
{

using namespace tiltcal;
using namespace synthetic;

const double PITCH = 0.06, W = 800 * PITCH, F = 45, D = 32;   // mm
const int LENS_POINTS = 200;

State Photograph(const std::string& name, double tilt, const Board& board)
{
	State state;
	state.name = name;
	state.tilted = tilt != 0;
	// Incline and its direction; before and behind the plane of focus at 720 mm.
	const struct { double incline, direction, distance; } poses[] = { { 30, 0, 560 }, { 32, 95, 570 }, { 28, 200, 560 }, { 34, 290, 640 } };
	for (const auto& pose : poses)
	{
		Scene scene;
		scene.aperture = D;
		// y is down here: the front swings towards picture-down for a positive tilt at direction 0, up.
		scene.lens_normal = LensNormal(tilt, 0);
		FocusOn(scene, W, F);
		Aim(scene, 125, 87.5, pose.distance, pose.incline, pose.direction, 0);
		scene.noise = 0.006;
		scene.seed = unsigned(state.photos.size()) + 1;
		scene.lens_points = LENS_POINTS;
		const cv::Mat picture = TakePicture(scene, Checkerboard(12, 9, board.square_mm));
		Photo photo;
		photo.file = name;
		photo.width = scene.width;
		photo.height = scene.height;
		photo.corners = DetectCorners(picture, board, {}, photo.file);
		MeasureEdges(picture, board, photo);
		std::printf("%s: %zu edges, %d left out, %s\n", name.c_str(), photo.edges.size(), photo.edges_dropped, RatioText(photo).c_str());
		state.photos.push_back(photo);
	}
	return state;
}

TEST(CalibrateBlurred, TiltOfALensFromStronglyBlurredPictures)
{
	Task task;
	task.board = ParseBoard("12x9", 25);
	task.pitch_mm = PITCH;
	task.width = 640;
	task.height = 480;
	task.states = { Photograph("untilted", 0, task.board), Photograph("plus5", 5, task.board) };
	double most = 0;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			most = std::max(most, RatiosOf(photo).most);
	EXPECT_GT(most, 0.3) << "the pictures are not blurred enough to test anything";
	const Calibration c = Calibrate(task, { Model::PLANE, Poses::AUTO });
	const StateLens& lens = c.solution.states[1];
	const double phi = lens.tilt_direction.value * M_PI / 180, tilt = lens.lens_tilt.value;
	std::printf("tilt %.3f +- %.3f towards %.2f, w %.3f +- %.3f, d %.3f +- %.3f\n", tilt, lens.lens_tilt.sigma, lens.tilt_direction.value, c.solution.w_mm.value, c.solution.w_mm.sigma,
		c.solution.aperture_diameter.value, c.solution.aperture_diameter.sigma);
	EXPECT_LT(std::hypot(tilt * std::sin(phi), tilt * std::cos(phi) - 5), 0.1);   // eight pictures of 0.3 megapixels
	// Discs that reach into the next edge's take up to 0.3 % off the tilt, which its sigma need not hold: that is said.
	EXPECT_NEAR(tilt, 5, 0.005 * 5);
	EXPECT_GT(c.verdict.grade, Grade::GOOD);
	EXPECT_TRUE(std::any_of(c.verdict.remarks.begin(), c.verdict.remarks.end(), [](const Remark& r) { return r.text.find("of a square. Beyond a quarter") != std::string::npos; }));
	// Of the others four sigma, and of
	// d what the spiral's outermost of N lens points stands within the rim.
	EXPECT_LT(std::abs(c.solution.aperture_diameter.value - D), D / (4 * LENS_POINTS) + 4 * c.solution.aperture_diameter.sigma);
	EXPECT_LT(std::abs(c.solution.w_mm.value - W), 4 * c.solution.w_mm.sigma);
	// And these say something.
	EXPECT_LT(c.solution.aperture_diameter.sigma, D / 100);
	EXPECT_LT(c.solution.w_mm.sigma, W / 100);
}

}
