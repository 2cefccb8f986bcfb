// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the paper's method makes of the photographs in scenes/boxes/photos (calibrated by the fixture calib.photographs.calibrate) is what its approximations
// make of a thin lens in the same poses, without noise: its answer is far from the truth, and not by a fault of ours.

#include "model/predict.h"
#include "solve/solve_geometry.h"
#include "solve/solve_lens.h"

#include "lens/optics.h"

#include <ceres/rotation.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace
{

using namespace tiltcal;
using Json = nlohmann::json;

Json ReadCalibration()
{
	std::ifstream in(CALIBRATION_FOLDER "/calibration.json");
	return Json::parse(in);
}

Pose PoseOf(const Json& photo)
{
	double columns[9];
	for (size_t r = 0; r < 3; ++r)
		for (size_t c = 0; c < 3; ++c)
			columns[r + 3 * c] = photo.at("rotation")[r][c];
	Pose pose;
	ceres::RotationMatrixToAngleAxis(columns, pose.data());
	for (size_t k = 0; k < 3; ++k)
		pose[3 + k] = photo.at("translation_mm")[k];
	return pose;
}

/// The calibrated thin lens and its boards, as far as light needs them.
Calibration ThinLensOf(const Json& json)
{
	Calibration c;
	c.task.board = ParseBoard("12x9", 25);
	c.task.width = json.at("image_size_px")[0];
	c.task.height = json.at("image_size_px")[1];
	c.task.pitch_mm = json.at("pixel_pitch_mm");
	Solution& lens = c.solution;
	lens.w_mm.value = json.at("image_distance_mm");
	lens.aperture_diameter.value = json.at("aperture_diameter_mm");
	lens.field_curvature.value = json.at("field_curvature_per_mm");
	lens.tangential_curvature.value = json.value("tangential_curvature_per_mm", lens.field_curvature.value);
	c.geometry.w_px = lens.w_mm.value / c.task.pitch_mm;
	c.geometry.shared_poses = true;
	const char* const names[] = { "k1", "k2", "p1", "p2", "k3" };
	for (size_t k = 0; k < 5; ++k)
		c.geometry.distortion[k] = json.at("distortion").at(names[k]);
	for (const Json& state : json.at("states"))
	{
		// Where a real lens is the answer the thin one's numbers stand in `thin`.
		const Json& q = state.at("inverse_focus_per_mm");
		StateLens own;
		own.q = { q[0], q[1], q[2] };
		lens.states.push_back(own);
		StateGeometry place;
		place.lens_normal = tilt_lens::LensFromPlane(own.q, 1 / lens.w_mm.value).normal;
		place.principal_point = { state.at("principal_point_px")[0], state.at("principal_point_px")[1] };
		for (const Json& photo : state.at("photos"))
			place.poses.push_back(PoseOf(photo));
		c.geometry.states.push_back(place);
		c.task.states.push_back({ state.at("name"), !c.task.states.empty(), std::vector<Photo>(place.poses.size()) });
	}
	return c;
}

/// What it photographs: corners, and an edge from each to the next.
void Shoot(Calibration& c)
{
	const Board& board = c.task.board;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
			for (int row = 0; row < board.InnerRows(); ++row)
				for (int column = 0; column < board.InnerColumns(); ++column)
				{
					Photo& photo = c.task.states[s].photos[p];
					const Point at = Reproject(c.task, c.geometry, s, p, column, row);
					photo.corners.push_back({ column, row, at[0], at[1], 0.03 });
					for (const bool along : { true, false })
					{
						if (along ? column + 1 >= board.InnerColumns() : row + 1 >= board.InnerRows())
							continue;
						Edge e;
						e.column = column;
						e.row = row;
						e.along_columns = along;
						e.board_column = column + 0.5 * along;
						e.board_row = row + 0.5 * !along;
						const Point next = Reproject(c.task, c.geometry, s, p, column + along, row + !along), middle = Reproject(c.task, c.geometry, s, p, e.board_column, e.board_row);
						const double length = std::hypot(next[0] - at[0], next[1] - at[1]);
						e.nx = -(next[1] - at[1]) / length;
						e.ny = (next[0] - at[0]) / length;
						e.x = middle[0];
						e.y = middle[1];
						e.blur = PredictedBlur(c, s, p, e);
						photo.edges.push_back(e);
					}
				}
}

TEST(PaperOfPhotographs, ErrsAsItsApproximationsSay)
{
	const Json json = ReadCalibration();
	const Json& found = json.at("comparison").at("paper");
	Calibration exact = ThinLensOf(json);
	Shoot(exact);
	Geometry geometry;
	const Solution paper = SolvePaper(exact.task, SolveGeometry(exact.task, { 0, {}, true }), geometry);
	ASSERT_EQ(paper.failure, "");
	for (size_t s = 1; s < paper.states.size(); ++s)
	{
		const Json& state = found.at("states")[s];
		const double tilt = state.at("lens_tilt_deg"), sigma = state.at("lens_tilt_sigma_deg");
		// Three of its own sigmas, which hold what it leaves out of these photographs as far as that scatters.
		EXPECT_NEAR(tilt, paper.states[s].lens_tilt.value, 3 * sigma) << exact.task.states[s].name;
		// And that is not the truth, to which the exact models come.
		EXPECT_GT(std::abs(std::abs(tilt) - 5), 3 * sigma);
	}
	// Without distortion; so are both.
	EXPECT_NEAR(found.at("image_distance_mm").get<double>(), paper.w_mm.value, 3 * found.at("image_distance_sigma_mm").get<double>());
}

}
