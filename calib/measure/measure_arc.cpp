// SPDX-License-Identifier: AGPL-3.0-or-later

#include "measure/measure_arc.h"

#include "lens/angles.h"
#include <tiltcal/photo.h>
#include "edge/circle_edge.h"
#include "measure/measure_circles.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

using tilt_lens::Pi;

/// Angle in (-pi, pi].
double Wrapped(double t) { return std::remainder(t, 2 * Pi); }

/// Nodes along an arc.
const int NODES = 9;

/// Share of the radius of curvature that pixels may lie inside of the outline: beyond, the nearest point is not one.
const double INNER_SHARE = 0.85;

/// A pixel's half diagonal and the lens's own blur, px.
const double MARGIN = 1.5;

}

/// A part of the outline, its length s measured from its middle as FitEdge's axes have it.
struct CircleView::Arc
{
	double middle, half;                  // board angle
	double t[NODES], s[NODES];            // s increasing
	double least_radius = std::numeric_limits<double>::infinity();          // of curvature, px
	double side;                          // +1 when s grows with t

	Arc(const CircleOutline& outline, int arc, int arcs, bool bright) : middle(2 * Pi * arc / arcs), half(Pi / arcs), side(bright ? 1 : -1)
	{
		// Along the edge is (ny, -nx) of its normal from dark to bright: against t around a dark circle.
		for (int k = 0; k < NODES; ++k)
		{
			t[k] = middle + side * half * (2.0 * k / (NODES - 1) - 1);
			// Simpson.
			s[k] = k == 0 ? 0 : s[k - 1] + std::abs(t[k] - t[k - 1]) / 6 * (outline.Tangent(t[k - 1]).norm()
				+ 4 * outline.Tangent(0.5 * (t[k - 1] + t[k])).norm() + outline.Tangent(t[k]).norm());
			least_radius = std::min(least_radius, 1 / std::max(outline.Curvature(t[k], 0), 1e-9));
		}
		const double zero = s[NODES / 2];
		for (double& at : s)
			at -= zero;
	}

	double Length() const { return s[NODES - 1] - s[0]; }

	/// Places along from[] to places along to[], linear between the nodes; from[] monotonic.
	static double Between(const double* from, const double* to, double at)
	{
		const double sign = from[NODES - 1] > from[0] ? 1 : -1;
		int k = 1;
		while (k + 1 < NODES && sign * from[k] < sign * at)
			++k;
		return to[k - 1] + (at - from[k - 1]) / (from[k] - from[k - 1]) * (to[k] - to[k - 1]);
	}
	double LengthAt(double angle) const { return Between(t, s, angle); }
	double AngleAt(double length) const { return Between(s, t, length); }

	CurvedEdge Profile(const CircleOutline& outline, bool bright, double blur) const
	{
		const double reach = std::sqrt((blur * blur + 1.0 / 3) / 2), sign = bright ? -1 : 1;
		std::vector<BendPoint> points;
		for (int k = 0; k < NODES; ++k)
		{
			const Vec2 n = sign * outline.Outward(t[k]);
			points.push_back({ s[k], n.x(), n.y(), sign * outline.Curvature(t[k], reach) });
		}
		return CurvedEdge(points);
	}
};

CircleView::CircleView(const cv::Mat& grey, const Board& board, const GridMap& map, const LightField& light, const Corner& f, double r, bool is_bright)
	: place(f.column, f.row), radius(r), bright(is_bright), column(f.column), row(f.row), jacobian(map.Jacobian(place)),
	outline(map, place, r, Vec2(f.x, f.y)), light_change(light.Change(place)), smaller_radius(outline.SmallerRadius())
{
	const Vec2 centre(f.x, f.y);
	const Eigen::Matrix2d inverse = jacobian.inverse();
	std::vector<Vec2> neighbours;   // relative to this one, whether the grid has them or not: what lies there is not known
	for (int j = -2; j <= 2; ++j)
		for (int i = -2; i <= 2; ++i)
			if ((i != 0 || j != 0) && (board.kind == TargetKind::CIRCLES || (i + j) % 2 == 0))
				neighbours.emplace_back(i, j);
	// The outline and half the way to the next, in the direction where that is longest.
	const double far = board.CirclePitch() - radius;
	const Vec2 extent(far * jacobian.row(0).norm(), far * jacobian.row(1).norm());
	const int x0 = std::max(0, int(std::ceil(centre.x() - extent.x()))), x1 = std::min(grey.cols - 1, int(centre.x() + extent.x()));
	const int y0 = std::max(0, int(std::ceil(centre.y() - extent.y()))), y1 = std::min(grey.rows - 1, int(centre.y() + extent.y()));
	for (int y = y0; y <= y1; ++y)
		for (int x = x0; x <= x1; ++x)
		{
			const Vec2 p(x, y), m = inverse * (p - centre);
			// In the middle the outline's nearest point is not one, and far outside others are nearer.
			if (m.squaredNorm() > far * far || m.norm() < (1 - INNER_SHARE) * radius)
				continue;
			double clearance = std::numeric_limits<double>::infinity();
			for (const Vec2& n : neighbours)
			{
				const Vec2 d = m - n;
				const double length = d.norm();
				clearance = std::min(clearance, (length - radius) * length / (inverse.transpose() * d).norm());
			}
			if (clearance < MARGIN)
				continue;
			const CircleOutline::Foot foot = outline.FootOf(p);
			if (foot.found)
				pixels.push_back({ foot.t, foot.distance, clearance, grey.at<float>(y, x) });
		}
}

