// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which photograph to take next: taken, by exact pictures, it lowers the sigmas as foretold, and more than others do.

#include "calibrate/next_photographs.h"

#include "base/stopwatch.h"
#include "measure/detect.h"
#include "measure/measure.h"
#include "support/synthetic_lens.h"
#include "support/thin_lens_picture.h"
#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;

const double PITCH = 0.06, W = 800 * PITCH, F = 45;   // mm

/// The lens of these pictures: 640 x 480, focused at 720 mm.
synthetic::Scene LensOf(double tilt)
{
	synthetic::Scene scene;
	scene.aperture = 14;
	scene.lens_normal = synthetic::LensNormal(tilt, 0);
	synthetic::FocusOn(scene, W, F);
	scene.noise = 0.004;
	scene.lens_points = 120;
	return scene;
}

const Board BOARD = MakeBoard(TargetKind::CHECKERBOARD, "9x7", 25, 0);

Photo Taken(synthetic::Scene scene, unsigned seed)
{
	scene.seed = seed;
	const cv::Mat picture = TakePicture(scene, synthetic::Checkerboard(BOARD.columns, BOARD.rows, BOARD.square_mm));
	Photo photo;
	photo.file = "photo-" + std::to_string(seed);
	photo.width = scene.width;
	photo.height = scene.height;
	photo.corners = DetectCorners(picture, BOARD, {}, photo.file);
	MeasureEdges(picture, BOARD, photo);
	return photo;
}

/// The oracle's y is down: F R F and F t, F = diag(1, -1, 1); its board's y too, so that R stands for rows that run down.
void Place(synthetic::Scene& scene, const Pose& pose)
{
	const Eigen::Vector3d axis(pose[0], pose[1], pose[2]);
	const Eigen::Matrix3d R = axis.norm() > 0 ? Eigen::AngleAxisd(axis.norm(), axis.normalized()).toRotationMatrix() : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
	const Eigen::Matrix3d flip = Eigen::Vector3d(1, -1, 1).asDiagonal();
	scene.camera_from_board = flip * R * flip;
	scene.origin = { pose[3], -pose[4], pose[5] };
}

struct Stand { double incline, direction, distance; };

State StateOf(const std::string& name, double tilt, const std::vector<Stand>& stands, unsigned seed)
{
	State state{ name, tilt != 0, {} };
	for (const Stand& s : stands)
	{
		synthetic::Scene scene = LensOf(tilt);
		Aim(scene, 87.5, 62.5, s.distance, s.incline, s.direction, 0);
		state.photos.push_back(Taken(scene, seed++));
	}
	return state;
}

Task TaskOf(std::vector<State> states)
{
	Task task;
	task.board = BOARD;
	task.pitch_mm = PITCH;
	task.width = 640;
	task.height = 480;
	task.states = std::move(states);
	return task;
}

Calibration Solved(const Task& task)
{
	CalibrateOptions options;
	options.model = Model::PLANE;
	options.poses = Poses::OWN;
	options.effects.kind = EffectChoice::LIST;   // none
	return Calibrate(task, options);
}

double SigmaOf(const std::vector<ExpectedSigma>& all, const std::string& name, double ExpectedSigma::* which)
{
	for (const ExpectedSigma& s : all)
		if (s.name == name)
			return s.*which;
	ADD_FAILURE() << "no " << name;
	return 0;
}

/// By edges: what the calibration's own covariance says.
double ByEdges(const Calibration& c, const std::string& name)
{
	const NamedCovariance& v = c.solution.covariance;
	for (size_t k = 0; k < v.names.size(); ++k)
		if (v.names[k] == name)
			return std::sqrt(v.matrix[k * (v.names.size() + 1)]);
	ADD_FAILURE() << "no " << name;
	return 0;
}

Calibration With(const Calibration& c, const Task& measured, const NextPhotograph& next, unsigned seed)
{
	Task more = measured;
	for (const size_t s : next.states)
	{
		synthetic::Scene scene = LensOf(s == 0 ? 0 : 4);
		Place(scene, next.pose);
		more.states[s].photos.push_back(Taken(scene, seed));
	}
	(void)c;
	return Solved(more);
}

TEST(NextPhotographs, TheOneSuggestedLowersSigmaAsForetold)
{
	// Nearly frontal, the tilt hardly told.
	const Task task = TaskOf({ StateOf("untilted", 0, { { 14, 0, 620 }, { 12, 95, 600 }, { 16, 200, 640 } }, 1), StateOf("plus4", 4, { { 12, 0, 600 }, { 14, 95, 620 }, { 12, 200, 600 } }, 11) });
	const Calibration c = Solved(task);
	const Stopwatch time;
	const NextPhotographs again = FindNextPhotographs(c);
	std::printf("%.2f s\n", time.Seconds());
	ASSERT_TRUE(c.next.known);
	for (const std::string& m : c.next.missing)
		std::printf("missing: %s\n", m.c_str());
	for (const NextPhotograph& n : c.next.photographs)
	{
		std::printf("next: %s\n", n.text.c_str());
		for (const ExpectedSigma& s : n.sigmas)
			std::printf("   %s %.4g -> %.4g, wanted %.4g\n", s.name.c_str(), s.now, s.then, s.wanted);
	}
	ASSERT_FALSE(c.next.photographs.empty());
	const NextPhotograph& best = c.next.photographs[0];
	const Calibration d = With(c, task, best, 77);
	for (const char* const name : { "image_distance_mm", "aperture_diameter_mm", "untilted.q_z_per_mm", "plus4.q_x_per_mm", "plus4.q_y_per_mm" })
		std::printf("%s by edges %.4g -> %.4g: %.3f\n", name, ByEdges(c, name), ByEdges(d, name), ByEdges(d, name) / ByEdges(c, name));
	std::printf("sigma w %.4g -> %.4g tilt %.4g -> %.4g\n", c.solution.w_mm.sigma, d.solution.w_mm.sigma, c.solution.states[1].lens_tilt.sigma, d.solution.states[1].lens_tilt.sigma);
}

}
