// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose_fit.h"

#include "camera/real_lens_ray.h"

#include "lens/angles.h"
#include "model/projection.h"
#include "base/robust.h"
#include "solve/least_squares.h"

#include <Eigen/SVD>
#include <ceres/ceres.h>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Measured points are no better than this; noise-free ones must not make the loss's scale 0.
const double LEAST_SCALE_PX = 0.02;
/// Quadratic up to so many standard deviations: of two-dimensional Gaussian residuals 0.2 % are larger.
const double LOSS_SIGMAS = 3.5;
/// Before the scale is known: what points clicked by hand are off by.
const double FIRST_LOSS_PX = 3;
/// Median of the length of a two-dimensional Gaussian of standard deviation 1.
const double RAYLEIGH_MEDIAN = 1.17741;

struct PoseCost
{
	const StateCamera& camera;
	Vec3<double> normal;
	PosePoint point;
	Vec3<double> origin;

	template<typename T>
	bool operator()(const T* rotation, const T* location, T* residual) const
	{
		const T from_lens[3] = { point.world.x - location[0], point.world.y - location[1], point.world.z - location[2] };
		T p[3];
		ceres::QuaternionRotatePoint(rotation, from_lens, p);
		const Vec3<T> P{ p[0] - origin.x, p[1] - origin.y, p[2] - origin.z };
		if (P.z <= T(1e-9) || P.x * normal.x + P.y * normal.y + P.z * normal.z <= T(1e-9))
			return false;
		const T w(camera.ImageDistancePx());
		const T centre[2] = { T(camera.principal_point[0]), T(camera.principal_point[1]) };
		T distortion[5];
		for (size_t k = 0; k < 5; ++k)
			distortion[k] = T(camera.distortion[k]);
		T pixel[2];
		MakePicture(w, distortion, centre, normal).Project(P, pixel);
		residual[0] = (pixel[0] - point.u) / point.sigma;
		residual[1] = (pixel[1] - point.v) / point.sigma;
		return true;
	}
};

/// Rotation w x y z and location as Ceres' parameter blocks.
struct Blocks
{
	double rotation[4], location[3];

	explicit Blocks(const PoseMinimum& m)
		: rotation{ m.rotation.w(), m.rotation.x(), m.rotation.y(), m.rotation.z() }, location{ m.location.x(), m.location.y(), m.location.z() }
	{
	}
};

void Build(const StateCamera& camera, const Vec3<double>& normal, const std::vector<PosePoint>& points, const std::vector<Vec3<double>>& origins, double loss_px, Blocks& blocks, ceres::Problem& problem)
{
	for (size_t i = 0; i < points.size(); ++i)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PoseCost, 2, 4, 3>(new PoseCost{ camera, normal, points[i], origins[i] }),
			new ceres::HuberLoss(loss_px), blocks.rotation, blocks.location);
	problem.SetManifold(blocks.rotation, new ceres::QuaternionManifold);
}

/// OpenCV's frames have y down: F R F and F t with F = diag(1, -1, 1) (camera.h).
PoseMinimum FromOpenCv(const cv::Mat& rvec, const cv::Mat& tvec)
{
	const cv::Vec3d a(rvec.reshape(1, 3)), t(tvec.reshape(1, 3));
	const Eigen::Vector3d axis(-a[0], a[1], -a[2]);
	PoseMinimum m;
	if (axis.norm() > 0)
		m.rotation = Eigen::AngleAxisd(axis.norm(), axis.normalized());
	m.location = m.rotation.conjugate() * Eigen::Vector3d(-t[0], t[1], -t[2]);
	return m;
}

}

