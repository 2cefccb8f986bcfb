// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which photograph to take next: taken, by exact pictures, it lowers the sigmas as foretold, and more than others do.

#include "calibrate/next_photographs.h"

#include "calibrate/candidates.h"
#include "calibrate/coverage.h"
#include "measure/detect.h"
#include "measure/measure.h"
#include "report/report_html.h"
#include "report/report_next.h"
#include "support/page_check.h"
#include "support/sigma_in.h"
#include "support/thin_lens_picture.h"
#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

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
	scene.noise = 0.02;
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

Calibration Solved(const Task& task, bool next)
{
	CalibrateOptions options;
	options.model = Model::PLANE;
	options.poses = Poses::OWN;
	options.effects.kind = EffectChoice::LIST;   // none
	options.next_photographs = next;
	return Calibrate(task, options);
}

/// The calibration's own sigmas by edges, in the units of ExpectedSigma; along the tilt, which is up.
double ByEdges(const Calibration& c, const std::string& name)
{
	const std::map<std::string, std::string> names{ { "image_distance", "image_distance_mm" }, { "aperture_diameter", "aperture_diameter_mm" }, { "inverse_focus_distance", "untilted.q_z_per_mm" },
		{ "plus4.lens_tilt", "plus4.q_y_per_mm" } };
	return SigmaIn(c.solution.covariance, names.at(name));
}

const char* const NAMES[] = { "image_distance", "aperture_diameter", "inverse_focus_distance", "plus4.lens_tilt" };

/// What `next` makes of the sigma of each of NAMES: as foretold, and as found from its pictures.
struct Ratio { double foretold, found; };

std::vector<Ratio> Take(const Task& task, const Calibration& c, const NextPhotograph& next, unsigned seed)
{
	Task more = task;
	for (const size_t s : next.states)
	{
		synthetic::Scene scene = LensOf(s == 0 ? 0 : 4);
		Place(scene, next.pose);
		more.states[s].photos.push_back(Taken(scene, seed));
	}
	const Calibration d = Solved(more, false);
	const std::vector<ExpectedSigma> expected = ExpectSigmas(c, { next });
	std::vector<Ratio> out;
	for (const char* const name : NAMES)
		for (const ExpectedSigma& e : expected)
			if (e.name == name)
			{
				out.push_back({ e.then / e.now, ByEdges(d, name) / ByEdges(c, name) });
				std::printf("  %-24s foretold %.3f, found %.3f\n", name, out.back().foretold, out.back().found);
			}
	EXPECT_EQ(out.size(), std::size(NAMES));
	return out;
}

/// Photographs that hardly tell the tilt: boards nearly parallel to the sensor.
Task PoorTask()
{
	return TaskOf({ StateOf("untilted", 0, { { 14, 0, 620 }, { 12, 95, 600 }, { 16, 200, 640 } }, 1), StateOf("plus4", 4, { { 8, 0, 600 }, { 9, 95, 620 } }, 11) });
}

TEST(NextPhotographs, TheOneSuggestedLowersSigmaAsForetoldAndMoreThanOthers)
{
	const Task task = PoorTask();
	const Calibration c = Solved(task, true);
	ASSERT_TRUE(c.next.known);
	ASSERT_FALSE(c.next.missing.empty());
	ASSERT_FALSE(c.next.photographs.empty());
	const NextPhotograph& best = c.next.photographs[0];
	std::printf("%s\n", best.text.c_str());
	EXPECT_THAT(best.text, HasSubstr("in the state plus4: turn the board by"));
	const std::vector<Ratio> suggested = Take(task, c, best, 77);
	// Sigmas are rescaled by the residuals of some 500 edges, known to 3 %, before and after; the noise of an edge as blurred is a median over
	// a group of a twelfth of them, 10 %; and of the two photographs of the state one more is a third of all, so that half of that is seen.
	for (const Ratio& r : suggested)
		EXPECT_NEAR(r.found / r.foretold, 1, 0.15);
	EXPECT_LT(suggested.back().found, 0.7) << "the tilt is hardly told better";
	// Contrary: parallel to the sensor in the middle, in the other state; and where the first photograph was.
	const Candidate flat = Expect(c, 0, PoseOfBoard(c, 0, { 319.5, 239.5 }, 600, 0, 0));
	ASSERT_FALSE(flat.photo.edges.empty());
	for (const NextPhotograph& other : { PhotographOfPose(c, { 0 }, flat.look.pose), PhotographOfPose(c, { 1 }, PoseOfBoard(c, 1, { 319.5, 239.5 }, 600, 8, 0)) })
	{
		std::printf("another:\n");
		EXPECT_GT(Take(task, c, other, 78).back().found, suggested.back().found);
	}
}

