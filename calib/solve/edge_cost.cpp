// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/edge_cost.h"

#include "edge/disc_edge.h"
#include "edge/edge_fit.h"

#include <Eigen/Dense>
#include <ceres/ceres.h>

#include <cmath>
#include <memory>
#include <tuple>
#include <type_traits>

namespace tiltcal
{

namespace
{

struct EdgeCost
{
	EdgeModel edge;
	double soft_blur;
	EdgeWeights weights;

	template<typename... Blocks>
	bool operator()(Blocks... blocks) const
	{
		auto* const residual = std::get<sizeof...(Blocks) - 1>(std::tuple(blocks...));
		if (!edge(blocks...))
			return false;
		residual[0] *= weights.offset;
		residual[1] = (residual[1] - soft_blur) * weights.blur;
		return true;
	}
};

/// The first of EdgeCost's residuals alone.
struct PlaceCost
{
	EdgeModel edge;
	double weight;

	template<typename... Blocks>
	bool operator()(Blocks... blocks) const
	{
		auto* const residual = std::get<sizeof...(Blocks) - 1>(std::tuple(blocks...));
		std::decay_t<decltype(*residual)> seen[2];
		auto all = std::tuple(blocks...);
		std::get<sizeof...(Blocks) - 1>(all) = seen;
		if (!std::apply([&](auto... with_seen) { return edge(with_seen...); }, all))
			return false;
		residual[0] = seen[0] * weight;
		return true;
	}
};

class PhotometricCost : public ceres::CostFunction
{
public:
	PhotometricCost(const EdgeModel& e, const Edge& m, const EdgeWeights& weights)
		: seen(new EdgeCostFunction<EdgeModel, 2>(new EdgeModel(e))), profile(m.profile), box_a(std::abs(m.nx)), box_b(std::abs(m.ny))
	{
		*mutable_parameter_block_sizes() = seen->parameter_block_sizes();
		set_num_residuals(static_cast<int>(profile.size()));
		// The pixels' noise, raised so that the edge's blur is as certain as the weight says.
		const double certain = std::min(1.0, weights.blur * std::max(m.blur_sigma, 1e-9));
		weight = certain / std::max(m.noise, 1e-9);
	}

	bool Evaluate(double const* const* blocks, double* residuals, double** jacobians) const override
	{
		double at[2];
		std::vector<std::vector<double>> inner;
		std::vector<double*> rows;
		for (const int size : parameter_block_sizes())
			inner.emplace_back(static_cast<size_t>(2 * size));
		for (auto& block : inner)
			rows.push_back(block.data());
		if (!seen->Evaluate(blocks, at, jacobians ? rows.data() : nullptr))
			return false;
		Eigen::MatrixX2d by_place_and_width;
		Bins(at[0], 0.5 * at[1], residuals, jacobians ? &by_place_and_width : nullptr);
		for (size_t b = 0; jacobians && b < inner.size(); ++b)
		{
			if (!jacobians[b])
				continue;
			const int size = parameter_block_sizes()[b];
			using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
			Eigen::Map<RowMajor>(jacobians[b], num_residuals(), size) = by_place_and_width * Eigen::Map<const RowMajor>(inner[b].data(), 2, size);
		}
		return true;
	}

private:
	/// Residuals of the bins for an edge at `place` with a disc of the soft radius `soft`, and their derivatives by place and soft width.
	void Bins(double place, double soft, double* residuals, Eigen::MatrixX2d* by) const
	{
		const long n = static_cast<long>(profile.size());
		Eigen::MatrixX2d sides(n, 2), change(n, 2);
		Eigen::VectorXd value(n);
		for (long k = 0; k < n; ++k)
		{
			const ProfileBin& bin = profile[size_t(k)];
			const EdgeResponse e = SoftResponse(soft, [&](double radius) { return PixelEdgeResponse(bin.x - place, radius, box_a, box_b); });
			const double w = weight * std::sqrt(double(bin.count));
			sides.row(k) << w * (1 - e.value), w * e.value;
			change.row(k) << -w * e.d_position, 0.5 * w * e.d_radius;
			value[k] = w * double(bin.value);
		}
		const Eigen::Matrix2d inverse = (sides.transpose() * sides).inverse();
		const Eigen::Vector2d light = inverse * (sides.transpose() * value);
		Eigen::Map<Eigen::VectorXd>(residuals, n) = sides * light - value;
		if (!by)
			return;
		change *= light[1] - light[0];
		*by = change - sides * (inverse * (sides.transpose() * change));
	}

	std::unique_ptr<ceres::CostFunction> seen;
	std::vector<ProfileBin> profile;
	double box_a, box_b, weight;
};

}

EdgeModel MakeEdgeModel(const Task& task, LensModel model, const Edge& e, const Vec3<double>& axis, bool axis_is_free)
{
	const Point normal = EdgeNormal(e);
	return { model, task.board.X(e.board_column), task.board.Y(e.board_row), e.x, e.y, normal[0], normal[1], task.pitch_mm, axis, axis_is_free };
}

ceres::CostFunction* NewEdgeCost(const EdgeModel& edge, double soft_blur_px, const EdgeWeights& weights)
{
	return new EdgeCostFunction<EdgeCost, 2>(new EdgeCost{ edge, soft_blur_px, weights });
}

ceres::CostFunction* NewPlaceCost(const EdgeModel& edge, double weight) { return new EdgeCostFunction<PlaceCost, 1>(new PlaceCost{ edge, weight }); }

ceres::CostFunction* NewPhotometricCost(const EdgeModel& edge, const Edge& measured, const EdgeWeights& weights)
{
	return new PhotometricCost(edge, measured, weights);
}

}