PoseFit::PoseFit(const StateCamera& the_camera, const std::vector<PosePoint>& the_points, double unit_mm)
	: camera(the_camera), normal(the_camera.LensNormal()), points(the_points), origins(the_points.size(), { 0, 0, 0 })
{
	const double n = static_cast<double>(points.size());
	for (const PosePoint& p : points)
		centroid += Eigen::Vector3d(p.world.x, p.world.y, p.world.z) / n;
	Eigen::MatrixX3d places(points.size(), 3);
	for (size_t i = 0; i < points.size(); ++i)
		places.row(static_cast<long>(i)) << points[i].world.x - centroid.x(), points[i].world.y - centroid.y(), points[i].world.z - centroid.z();
	spread = places.norm() / std::sqrt(n);
	if (!(spread > 0))
		return;
	places /= spread;
	for (size_t i = 0; i < points.size(); ++i)
		points[i].world = { places(long(i), 0), places(long(i), 1), places(long(i), 2) };
	for (size_t i = 0; i < points.size() && camera.aberrations; ++i)
	{
		const CameraRay ray = MeanRayThroughLens(camera, { points[i].u, points[i].v });
		points[i].u = camera.principal_point[0] + camera.ImageDistancePx() * ray.direction.x;
		points[i].v = camera.principal_point[1] - camera.ImageDistancePx() * ray.direction.y;
		origins[i] = (1 / (unit_mm * spread)) * ray.origin;
	}
	const Eigen::JacobiSVD<Eigen::MatrixXd> svd(places, Eigen::ComputeThinV);
	extents.head(svd.singularValues().size()) = svd.singularValues();
	flat_normal = svd.matrixV().col(2);
}

std::vector<PoseMinimum> PoseFit::Starts() const
{
	std::vector<cv::Point3d> world;
	std::vector<cv::Point2d> image;
	StateCamera flat = camera;
	flat.distortion = {};
	for (const PosePoint& p : points)
	{
		const Point pixel{ p.u, p.v };
		const Vec3<double> v = Unproject(camera, pixel).value_or(*Unproject(flat, pixel));
		world.emplace_back(p.world.x, -p.world.y, p.world.z);
		image.emplace_back(v.x / v.z, -v.y / v.z);
	}
	std::vector<PoseMinimum> starts;
	const cv::Matx33d K = cv::Matx33d::eye();
	const auto attempt = [&](const auto& solve)
	{
		try
		{
			solve();
		}
		catch (const cv::Exception&)   // degenerate for this method; the others remain
		{
		}
	};
	attempt([&]
	{
		std::vector<cv::Mat> rvecs, tvecs;
		cv::solvePnPGeneric(world, image, K, cv::noArray(), rvecs, tvecs, false, cv::SOLVEPNP_SQPNP);
		for (size_t k = 0; k < rvecs.size(); ++k)
			starts.push_back(FromOpenCv(rvecs[k], tvecs[k]));
	});
	attempt([&]
	{
		// Some points in ten may be mistaken for others.
		cv::Mat rvec, tvec;
		if (points.size() >= 6 && cv::solvePnPRansac(world, image, K, cv::noArray(), rvec, tvec, false, 300, static_cast<float>(3 * FIRST_LOSS_PX / camera.ImageDistancePx()), 0.999,
				cv::noArray(), cv::SOLVEPNP_AP3P))
			starts.push_back(FromOpenCv(rvec, tvec));
	});
	return starts;
}

std::vector<int> PoseFit::LinesBehind() const
{
	std::vector<int> lines;
	const std::vector<PoseMinimum> starts = Starts();
	for (const PosePoint& p : points)
		if (!starts.empty() && (starts[0].rotation * (Eigen::Vector3d(p.world.x, p.world.y, p.world.z) - starts[0].location)).z() <= 0)
			lines.push_back(p.line);
	return lines;
}

PoseMinimum PoseFit::MirroredAboutSight(const PoseMinimum& m) const
{
	const Eigen::Vector3d sight = (m.rotation * -m.location).normalized();   // to the centroid, camera frame
	const Eigen::Vector3d face = m.rotation * flat_normal;
	const Eigen::Vector3d mirrored = 2 * face.dot(sight) * sight - face;
	PoseMinimum other;
	other.rotation = Eigen::Quaterniond::FromTwoVectors(face, mirrored) * m.rotation;
	other.location = other.rotation.conjugate() * (m.rotation * m.location);
	return other;
}

