// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/predict.h"

#include "lens/optics.h"
#include "model/footprint.h"
#include "model/projection.h"

#include <cmath>

namespace tiltcal
{

Point Reproject(const Task& task, const Geometry& g, size_t state, size_t photo, double column, double row)
{
	const StateGeometry& own = g.states[state];
	const Vec3<double> P = CameraFromBoard(own.poses[photo].data(), task.board.X(column), task.board.Y(row));
	Point pixel;
	MakePicture(g.w_px, g.distortion.data(), own.principal_point.data(), own.lens_normal).Project(P, pixel.data());
	return pixel;
}

Vec3<double> EdgeInCamera(const Task& task, const Pose& pose, const Edge& edge)
{
	return CameraFromBoard(pose.data(), task.board.X(edge.board_column), task.board.Y(edge.board_row));
}

double PredictedBlur(const Calibration& c, size_t s, size_t p, const Edge& edge) { return PredictedBlurAs(c, s, s, p, edge); }

double PredictedBlurAs(const Calibration& c, size_t lens, size_t s, size_t p, const Edge& edge)
{
	const Geometry& g = c.MainGeometry();
	const Solution& solution = c.solution;
	const Vec3<double> P = EdgeInCamera(c.task, g.states[s].poses[p], edge);
	const Vec3<double> q = solution.states[lens].q;
	const double d = solution.ApertureOf(c.task.states[s].photos[p]), floor = solution.psf_floor_px.value;
	// The paper's (4) takes the focal depth at the point's height, not along its ray.
	if (solution.model == Model::PAPER)
		return std::hypot(tilt_lens::SignedBlurWidth(g.w_px, d, { 0, 0, q.z / (1 - P.y * q.y) }, P), floor);
	const double C = solution.field_curvature.value, curvature[2] = { C, solution.tangential_curvature.value - C };
	const Vec3<double> n = tilt_lens::LensFromPlane(q, 1 / solution.w_mm.value).normal;
	return std::sqrt(SquaredFootprintWidth(d, q, n, curvature, P, EdgeGradient(g, s, P, edge)) + floor * floor);
}

}
