// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/scene_parts.h"

#include "lens/angles.h"
#include "model/projection.h"
#include <tiltcal/calibrate.h>

#include "lens/field_curvature.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const double RADIANS = tilt_lens::RadiansPerDegree;

double Kappa(const SceneParts& scene, const Vec3<double>& v)
{
	return tilt_lens::InverseFocusDistanceOnBowl(scene.q, scene.field_curvature, scene.lens_normal, v);
}

/// The part of a polygon of directions that is in focus no farther than scene.far, as points in focus.
Polygon InFocus(const SceneParts& scene, const Polygon& directions)
{
	Polygon points;
	const double least = 1 / scene.far;
	for (size_t i = 0; i < directions.size(); ++i)
	{
		const Vec3<double>&a = directions[i], &b = directions[(i + 1) % directions.size()];
		const double at_a = Kappa(scene, a), at_b = Kappa(scene, b);
		if (at_a >= least)
			points.push_back((1 / at_a) * a);
		// kappa is linear along the side but for the little that the field bends within it.
		if ((at_a >= least) != (at_b >= least))
			points.push_back(scene.far * (a + ((least - at_a) / (at_b - at_a)) * (b - a)));
	}
	return points;
}

void AddFocus(SceneParts& scene)
{
	const int columns = 12, rows = 8;
	const Vec3<double>&top_left = scene.corner_rays[0], &bottom_right = scene.corner_rays[2];
	const auto ray = [&](int i, int j)
	{
		return Vec3<double>{ top_left.x + (bottom_right.x - top_left.x) * i / columns, top_left.y + (bottom_right.y - top_left.y) * j / rows, 1 };
	};
	for (int j = 0; j < rows; ++j)
		for (int i = 0; i < columns; ++i)
		{
			const Polygon part = InFocus(scene, { ray(i, j), ray(i + 1, j), ray(i + 1, j + 1), ray(i, j + 1) });
			if (part.size() > 2)
				scene.focus.push_back(part);
		}
	double low = 0, high = 0;
	for (const Vec3<double>& corner : scene.corner_rays)
	{
		low = std::min(low, Dot(corner, scene.tilt_up));
		high = std::max(high, Dot(corner, scene.tilt_up));
	}
	for (int k = 0; k <= 60; ++k)
	{
		const Vec3<double> v = Vec3<double>{ 0, 0, 1 } + (low + (high - low) * k / 60) * scene.tilt_up;
		if (Kappa(scene, v) >= 1 / scene.far)
			scene.focus_section.push_back((1 / Kappa(scene, v)) * v);
	}
}

/// Where kappa - 1 changes its sign on a triangle, linearly between its corners.
void AddCrossing(const std::array<Vec3<double>, 3>& P, const std::array<double, 3>& g, BoardPart& part)
{
	Polygon ends;
	for (size_t k = 0; k < 3; ++k)
	{
		const size_t next = (k + 1) % 3;
		if ((g[k] < 0) != (g[next] < 0))
			ends.push_back(P[k] + (g[k] / (g[k] - g[next])) * (P[next] - P[k]));
	}
	if (ends.size() == 2)
		part.sharp.push_back({ ends[0], ends[1] });
}

/// The last corner of the outer squares, which begin at (-1, -1), one square before the first inner corner; of a grid of circles a step around them.
struct LastCorner
{
	int column, row;
};

LastCorner LastCornerOf(const Board& board)
{
	if (board.IsCheckerboard())
		return { board.columns - 1, board.rows - 1 };
	return { board.CircleColumn(board.columns - 1, 1) + 1, board.rows };
}

BoardPart MakeBoard(const SceneParts& scene, const Board& board, const Pose& pose)
{
	BoardPart part;
	const auto at = [&](int column, int row) { return CameraFromBoard(pose.data(), board.X(column), board.Y(row)); };
	const auto [right, bottom] = LastCornerOf(board);
	part.outline = { at(-1, -1), at(right, -1), at(right, bottom), at(-1, bottom) };
	for (int j = -1; j < bottom; ++j)
		for (int i = -1; i < right; ++i)
		{
			const Vec3<double> P[] = { at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1) };
			const double g[] = { Kappa(scene, P[0]) - 1, Kappa(scene, P[1]) - 1, Kappa(scene, P[2]) - 1, Kappa(scene, P[3]) - 1 };
			AddCrossing({ P[0], P[1], P[2] }, { g[0], g[1], g[2] }, part);
			AddCrossing({ P[0], P[2], P[3] }, { g[0], g[2], g[3] }, part);
		}
	return part;
}

/// As far as the boards reach, and the plane of focus on the axis when that is not much farther.
double DepthOf(const Task& task, const std::vector<Pose>& poses, double U)
{
	double far = 0;
	for (const Pose& pose : poses)
		for (const int column : { -1, LastCornerOf(task.board).column })
			for (const int row : { -1, LastCornerOf(task.board).row })
				far = std::max(far, CameraFromBoard(pose.data(), task.board.X(column), task.board.Y(row)).z);
	return 1.12 * (U > far && U < 2 * far ? U : far);
}

}

SceneParts MakeScene(const Calibration& c, size_t s)
{
	const Geometry& g = c.MainGeometry();
	const StateLens& lens = c.solution.states[s];
	SceneParts scene;
	scene.q = lens.q;
	scene.w = c.solution.w_mm.value;
	scene.d = c.solution.aperture_diameter.value;
	scene.lens_normal = tilt_lens::LensFromPlane(lens.q, 1 / scene.w).normal;
	scene.field_curvature = c.solution.field_curvature.value;
	scene.far = DepthOf(c.task, g.states[s].poses, lens.focus_distance.value);
	const double phi = lens.tilt_direction.value * RADIANS;
	if (std::isfinite(phi))
		scene.tilt_up = { std::sin(phi), std::cos(phi), 0 };
	const Point& centre = g.states[s].principal_point;
	// Half a pixel beyond the outermost pixel centres.
	const double left = -0.5 - centre[0], right = c.task.width - 0.5 - centre[0], top = centre[1] + 0.5, bottom = centre[1] - c.task.height + 0.5;
	const double scale = c.task.pitch_mm / scene.w;
	scene.corner_rays = { { { scale * left, scale * top, 1 }, { scale * right, scale * top, 1 }, { scale * right, scale * bottom, 1 }, { scale * left, scale * bottom, 1 } } };
	AddFocus(scene);
	for (const Pose& pose : g.states[s].poses)
		scene.boards.push_back(MakeBoard(scene, c.task.board, pose));
	const double across = std::hypot(lens.q.x, lens.q.y);
	scene.has_hinge = across > 1e-9;
	if (scene.has_hinge)
		scene.hinge = { lens.q.x / (across * across), lens.q.y / (across * across), 0 };
	return scene;
}

}