bool PoseFit::Refine(double loss_px, PoseMinimum& m) const
{
	Blocks blocks(m);
	ceres::Problem problem;
	Build(camera, normal, points, origins, loss_px, blocks, problem);
	// Finer ones than the sums' rounding end, with Ceres 2.2, in steps that gain nothing: no convergence then.
	const std::optional<double> cost = SolveLeastSquares({ ceres::DENSE_QR, 200, 1e-12, 1e-12, 1e-12 }, problem);
	if (!cost)
		return false;
	m.rotation = Eigen::Quaterniond(blocks.rotation[0], blocks.rotation[1], blocks.rotation[2], blocks.rotation[3]).normalized();
	m.location = { blocks.location[0], blocks.location[1], blocks.location[2] };
	m.misfit = 2 * *cost;
	return true;
}

std::vector<Eigen::Vector2d> PoseFit::Residuals(const PoseMinimum& m) const
{
	const Blocks blocks(m);
	std::vector<Eigen::Vector2d> residuals;
	for (size_t i = 0; i < points.size(); ++i)
	{
		residuals.emplace_back(Eigen::Vector2d::Zero());
		PoseCost{ camera, normal, points[i], origins[i] }(blocks.rotation, blocks.location, residuals.back().data());
		residuals.back() *= points[i].sigma;
	}
	return residuals;
}

double PoseFit::RobustScale(const PoseMinimum& m) const
{
	std::vector<double> lengths;
	const std::vector<Eigen::Vector2d> residuals = Residuals(m);
	for (size_t i = 0; i < points.size(); ++i)
		lengths.push_back(residuals[i].norm() / points[i].sigma);
	// The fit's six numbers take up a part of the residuals.
	const double n = static_cast<double>(points.size());
	return std::max(LEAST_SCALE_PX, Median(std::move(lengths)) / RAYLEIGH_MEDIAN * std::sqrt(n / (n - 3)));
}

std::vector<PoseMinimum> PoseFit::Minima(double& scale_px) const
{
	std::vector<PoseMinimum> found;
	const auto by_misfit = [](const PoseMinimum& a, const PoseMinimum& b) { return a.misfit < b.misfit; };
	const auto add = [&](PoseMinimum m)
	{
		if (Refine(FIRST_LOSS_PX, m) && std::none_of(found.begin(), found.end(), [&](const PoseMinimum& other) { return SamePose(m, other); }))
			found.push_back(m);
	};
	for (const PoseMinimum& start : Starts())
		add(start);
	for (size_t i = 0, n = found.size(); i < n; ++i)
		add(MirroredAboutSight(found[i]));
	if (found.empty())
		return found;
	std::sort(found.begin(), found.end(), by_misfit);
	scale_px = RobustScale(found[0]);
	std::vector<PoseMinimum> minima;
	for (PoseMinimum m : found)
		if (Refine(LOSS_SIGMAS * scale_px, m))
			minima.push_back(m);
	std::sort(minima.begin(), minima.end(), by_misfit);
	return minima;
}

bool PoseFit::Covariance(const PoseMinimum& m, double scale_px, Eigen::Matrix<double, 6, 6>& covariance) const
{
	Blocks blocks(m);
	ceres::Problem problem;
	Build(camera, normal, points, origins, LOSS_SIGMAS * scale_px, blocks, problem);
	ceres::Covariance::Options options;
	options.algorithm_type = ceres::DENSE_SVD;
	ceres::Covariance computed(options);
	const std::vector<const double*> all{ blocks.rotation, blocks.location };
	double tangent[36];
	if (!computed.Compute(all, &problem) || !computed.GetCovarianceMatrixInTangentSpace(all, tangent))
		return false;
	covariance = Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(tangent);
	// Ceres' quaternion moves by exp(delta): a rotation by twice delta about the camera's axes.
	covariance.topRows<3>() *= 2;
	covariance.leftCols<3>() *= 2;
	return covariance.allFinite();
}

bool SamePose(const PoseMinimum& a, const PoseMinimum& b)
{
	return a.rotation.angularDistance(b.rotation) < 0.5 * tilt_lens::Pi / 180 && (a.location - b.location).norm() < 0.01 * a.location.norm();
}

}
