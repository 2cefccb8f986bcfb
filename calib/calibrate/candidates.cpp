// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/candidates.h"

#include "base/robust.h"
#include "measure/spread_order.h"
#include "model/footprint.h"
#include "model/predict.h"
#include "model/projection.h"
#include "solve/each_edge.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tiltcal
{

namespace
{

const double RAD = M_PI / 180;

/// Blur radius over the circle's radius up to which circles are found well (test_blurred.cpp: 0.4).
const double MOST_BLUR_OF_CIRCLES = 0.35;
/// px; below it a square has too few pixels.
const double LEAST_SQUARE = 12;
/// Edges that stand for all of a photograph: six of each direction reach all quarters (test_spread_order.cpp).
const size_t EDGES = 24;

const double PLACES[] = { 0.27, 0.5, 0.73 };     // of the picture
const double INCLINES[] = { 20, 40 };            // degrees
/// Of the nearest and the farthest board so far.
const double NEARER = 0.75, FARTHER = 1.3;
const int DISTANCES = 4;

struct OnBoard { double column, row; };

/// Of the features: first and last column and row.
struct Extent { double columns, rows, margin; };

Extent ExtentOf(const Board& board)
{
	if (board.IsCheckerboard())
		return { double(board.InnerColumns() - 1), double(board.InnerRows() - 1), 1 };
	const double columns = board.kind == TargetKind::CIRCLES ? board.columns - 1 : 2 * board.columns - 1;
	return { columns, double(board.rows - 1), board.CircleRadius() + 0.25 };
}

class Camera
{
public:
	Camera(const Calibration& calibration, size_t state, const Pose& at)
		: c(calibration), s(state), pose(at), picture(MakePicture(c.geometry.w_px, c.geometry.distortion.data(), c.geometry.states[s].principal_point.data(), c.geometry.states[s].lens_normal)) {}

	Vec3<double> InCamera(const OnBoard& at) const { return CameraFromBoard(pose.data(), c.task.board.X(at.column), c.task.board.Y(at.row)); }

	Point Pixel(const OnBoard& at) const
	{
		Point pixel{ HUGE_VAL, HUGE_VAL };
		const Vec3<double> P = InCamera(at);
		if (P.z > 1)
			picture.Project(P, pixel.data());
		return pixel;
	}

	/// Of a step on the board, px.
	Point Step(const OnBoard& at, double columns, double rows) const
	{
		const double h = 0.01;
		const Point a = Pixel({ at.column - h * columns, at.row - h * rows }), b = Pixel({ at.column + h * columns, at.row + h * rows });
		return { (b[0] - a[0]) / (2 * h), (b[1] - a[1]) / (2 * h) };
	}

	bool IsInPicture(const OnBoard& at) const
	{
		const Point p = Pixel(at);
		return p[0] > 2 && p[1] > 2 && p[0] < c.task.width - 3 && p[1] < c.task.height - 3;
	}

	/// An edge whose direction on the board is (columns, rows).
	Edge EdgeAt(const OnBoard& at, double columns, double rows) const
	{
		Edge e;
		e.board_column = at.column;
		e.board_row = at.row;
		const Point pixel = Pixel(at), along = Step(at, columns, rows);
		const double length = std::hypot(along[0], along[1]), a = std::hypot(Step(at, 1, 0)[0], Step(at, 1, 0)[1]), b = std::hypot(Step(at, 0, 1)[0], Step(at, 0, 1)[1]);
		e.x = pixel[0];
		e.y = pixel[1];
		e.nx = -along[1] / length;
		e.ny = along[0] / length;
		e.square_px = std::min(a, b) * (c.task.board.IsCheckerboard() ? 1 : c.task.board.CircleRadius());
		const Solution& lens = c.solution;
		const Vec3<double> P = InCamera(at), q = lens.states[s].q;
		const double C = lens.field_curvature.value, curvature[2] = { C, lens.tangential_curvature.value - C };
		const Vec3<double> n = tilt_lens::LensFromPlane(q, 1 / lens.w_mm.value).normal;
		e.blur = std::sqrt(std::max(SquaredFootprintWidth(lens.aperture_diameter.value, q, n, curvature, P, picture.Gradient(P, e.nx, e.ny)) + lens.psf_floor_squared.value, 0.0));
		return e;
	}

private:
	const Calibration& c;
	size_t s;
	const Pose& pose;
	PictureOf<double> picture;
};

/// What the edges measured so far say of how well one of some blur is measured: medians over groups of equal size.
class EdgeNoise
{
public:
	explicit EdgeNoise(const Task& task)
	{
		std::vector<const Edge*> all;
		ForEachEdge(task, [&](size_t, size_t, const Edge& e) { all.push_back(&e); });
		std::sort(all.begin(), all.end(), [](const Edge* a, const Edge* b) { return a->blur < b->blur; });
		const size_t count = std::clamp<size_t>(all.size() / 30, 1, 12);
		for (size_t g = 0; g < count; ++g)
		{
			std::vector<double> blur, offset, width;
			for (size_t k = g * all.size() / count; k < (g + 1) * all.size() / count; ++k)
			{
				// An edge twice as long has twice the pixels.
				const double length = std::sqrt(LengthOf(*all[k]));
				blur.push_back(all[k]->blur);
				offset.push_back(all[k]->offset_sigma * length);
				width.push_back(all[k]->blur_sigma * length);
			}
			if (!blur.empty())
				groups.push_back({ Median(std::move(blur)), Median(std::move(offset)), Median(std::move(width)) });
		}
	}

	void Fill(Edge& e) const
	{
		size_t k = 0;
		while (k + 1 < groups.size() && groups[k + 1].blur < e.blur)
			++k;
		const Group &a = groups[k], &b = groups[std::min(k + 1, groups.size() - 1)];
		const double share = b.blur > a.blur ? std::clamp((e.blur - a.blur) / (b.blur - a.blur), 0.0, 1.0) : 0;
		// Beyond what was measured: a ramp twice as wide has twice the noise's variance.
		const double beyond = e.blur > b.blur && b.blur > 1 ? std::sqrt(e.blur / b.blur) : 1, length = std::sqrt(LengthOf(e));
		e.offset_sigma = beyond * (a.offset + share * (b.offset - a.offset)) / length;
		e.blur_sigma = beyond * (a.width + share * (b.width - a.width)) / length;
	}

private:
	struct Group { double blur, offset, width; };
	std::vector<Group> groups;

	static double LengthOf(const Edge& e) { return e.square_px > 0 ? e.square_px : 1; }
};

void AddEdges(const Board& board, const Camera& camera, std::vector<Edge>& edges)
{
	if (board.IsCheckerboard())
	{
		for (const EdgePlace& p : SpreadOrder(board, 0))
			if (edges.size() < EDGES)
				edges.push_back(camera.EdgeAt({ p.column + 0.5 * p.along_columns, p.row + 0.5 * !p.along_columns }, p.along_columns, !p.along_columns));
		return;
	}
	const int arcs = 8;
	for (const ArcPlace& p : SpreadArcs(board, arcs, 0))
		if (edges.size() < EDGES)
		{
			const double t = 2 * M_PI * p.arc / arcs, r = board.CircleRadius();
			edges.push_back(camera.EdgeAt({ board.CircleColumn(p.index, p.row) + r * std::cos(t), p.row + r * std::sin(t) }, -std::sin(t), std::cos(t)));
		}
}

std::pair<double, double> DistancesOf(const Calibration& c)
{
	const Extent extent = ExtentOf(c.task.board);
	double nearest = HUGE_VAL, farthest = 0;
	for (const StateGeometry& state : c.geometry.states)
		for (const Pose& pose : state.poses)
		{
			const double z = CameraFromBoard(pose.data(), c.task.board.X(0.5 * extent.columns), c.task.board.Y(0.5 * extent.rows)).z;
			nearest = std::min(nearest, z);
			farthest = std::max(farthest, z);
		}
	return { NEARER * nearest, FARTHER * farthest };
}

Candidate ExpectWith(const Calibration& c, const EdgeNoise& noise, size_t s, const Pose& pose)
{
	const Board& board = c.task.board;
	const Camera camera(c, s, pose);
	const Extent extent = ExtentOf(board);
	Candidate out;
	out.look.pose = pose;
	const OnBoard middle{ 0.5 * extent.columns, 0.5 * extent.rows };
	out.look.middle_px = camera.Pixel(middle);
	out.look.distance_mm = camera.InCamera(middle).z;
	const double m = extent.margin;
	for (const OnBoard& corner : { OnBoard{ -m, -m }, OnBoard{ extent.columns + m, -m }, OnBoard{ extent.columns + m, extent.rows + m }, OnBoard{ -m, extent.rows + m } })
	{
		if (!camera.IsInPicture(corner))
			return out;
		out.look.outline_px.push_back(camera.Pixel(corner));
	}
	std::vector<Edge> edges;
	AddEdges(board, camera, edges);
	const auto less = [](const Edge& a, const Edge& b) { return a.blur < b.blur; };
	const auto [least, most] = std::minmax_element(edges.begin(), edges.end(), less);
	out.look.blur_px[0] = least->blur;
	out.look.blur_px[1] = most->blur;
	for (const Edge& e : edges)
		if (e.BlurRatio() > (board.IsCheckerboard() ? MOST_BLUR_RATIO : MOST_BLUR_OF_CIRCLES) || e.square_px < LEAST_SQUARE)
			return out;
	for (Edge& e : edges)
		noise.Fill(e);
	out.photo.width = c.task.width;
	out.photo.height = c.task.height;
	out.photo.edges = std::move(edges);
	return out;
}

}

Pose PoseOfBoard(const Calibration& c, size_t s, const Point& middle, double distance, double incline, double recedes)
{
	const Point& centre = c.geometry.states[s].principal_point;
	const Vec3<double> at = distance * Vec3<double>{ (middle[0] - centre[0]) / c.geometry.w_px, (centre[1] - middle[1]) / c.geometry.w_px, 1 };
	const double angle = incline * RAD, phi = recedes * RAD;
	// About the axis in the board across which it recedes: (sin phi, cos phi, 0) x e_z.
	Pose pose{ angle * std::cos(phi), -angle * std::sin(phi), 0, 0, 0, 0 };
	const Extent extent = ExtentOf(c.task.board);
	const Vec3<double> turned = CameraFromBoard(pose.data(), c.task.board.X(0.5 * extent.columns), c.task.board.Y(0.5 * extent.rows));
	pose[3] = at.x - turned.x;
	pose[4] = at.y - turned.y;
	pose[5] = at.z - turned.z;
	return pose;
}

Candidate Expect(const Calibration& c, size_t s, const Pose& pose) { return ExpectWith(c, EdgeNoise(c.task), s, pose); }

std::vector<Candidate> CandidatesOf(const Calibration& c, size_t s)
{
	const EdgeNoise noise(c.task);
	const auto [nearest, farthest] = DistancesOf(c);
	std::vector<Candidate> all;
	const auto add = [&](const Point& middle, double distance, double incline, double recedes)
	{
		Candidate one = ExpectWith(c, noise, s, PoseOfBoard(c, s, middle, distance, incline, recedes));
		one.look.incline_deg = incline;
		one.look.recedes_deg = recedes;
		if (!one.photo.edges.empty())
			all.push_back(std::move(one));
	};
	for (int k = 0; k < DISTANCES; ++k)
		for (const double x : PLACES)
			for (const double y : PLACES)
			{
				const double distance = nearest * std::pow(farthest / nearest, double(k) / (DISTANCES - 1));
				const Point middle{ x * (c.task.width - 1), y * (c.task.height - 1) };
				add(middle, distance, 0, 0);
				for (const double incline : INCLINES)
					for (int recedes = 0; recedes < 360; recedes += 45)
						add(middle, distance, incline, recedes);
			}
	return all;
}

}