std::vector<EdgeSample> CircleView::Collect(const Arc& arc, double blur, double reach) const
{
	std::vector<EdgeSample> samples;
	for (const Pixel& p : pixels)
	{
		const double away = Wrapped(p.t - arc.middle);
		if (std::abs(away) > arc.half || std::abs(p.distance) > reach || p.clearance < blur + MARGIN)
			continue;
		samples.push_back({ bright ? -p.distance : p.distance, arc.LengthAt(arc.middle + away), p.value });
	}
	return samples;
}

EdgeOutcome CircleView::Measure(int index, int arcs, double start_blur, bool rough, Edge& edge) const
{
	const Arc arc(outline, index, arcs, bright);
	edge.column = column;
	edge.row = row;
	edge.arc = index;
	edge.square_px = smaller_radius;
	EdgeFit fit;
	std::vector<EdgeSample> samples;
	double blur = start_blur > 0 ? start_blur : 0.15 * smaller_radius;
	bool settled = false;
	for (int round = 0; round < 6 && !settled; ++round)
	{
		edge.blur = 2 * blur;
		// As far inside as outside: the fit starts from the outer quarters of both.
		const double inner = INNER_SHARE * std::min(arc.least_radius, smaller_radius), reach = std::min(inner, 1.5 * blur + 6);
		if (blur > MOST_CIRCLE_RATIO * smaller_radius + MARGIN || reach < std::min(blur, MOST_CIRCLE_RATIO * smaller_radius) + 1)
			return EdgeOutcome::TOO_BLURRED;
		samples = Collect(arc, blur, reach);
		const size_t most = rough || (round == 0 && start_blur <= 0) ? 300 : 4000, step = samples.size() / most | 1;
		std::vector<EdgeSample> thinned;
		for (size_t k = 0; k < samples.size(); k += step)
			thinned.push_back(samples[k]);
		fit = FitEdge(thinned, arc.Profile(outline, bright, blur), ShadingOfEdge(light_change, (bright ? -1 : 1) * outline.Outward(arc.middle)), start_blur > 0 || round > 0 ? blur : 0.5 * blur);
		if (!fit.valid)
			return EdgeOutcome::FAILED;
		settled = std::abs(std::max(fit.radius, 0.0) - blur) < 0.05 * blur + 0.1;
		blur = std::max(fit.radius, 0.0);
	}
	edge.blur = 2 * fit.radius;
	if (blur > MOST_CIRCLE_RATIO * smaller_radius)
		return EdgeOutcome::TOO_BLURRED;
	if (!settled || std::abs(fit.offset) > 0.25 * smaller_radius || std::abs(fit.slope) > 0.25 || fit.radius_sigma > 0.25 * fit.radius + 0.5)
		return EdgeOutcome::FAILED;

	double s_mean = 0;
	for (const EdgeSample& sample : samples)
		s_mean += sample.s / double(samples.size());
	const double t = arc.AngleAt(s_mean);
	const Vec2 n = (bright ? -1 : 1) * outline.Outward(t), where = outline.At(t) + (fit.offset + fit.slope * s_mean) * n;
	edge.board_column = place.x() + radius * std::cos(t);
	edge.board_row = place.y() + radius * std::sin(t);
	edge.x = where.x();
	edge.y = where.y();
	edge.nx = n.x();
	edge.ny = n.y();
	edge.slope = fit.slope;
	edge.blur_sigma = 2 * fit.radius_sigma;
	edge.offset_sigma = fit.offset_sigma;
	edge.slope_sigma = fit.slope_sigma;
	edge.low = fit.low;
	edge.high = fit.high;
	edge.noise = fit.rms;
	return EdgeOutcome::MEASURED;
}

double CircleView::Offset(const Edge& e) const
{
	const double t = std::atan2(e.board_row - place.y(), e.board_column - place.x());
	return Vec2(e.nx, e.ny).dot(Vec2(e.x, e.y) - outline.At(t));
}

double CircleView::Growth(double t, const Vec2& normal) const
{
	return normal.dot(jacobian * Vec2(std::cos(t), std::sin(t)));
}

}
