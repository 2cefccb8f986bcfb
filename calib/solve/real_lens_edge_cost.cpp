// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_edge_cost.h"

#include "solve/moving_rays.h"

namespace tiltcal
{

namespace
{

using namespace real_lens;

/// A row of derivatives: the blocks one after the other, but for the rims, in which a point of the opening is constant.
enum Block { STATE_BLOCK, POSE_BLOCK, CENTRE_BLOCK, LENS_BLOCK, C_BLOCK, RIMS_BLOCK };
const int SIZES[] = { STATE_SIZE, 6, 3, LENS_SIZE, tilt_lens::AberrationTerms };
const int AT_POSE = STATE_SIZE, AT_CENTRE = AT_POSE + 6, AT_LENS = AT_CENTRE + 3, COLUMNS = AT_LENS + LENS_SIZE + tilt_lens::AberrationTerms;
using Row = Eigen::Matrix<double, COLUMNS, 1>;

Eigen::Vector3d ValueOf(const Vec3<PlaceJet>& v) { return { v.x.a, v.y.a, v.z.a }; }

/// g . dv
ByPlace Along(const Eigen::Vector3d& g, const Vec3<PlaceJet>& v) { return g.x() * v.x.v + g.y() * v.y.v + g.z() * v.z.v; }

/// Where the rays of an edge cross the board.
class Crossings
{
public:
	Crossings(const RealLensEdge& of, const double* state, const double* pose, const double* centre, const double* lens, const double* c)
		: edge(of), rays(state, lens, c, of.r, of.pitch_mm, of.u, of.v), a(ValueOf(rays.Mounted().basis.a)), b(ValueOf(rays.Mounted().basis.b)), n(ValueOf(rays.Mounted().normal)),
		  from(centre[0] - pose[3], centre[1] - pose[4], centre[2] - pose[5])
	{
		using Turn = ceres::Jet<double, 3>;
		Turn turn[3], R[9];
		for (int i = 0; i < 3; ++i)
			turn[i] = Turn(pose[i], i);
		ceres::AngleAxisToRotationMatrix(turn, R);
		for (int k = 0; k < 3; ++k)
			for (int i = 0; i < 3; ++i)
			{
				axis[k][i] = R[3 * k + i].a;
				axis_turned[k].row(i) = R[3 * k + i].v.transpose();
			}
	}

	/// RealLensEdge::FromLine and its derivatives.
	double FromLine(const OpeningPoint& p, Row& by) const
	{
		const MovingRay ray = rays.Through(p.x, p.y);
		const tilt_lens::PupilRay<double>& out = ray.object;
		const Eigen::Vector3d direction = out.slope_x * a + out.slope_y * b + n, start = from + out.x * a + out.y * b;
		const int own = edge.along_columns ? 1 : 0;
		const Eigen::Vector3d &along = axis[own], &across = axis[2];
		const double reach = -across.dot(start) / across.dot(direction), slant = along.dot(direction) / across.dot(direction);
		const Eigen::Vector3d hit = start + reach * direction;
		// Of the crossing by where the ray starts; `reach` times that by its direction.
		const Eigen::Vector3d g = along - slant * across;
		const Eigen::Vector4d by_ray(g.dot(a), g.dot(b), reach * g.dot(a), reach * g.dot(b));
		Eigen::Matrix<double, RAY_NUMBERS, 1> numbers = ray.object_by.transpose() * by_ray;
		numbers.head<PLACE_NUMBERS>() += (out.x + reach * out.slope_x) * Along(g, rays.Mounted().basis.a) + (out.y + reach * out.slope_y) * Along(g, rays.Mounted().basis.b) +
			reach * Along(g, rays.Mounted().normal);
		by.head<STATE_SIZE>() = numbers.head<STATE_SIZE>();
		by.segment<3>(AT_POSE) = axis_turned[own].transpose() * hit - slant * (axis_turned[2].transpose() * hit);
		by.segment<3>(AT_POSE + 3) = -g;
		by.segment<3>(AT_CENTRE) = g;
		by.tail<COLUMNS - AT_LENS>() = numbers.tail<COLUMNS - AT_LENS>();
		return along.dot(hit) - (edge.along_columns ? edge.Y : edge.X);
	}

private:
	const RealLensEdge& edge;
	MovingRays rays;
	Eigen::Vector3d a, b, n;           ///< of the lens plane and its normal, camera frame
	Eigen::Vector3d from;              ///< the lens's centre, seen from the board's origin
	Eigen::Vector3d axis[3];           ///< the board's, camera frame
	Eigen::Matrix3d axis_turned[3];    ///< by the pose's angles
};

}

RealLensEdgeCost::RealLensEdgeCost(const RealLensEdge& of, const RealLensEdge::Seen& weights) : edge(of), weight(weights)
{
	set_num_residuals(edge.CountOfSeen());
	mutable_parameter_block_sizes()->assign(std::begin(SIZES), std::end(SIZES));
	mutable_parameter_block_sizes()->push_back(RIMS_SIZE);
}

bool RealLensEdgeCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
	const double *const state = parameters[STATE_BLOCK], *const pose = parameters[POSE_BLOCK], *const centre = parameters[CENTRE_BLOCK], *const lens = parameters[LENS_BLOCK],
		*const c = parameters[C_BLOCK];
	edge.See(state, pose, centre, lens, c, parameters[RIMS_BLOCK], residuals);
	const size_t seen = size_t(num_residuals());
	for (size_t i = 0; i < seen; ++i)
		residuals[i] *= weight[i];
	if (!jacobians)
		return true;

	const Crossings crossings(edge, state, pose, centre, lens, c);
	const int n = int(edge.points.size());
	Eigen::Matrix<double, COLUMNS, Eigen::Dynamic> by(COLUMNS, n);
	Eigen::VectorXd crossing(n);
	Row by_middle = Row::Zero();
	double middle = 0;
	for (int k = 0; k < n; ++k)
	{
		const double px_per_mm = edge.px_per_mm[size_t(k)], w = edge.points[size_t(k)].weight;
		Row row;
		crossing[k] = -px_per_mm * crossings.FromLine(edge.points[size_t(k)], row);
		by.col(k) = -px_per_mm * row;
		middle += w * crossing[k];
		by_middle += w * by.col(k);
	}
	std::array<Row, RealLensEdge::SEEN> of;
	of.fill(Row::Zero());
	of[0] = by_middle;
	for (int k = 0; k < n; ++k)
	{
		const double x = crossing[k] - middle, w = edge.points[size_t(k)].weight;
		const Row moved = by.col(k) - by_middle;
		of[0] += w * edge.response.Place(x).derivative * moved;
		of[1] += w * edge.response.Soft(x).derivative * moved;
		for (int shape = 0; edge.shape && shape < SHAPES; ++shape)
			of[size_t(2 + shape)] += w * edge.response.ShapeOf(Shape(shape), x).derivative * moved;
	}
	of[1][AT_LENS + FLOOR_SQUARED] += edge.soft_by_floor;
	for (size_t i = 0; i < seen; ++i)
	{
		int at = 0;
		for (int block = STATE_BLOCK; block < RIMS_BLOCK; at += SIZES[block++])
			for (int k = 0; jacobians[block] && k < SIZES[block]; ++k)
				jacobians[block][int(i) * SIZES[block] + k] = weight[i] * of[i][at + k];
		for (int k = 0; jacobians[RIMS_BLOCK] && k < RIMS_SIZE; ++k)
			jacobians[RIMS_BLOCK][int(i) * RIMS_SIZE + k] = weight[i] * edge.by_rims[i][size_t(k)];
	}
	return true;
}

}