TEST(NextPhotographs, FrontalBoardsAreToldToBe)
{
	Task task = TaskOf({ StateOf("untilted", 0, { { 0, 0, 600 }, { 0, 0, 700 }, { 1, 0, 650 } }, 1) });
	const std::vector<std::string> lines = WhatPhotographsLack(task);
	EXPECT_THAT(lines, testing::Contains(HasSubstr("no board is inclined")));
	EXPECT_THAT(lines, testing::Contains(HasSubstr("next: turn the board by 30 to 40 degrees about its upright axis")));
	// The refusal says it, with the code of refusals.
	try
	{
		Solved(task, true);
		FAIL() << "answered";
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_REFUSED);
		EXPECT_THAT(e.what(), HasSubstr("no board is inclined"));
	}
}

TEST(NextPhotographs, InclinedBoardsLackNothing)
{
	const Task task = TaskOf({ StateOf("untilted", 0, { { 35, 0, 620 }, { 35, 95, 600 }, { 38, 200, 640 } }, 1) });
	EXPECT_THAT(WhatPhotographsLack(task), testing::IsEmpty());
}

void ExpectGoodPage(const std::string& html)
{
	const Page page = ReadPage(html);
	EXPECT_EQ(page.complaint, "");
	EXPECT_EQ(OutsideResource(page, html), "");
	for (const char* const word : { "nan", "inf " })
		EXPECT_EQ(page.text.find(word), std::string::npos) << word;
}

TEST(NextPhotographs, PagesAreWellFormed)
{
	Task task = PoorTask();
	task.states[0].photos[0].file = "<b>&'\".png";
	const Calibration c = Solved(task, true);
	WatchNotes watch;
	watch.on = true;
	watch.events = { "12:00:00 <b>&'\".png: is gone" };
	watch.waiting = "too few <photographs>";
	watch.lacking = WhatPhotographsLack(task);
	ExpectGoodPage(WaitingPage({}, watch, "2000-01-01"));
	ExpectGoodPage(WaitingPage(task, watch, "2000-01-01"));
	watch.history = { { 4, c.next.sigmas }, { 5, c.next.sigmas } };
	const std::string html = ReportHtml(c, { "edges", "tiltcal calibrate", "2000-01-01", watch }, ReportPictures(c.task));
	ExpectGoodPage(html);
	EXPECT_THAT(html, HasSubstr("http-equiv=\"refresh\""));
	EXPECT_THAT(html, HasSubstr("How the sigmas fall"));
	EXPECT_THAT(html, HasSubstr("What to photograph next"));
	EXPECT_THAT(NextText(c), HasSubstr("expected: sigma of"));
}

/// How a board stands, without a lens: its axes are those of the oracle, y down; a board inclined about x recedes up or down.
TEST(NextPhotographs, AStanceIsSeen)
{
	const Task task = TaskOf({ StateOf("untilted", 0, { { 30, 0, 620 }, { 30, 90, 620 } }, 1) });
	for (size_t p = 0; p < 2; ++p)
	{
		const Stance s = StanceOf(task.states[0].photos[p]);
		// Corners 175 and 125 mm apart along the columns and rows: the depths of the outermost are 620 -+ half of that times sin 30.
		const double half = (p == 0 ? 62.5 : 87.5) * 0.5;
		EXPECT_NEAR(s.depth_ratio, (620 + half) / (620 - half), 0.01);
	}
}

}
