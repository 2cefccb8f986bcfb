// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/check_board.h"

#include "base/robust.h"
#include "model/projection.h"
#include "solve/least_squares.h"
#include "solve/solve_geometry.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tiltcal
{

namespace
{

/// Widening, and heights of the arcs, mm; 0 of a board as it was told.
using Shape = std::array<double, 4>;

/// A feature's place on the board: mm, and from -1 to 1 over all features.
struct Place
{
	double x, y, along, down;
};

/// The features' extent in columns and rows.
class Extent
{
public:
	explicit Extent(const Task& given) : task(given)
	{
		for (const State& state : task.states)
			for (const Photo& photo : state.photos)
				for (const Corner& c : photo.corners)
				{
					columns = std::max(columns, double(c.column));
					rows = std::max(rows, double(c.row));
				}
	}

	Place Of(const Corner& c) const { return { task.board.X(c.column), task.board.Y(c.row), 2 * c.column / columns - 1, 2 * c.row / rows - 1 }; }

private:
	const Task& task;
	double columns = 1, rows = 1;
};

struct ShapeCost
{
	Place at;
	double u, v, weight;
	Vec3<double> normal;

	template<typename T>
	bool operator()(const T* w_px, const T* distortion, const T* principal_point, const T* pose, const T* shape, T* residual) const
	{
		const T height = T(1 - at.along * at.along) * shape[1] + T(1 - at.down * at.down) * shape[2] + T(at.along * at.down) * shape[3];
		const T board[3] = { T(at.x) * (T(1) + shape[0]), T(at.y), height };
		T p[3], pixel[2];
		ceres::AngleAxisRotatePoint(pose, board, p);
		const Vec3<T> P{ p[0] + pose[3], p[1] + pose[4], p[2] + pose[5] };
		if (P.z <= T(1e-9))
			return false;
		MakePicture(*w_px, distortion, principal_point, normal).Project(P, pixel);
		residual[0] = T(weight) * (pixel[0] - T(u));
		residual[1] = T(weight) * (pixel[1] - T(v));
		return true;
	}
};

/// Geometry with own poses, and a board of any of these shapes.
class ShapeFit
{
public:
	ShapeFit(const Task& given, const Geometry& start) : task(given), extent(given), g(start)
	{
		g.shared_poses = false;
		// Weak everywhere, so that a state of one photograph is no hindrance.
		for (StateGeometry& state : g.states)
			state.principal_point_fixed = true;
	}

	bool Minimise(bool free, double model_sigma)
	{
		ceres::Problem problem;
		Build(free, model_sigma, problem);
		LeastSquares how{ ceres::DENSE_SCHUR, 100, 1e-10 };
		how.threads = AllThreads();
		return SolveLeastSquares(how, problem).has_value();
	}

	/// Per coordinate and corner, px.
	std::vector<double> Residuals() const
	{
		std::vector<double> all;
		ForEachCorner([&](size_t s, size_t p, const Corner& c)
		{
			double r[2] = { 1e3, 1e3 };
			const StateGeometry& state = g.states[s];
			ShapeCost{ extent.Of(c), c.x, c.y, 1, state.lens_normal }(&g.w_px, g.distortion.data(), state.principal_point.data(), state.poses[p].data(), shape.data(), r);
			all.insert(all.end(), r, r + 2);
		});
		return all;
	}

	/// Of the same, as they were measured.
	std::vector<double> Sigmas() const
	{
		std::vector<double> all;
		ForEachCorner([&](size_t, size_t, const Corner& c) { all.insert(all.end(), 2, c.sigma); });
		return all;
	}

	/// As StateGeometry::photo_rms.
	double Rms() const
	{
		double sum = 0;
		const std::vector<double> all = Residuals();
		for (const double r : all)
			sum += r * r;
		return std::sqrt(2 * sum / double(all.size()));
	}

	/// None: singular.
	std::optional<Shape> Sigmas(double model_sigma)
	{
		ceres::Problem problem;
		Build(true, model_sigma, problem);
		ceres::Covariance::Options options;
		options.algorithm_type = ceres::SPARSE_QR;
		ceres::Covariance covariance(options);
		const std::vector<std::pair<const double*, const double*>> block{ { shape.data(), shape.data() } };
		double c[16];
		if (!covariance.Compute(block, &problem) || !covariance.GetCovarianceBlock(shape.data(), shape.data(), c))
			return std::nullopt;
		const double scale = VarianceOfResiduals(problem);
		Shape sigmas;
		for (size_t k = 0; k < 4; ++k)
			sigmas[k] = std::sqrt(std::max(scale * c[5 * k], 0.0));
		return sigmas;
	}

	double W() const { return g.w_px; }

	Shape shape{ 0, 0, 0, 0 };

private:
	template<typename Each>
	void ForEachCorner(const Each& each) const
	{
		for (size_t s = 0; s < task.states.size(); ++s)
			for (size_t p = 0; p < task.states[s].photos.size(); ++p)
				for (const Corner& c : task.states[s].photos[p].corners)
					each(s, p, c);
	}

	void Build(bool free, double model_sigma, ceres::Problem& problem)
	{
		ForEachCorner([&](size_t s, size_t p, const Corner& c)
		{
			StateGeometry& state = g.states[s];
			problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ShapeCost, 2, 1, 5, 2, 6, 4>(new ShapeCost{ extent.Of(c), c.x, c.y, 1 / std::hypot(c.sigma, model_sigma), state.lens_normal }),
				new ceres::HuberLoss(8.0), &g.w_px, g.distortion.data(), state.principal_point.data(), state.poses[p].data(), shape.data());
		});
		HoldDistortion(g, problem);
		AddPrincipalPointPriors(task, g, problem);
		if (!free)
			problem.SetParameterBlockConstant(shape.data());
	}

	const Task& task;
	const Extent extent;
	Geometry g;
};

}

BoardCheck CheckBoard(const Task& task, const Geometry& geometry)
{
	BoardCheck check;
	ShapeFit fit(task, geometry);
	const auto model_sigma = [&] { return ModelScatter(fit.Residuals(), fit.Sigmas(), 1e-4); };
	const double first = model_sigma();
	if (!fit.Minimise(false, first))
		return check;
	check.rms_flat = fit.Rms();
	const double w_flat = fit.W();
	if (!fit.Minimise(true, model_sigma()))
		return check;
	// Once more with the weights that are right when the shape is.
	const double last = model_sigma();
	if (!fit.Minimise(true, last))
		return check;
	const std::optional<Shape> sigmas = fit.Sigmas(last);
	if (!sigmas)
		return check;
	check.rms_free = fit.Rms();
	check.w_change = (fit.W() - w_flat) * task.pitch_mm;
	Estimate* const numbers[] = { &check.widening, &check.bend_along_columns, &check.bend_along_rows, &check.twist };
	for (size_t k = 0; k < 4; ++k)
		*numbers[k] = { fit.shape[k], (*sigmas)[k] };
	check.known = true;
	return check;
}

}
