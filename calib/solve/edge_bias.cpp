// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/edge_bias.h"

#include "edge/edge_fit.h"
#include "edge/soft_radius.h"
#include "lens/field_curvature.h"
#include "measure/refine_corners.h"
#include "model/footprint.h"
#include "model/predict.h"
#include "model/projection.h"
#include "model/rims_on_lens.h"

#include <Eigen/Core>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tiltcal
{

namespace
{

using Vec2 = Eigen::Vector2d;

/// One state's camera, lens included.
struct Camera
{
	PictureOf<double> picture;
	const double* distortion;
	Vec3<double> q;
	double curvature, half_difference, radius, floor_squared, image_distance;
	const std::vector<tilt_lens::Rim>& rims;

	Vec2 Pixel(const Vec3<double>& P) const
	{
		double pixel[2];
		picture.Project(P, pixel);
		return { pixel[0], pixel[1] };
	}

	Vec3<double> DirectionToPixel(const Vec2& p) const
	{
		return { (p.x() - picture.principal_point[0]) / picture.w_px, -(p.y() - picture.principal_point[1]) / picture.w_px, 1 };
	}

	/// Ideal direction of a pixel, any length.
	Vec3<double> Direction(const Vec2& p) const { return tilt_lens::UndistortDirection(distortion, picture.basis.a, picture.basis.b, picture.n, DirectionToPixel(p)); }

	/// The plane that touches the bowl of focus's inverse distance at P's direction: exact along that ray.
	Vec3<double> TouchingPlane(const Vec3<double>& P, double bowl) const
	{
		const double depth = Dot(P, picture.n);
		const Vec3<double> aside = (1 / depth) * (P - depth * picture.n);
		return q + bowl * (2. * aside - Dot(aside, aside) * picture.n);
	}

	/// How far the lens moves an edge at P with that picture direction across itself, px/mm (footprint.h).
	Vec3<double> Move(const Vec3<double>& P, const Vec2& normal) const
	{
		const double bowls[2] = { curvature, half_difference };
		return MoveByLensPoint(q, picture.n, bowls, P, picture.Gradient(P, normal.x(), normal.y()));
	}

	/// The one bowl that blurs an edge there as an astigmatic lens's two do.
	double BowlFor(const Vec3<double>& P, const Vec2& normal) const
	{
		const double term = tilt_lens::CurvatureTerm(picture.n, P);
		if (half_difference == 0 || !(std::abs(half_difference * term) > 1e-12))
			return curvature;
		const Vec3<double> G = picture.Gradient(P, normal.x(), normal.y()), across = G - Dot(G, picture.n) * picture.n, move = Move(P, normal);
		const double sigma = std::copysign(std::sqrt(Dot(move, move) / Dot(across, across)), Dot(move, across));
		return (1 - Dot(q, P) - sigma) / term;
	}

	/// Diameter of the blur across the picture direction `normal` of an edge at P, squared; px^2, the lens's own blur included.
	double SquaredBlur(const Vec3<double>& P, const Vec2& normal) const
	{
		const Vec3<double> move = Move(P, normal);
		return 4 * radius * radius * Dot(move, move) + floor_squared;
	}
};

/// Light of the lens at the distance `at` from its middle, in its radii: the share of the opening that is there, less the whole lens's.
struct Slice
{
	double at, more;
};

/// Across the direction `across` in the lens's plane; none where the rims leave the lens alone, or nothing of it.
std::vector<Slice> SlicesOf(const Vec3<double>& n, const Vec3<double>& across, double lens_radius, const std::vector<RimOnLens>& rims)
{
	const int count = 64;
	const Vec3<double> along = Cross(n, across);
	std::vector<Slice> slices;
	std::vector<double> whole;
	double sum = 0, sum_whole = 0;
	// Chebyshev's points of the second kind, as which a disc's chords are evenly spaced in angle.
	for (int k = 1; k <= count; ++k)
	{
		const double a = M_PI * k / (count + 1), at = std::cos(a), chord = std::sin(a);
		double from = -chord, to = chord;
		for (const RimOnLens& rim : rims)
		{
			const double off = at - Dot(rim.centre, across) / lens_radius, radius = rim.radius / lens_radius, half = std::sqrt(std::max(radius * radius - off * off, 0.0));
			const double middle = Dot(rim.centre, along) / lens_radius;
			from = std::max(from, middle - half);
			to = std::min(to, middle + half);
		}
		slices.push_back({ at, chord * std::max(to - from, 0.0) });
		whole.push_back(2 * chord * chord);
		sum += slices.back().more;
		sum_whole += whole.back();
	}
	if (!(sum > 0) || sum >= sum_whole)
		return {};
	for (size_t k = 0; k < slices.size(); ++k)
		slices[k].more = slices[k].more / sum - whole[k] / sum_whole;
	return slices;
}

/// An edge from A to B through that camera, exactly: pixel p sees of it what the lens sees through p's point of focus F. The plane
/// through A, B and F cuts the lens's disc in a line; on one side of it are the lens points that see the bright side. The lens's own blur, and a demosaicing's, is
/// no disc: it widens the pixel.
class EdgeThroughLens : public EdgeProfile
{
public:
	/// `middle` and `normal` (to the bright side): of the line in the picture from which samples count; `radius`: of the blur, about; px.
	EdgeThroughLens(const Camera& c, const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& at, const Vec2& mid, const Vec2& n, double r)
		: camera(c), A(a), along(b - a), focus(c.TouchingPlane(at, c.BowlFor(at, n))), middle(mid), normal(n), radius(std::max(r, 0.02))
	{
		// A disc of the diameter F has the variance F^2/16 across, a box of the width a a^2/12: half of the former is put on each of the pixel's two.
		const double own = 6 * std::max(c.floor_squared, 0.0) / 16;
		box_a = std::sqrt(n.x() * n.x() + own);
		box_b = std::sqrt(n.y() * n.y() + own);
		sign = Dot(A, Cross(along, camera.Direction(middle + 2 * normal))) > Dot(A, Cross(along, camera.Direction(middle - 2 * normal))) ? 1 : -1;
		if (camera.rims.empty())
			return;
		const Vec3<double> v = camera.Direction(middle), &lens_normal = camera.picture.n, move = camera.Move(at, normal);
		const double kappa = tilt_lens::InverseFocusDistanceOnBowl(camera.q, camera.curvature, lens_normal, v), bright = sign * Dot(move, InLens(v)) > 0 ? -1 : 1;
		slices = SlicesOf(lens_normal, (bright / std::sqrt(Dot(move, move))) * move, camera.radius,
			RimsOnLens(lens_normal, v, kappa, camera.DirectionToPixel(middle), camera.image_distance, camera.rims));
	}

	/// The sample as a straight edge's that is as far away and as blurred as this one is there. Beyond the blur only the distance counts. Its value alone is that through rims.
	EdgeResponse At(const EdgeSample& sample, double, double, double) const override
	{
		const double step = std::min(0.5, 0.3 * radius), x = std::clamp(sample.x, -radius, radius);
		const Vec2 p = middle + x * normal + sample.s * Vec2(normal.y(), -normal.x());
		const double before = Height(p - step * normal), after = Height(p + step * normal);
		const double slope = (after - before) / (2 * step), at = 0.5 * (before + after) / slope + sample.x - x, blur = std::abs(1 / slope);
		EdgeResponse response = PixelEdgeResponse(at, blur, box_a, box_b);
		for (const Slice& slice : slices)
			response.value += slice.more * PixelEdgeResponse(at + slice.at * blur, 0, box_a, box_b).value;
		return response;
	}

private:
	/// Of the plane in which pixels see the edge, the part along the lens: there the line cuts it. v: their direction.
	Vec3<double> InLens(const Vec3<double>& v) const
	{
		const Vec3<double> plane = Cross(along, v - Dot(focus, v) * A);
		return plane - Dot(plane, camera.picture.n) * camera.picture.n;
	}

	/// Distance of the lens centre from that line, in radii of the lens, positive on the bright side.
	double Height(const Vec2& p) const
	{
		const Vec3<double> v = camera.Direction(p), in_lens = InLens(v);
		return sign * Dot(A, Cross(along, v)) / (std::sqrt(Dot(in_lens, in_lens)) * camera.radius);
	}

	const Camera& camera;
	Vec3<double> A, along, focus;
	Vec2 middle, normal;
	double radius;
	double box_a, box_b, sign = 1;
	std::vector<Slice> slices;
};

/// A grid over the pixels that were used, of the middles of cells: finer across, where the light changes. The edges that cross at the ends lean by `lean`, px
/// along for a px across, and the pixels end at them.
std::vector<EdgeSample> Window(const Edge& e, double middle, double length, const std::array<double, 2>& lean)
{
	const int across = 24, lengthwise = 8;
	std::vector<EdgeSample> samples;
	for (int i = 0; i < across; ++i)
		for (int j = 0; j < lengthwise; ++j)
		{
			const double x = e.reach * ((2 * i + 1.0) / across - 1), s = middle + e.span * ((2 * j + 1.0) / lengthwise - 1), end = s / length + 0.5;
			samples.push_back({ x, s + x * ((1 - end) * lean[0] + end * lean[1]), 0 });
		}
	return samples;
}

/// What WithoutEdgeBias does to an edge.
struct Correction
{
	bool good = false;
	double at_corners = 0;    ///< of the line's place at the middle of the edge, px: takes it to the chord between the corners
	double bend = 0;          ///< from there to the edge itself
	double slope = 0, soft_blur = 0;
	double board = 0;         ///< where along the edge it was measured, 0 to 1
};

/// `across`: a small step on the board to the side.
Correction CorrectionOf(const Camera& camera, const Vec3<double>& A, const Vec3<double>& B, const Vec3<double>& across, const Edge& e)
{
	const Vec2 a = camera.Pixel(A), b = camera.Pixel(B), middle = 0.5 * (a + b);
	Vec2 normal = Vec2(-(b - a).y(), (b - a).x()).normalized();
	if (normal.dot(Vec2(e.nx, e.ny)) < 0)
		normal = -normal;
	const Vec2 along(normal.y(), -normal.x());
	const double length = (b - a).norm(), s = along.dot(Vec2(e.x, e.y) - middle), forward = along.dot(b - a) > 0 ? 1 : -1;
	Correction c;
	c.board = std::clamp(0.5 + forward * s / length, 0.0, 1.0);
	for (int round = 0; round < 3; ++round)
		c.board = std::clamp(c.board + forward * (s - along.dot(camera.Pixel(A + c.board * (B - A)) - middle)) / length, 0.0, 1.0);
	const Vec3<double> at = A + c.board * (B - A);
	c.bend = normal.dot(camera.Pixel(at) - middle);

	const auto lean = [&](const Vec3<double>& end)
	{
		const Vec2 step = camera.Pixel(end + across) - camera.Pixel(end - across);
		return step.dot(along) / step.dot(normal);
	};
	const std::vector<EdgeSample> samples = Window(e, s, length, { lean(forward > 0 ? A : B), lean(forward > 0 ? B : A) });
	const double squared = camera.SquaredBlur(at, EdgeNormal(e)[0] * Vec2::UnitX() + EdgeNormal(e)[1] * Vec2::UnitY());
	EdgeFit straight;
	straight.low = e.low;
	straight.high = e.high;
	straight.radius = SignedRoot(0.25 * squared);
	const EdgeChange change = FirstOrderChange(samples, LoneEdge(normal.x(), normal.y()), EdgeThroughLens(camera, A, B, at, middle, normal, straight.radius), straight);
	c.at_corners = -(change.offset + change.slope * s);
	c.slope = -change.slope;
	c.soft_blur = -2 * change.radius;
	const double most = 0.25 + 0.25 * std::sqrt(std::max(squared, 0.0));
	c.good = std::isfinite(c.at_corners + c.slope + c.soft_blur) && std::abs(c.at_corners) < most && std::abs(c.soft_blur) < most;
	return c;
}

void Correct(const Task& task, const Camera& camera, const Pose& pose, Photo& photo)
{
	std::vector<Correction> all(photo.edges.size());
	cv::parallel_for_(cv::Range(0, int(all.size())), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
		{
			const Edge& e = photo.edges[size_t(k)];
			if (e.arc >= 0 || !(e.reach > 0))
				continue;
			const Board& board = task.board;
			const Vec3<double> A = CameraFromBoard(pose.data(), board.X(e.column), board.Y(e.row));
			const Vec3<double> B = CameraFromBoard(pose.data(), board.X(e.column + e.along_columns), board.Y(e.row + !e.along_columns));
			const Vec3<double> C = CameraFromBoard(pose.data(), board.X(e.column + 0.1 * !e.along_columns), board.Y(e.row + 0.1 * e.along_columns));
			all[size_t(k)] = CorrectionOf(camera, A, B, C - A, e);
		}
	});
	const auto move = [&photo](const std::vector<Correction>& by, double Correction::* distance)
	{
		for (size_t k = 0; k < by.size(); ++k)
			if (by[k].good)
			{
				photo.edges[k].x += by[k].*distance * photo.edges[k].nx;
				photo.edges[k].y += by[k].*distance * photo.edges[k].ny;
			}
	};
	move(all, &Correction::at_corners);
	for (size_t k = 0; k < all.size(); ++k)
	{
		Edge& e = photo.edges[k];
		if (!all[k].good)
			continue;
		e.slope += all[k].slope;
		e.blur = DiameterOfSoft(SoftDiameter(e.blur) + all[k].soft_blur);
		(e.along_columns ? e.board_column : e.board_row) = (e.along_columns ? e.column : e.row) + all[k].board;
	}
	// Chords meet in the corners; the edges themselves are bent away from them.
	if (task.board.IsCheckerboard())
		RefineCorners(photo);
	move(all, &Correction::bend);
}

}

Task WithoutEdgeBias(const Task& measured, const Geometry& g, const Solution& solution, const std::vector<tilt_lens::Rim>& rims)
{
	Task task = measured;
	if (!task.board.IsCheckerboard())
		return task;
	for (size_t s = 0; s < task.states.size(); ++s)
	{
		const StateGeometry& own = g.states[s];
		const double C = solution.field_curvature.value;
		Camera camera{ MakePicture(g.w_px, g.distortion.data(), own.principal_point.data(), own.lens_normal), g.distortion.data(), solution.states[s].q, C,
			solution.tangential_curvature.value - C, 0, solution.psf_floor_squared.value, g.w_px * task.pitch_mm, rims };
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
		{
			camera.radius = 0.5 * solution.ApertureOf(task.states[s].photos[p]);
			Correct(task, camera, own.poses[p], task.states[s].photos[p]);
		}
	}
	return task;
}

}
