// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/solve_geometry.h"
#include "solve/least_squares.h"

#include "model/predict.h"

#include "model/projection.h"
#include <tiltcal/error.h>
#include "base/if_answered.h"
#include "base/robust.h"

#include <ceres/ceres.h>
#include <fmt/format.h>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// First guess of what the camera model leaves out of a corner's place, px.
const double FIRST_MODEL_SIGMA = 0.3;

struct ReprojectionCost
{
	double x, y, u, v, weight;   // board mm, pixels, 1/px
	Vec3<double> normal;

	template<typename T>
	bool operator()(const T* w_px, const T* distortion, const T* principal_point, const T* pose, T* residual) const
	{
		const Vec3<T> P = CameraFromBoard(pose, x, y);
		if (P.z <= T(1e-9))
			return false;
		T pixel[2];
		MakePicture(*w_px, distortion, principal_point, normal).Project(P, pixel);
		residual[0] = weight * (pixel[0] - u);
		residual[1] = weight * (pixel[1] - v);
		return true;
	}
};

/// What is known of w beforehand, px.
struct ImageDistanceCost
{
	double value, sigma;

	template<typename T>
	bool operator()(const T* w_px, T* residual) const
	{
		residual[0] = (*w_px - T(value)) / T(sigma);
		return true;
	}
};

/// How far from the picture's centre the principal point of an untilted camera may well be, in widths of the picture.
const double CENTRE_SHARE = 0.02;

/// What is known of a principal point beforehand, px.
struct PrincipalPointCost
{
	double u, v, sigma;

	template<typename T>
	bool operator()(const T* principal_point, T* residual) const
	{
		residual[0] = (principal_point[0] - T(u)) / T(sigma);
		residual[1] = (principal_point[1] - T(v)) / T(sigma);
		return true;
	}
};

void HoldNearCentre(const Task& task, Point& principal_point, ceres::Problem& problem)
{
	problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PrincipalPointCost, 2, 2>(new PrincipalPointCost{ 0.5 * (task.width - 1), 0.5 * (task.height - 1), CENTRE_SHARE * task.width }),
		nullptr, principal_point.data());
}

/// OpenCV's rotation and translation in our frames (camera.h).
Pose FromOpenCv(const cv::Mat& rvec, const cv::Mat& tvec)
{
	// F R(a) F with F = diag(1, -1, 1) is the rotation by the axis (-a_x, a_y, -a_z).
	const cv::Vec3d a(rvec.reshape(1, 3)), t(tvec.reshape(1, 3));
	return { -a[0], a[1], -a[2], t[0], -t[1], t[2] };
}

/// Start from OpenCV's closed form and its own refinement without distortion.
void Initialise(const Task& task, Geometry& g)
{
	std::vector<std::vector<cv::Point3f>> board;
	std::vector<std::vector<cv::Point2f>> pixels;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
		{
			board.emplace_back();
			pixels.emplace_back();
			for (const Corner& c : photo.corners)
			{
				// OpenCV's board frame has y down.
				board.back().emplace_back(static_cast<float>(task.board.X(c.column)), static_cast<float>(-task.board.Y(c.row)), 0.f);
				pixels.back().emplace_back(static_cast<float>(c.x), static_cast<float>(c.y));
			}
		}
	cv::Mat K, coefficients;
	std::vector<cv::Mat> rvecs, tvecs;
	const int flags = cv::CALIB_FIX_ASPECT_RATIO | cv::CALIB_ZERO_TANGENT_DIST | cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3
		| (board.size() < 3 ? cv::CALIB_FIX_PRINCIPAL_POINT : 0);
	try
	{
		K = cv::initCameraMatrix2D(board, pixels, cv::Size(task.width, task.height), 1);
		cv::calibrateCamera(board, pixels, cv::Size(task.width, task.height), K, coefficients, rvecs, tvecs, flags | cv::CALIB_USE_INTRINSIC_GUESS);
	}
	catch (const cv::Exception& e)
	{
		throw Refused(fmt::format("the corners do not determine a camera ({}): photograph the board in at least three poses, inclined by 20 to 45 degrees", e.err));
	}
	g.w_px = K.at<double>(0, 0);
	if (!std::isfinite(g.w_px) || g.w_px <= 0)
		throw Refused("the corners do not determine the image distance: photograph the board inclined by 20 to 45 degrees, not parallel to the sensor");
	size_t k = 0;
	for (const State& state : task.states)
	{
		StateGeometry& own = g.states[size_t(&state - task.states.data())];
		own.principal_point = { K.at<double>(0, 2), K.at<double>(1, 2) };
		for (size_t i = 0; i < state.photos.size(); ++i, ++k)
			own.poses.push_back(FromOpenCv(rvecs[k], tvecs[k]));
	}
}

void Build(const Task& task, Geometry& g, double model_sigma, ceres::Problem& problem)
{
	for (const Prior& prior : task.priors)
		if (prior.quantity == Quantity::IMAGE_DISTANCE)
			problem.AddResidualBlock(new ceres::AutoDiffCostFunction<ImageDistanceCost, 1, 1>(new ImageDistanceCost{ prior.value / task.pitch_mm, prior.sigma / task.pitch_mm }), nullptr, &g.w_px);
	for (size_t s = 0; s < task.states.size(); ++s)
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
			for (const Corner& c : task.states[s].photos[p].corners)
			{
				const double weight = 1 / std::hypot(c.sigma, model_sigma);
				auto* cost = new ceres::AutoDiffCostFunction<ReprojectionCost, 2, 1, 5, 2, 6>(
					new ReprojectionCost{ task.board.X(c.column), task.board.Y(c.row), c.x, c.y, weight, g.states[s].lens_normal });
				// Far out, because the model error is not noise: only a corner under a reflection
				// or one taken for another must not bend the camera.
				problem.AddResidualBlock(cost, new ceres::HuberLoss(8.0), &g.w_px, g.distortion.data(), g.states[s].principal_point.data(), PoseOf(g, s, p).data());
			}
}

void Solve(ceres::Problem& problem)
{
	LeastSquares how{ ceres::DENSE_SCHUR, 200, 1e-12, 1e-12 };
	how.threads = AllThreads();
	std::string why;
	if (!SolveLeastSquares(how, problem, &why))
		throw Refused(fmt::format("the reprojection fit did not converge ({}), as where w is hardly determined: photograph the board inclined by 20 to 45 degrees, in three or more directions", why));
}

/// Standard deviations, rescaled by the residuals; false when the problem is singular.
bool Sigmas(ceres::Problem& problem, Geometry& g)
{
	ceres::Covariance::Options options;
	// Poses make the Jacobian sparse; it fails on a singular problem, which is the answer wanted
	// there. A dense SVD gives the same numbers and doubles the time of the geometry.
	options.algorithm_type = ceres::SPARSE_QR;
	ceres::Covariance covariance(options);
	std::vector<std::pair<const double*, const double*>> blocks;
	const auto want = [&](const double* block) { if (!problem.IsParameterBlockConstant(block)) blocks.emplace_back(block, block); };
	want(&g.w_px);
	want(g.distortion.data());
	for (size_t s = 0; s < g.states.size(); ++s)
	{
		want(g.states[s].principal_point.data());
		if (s == 0 || !g.shared_poses)
			for (const Pose& pose : g.states[s].poses)
				want(pose.data());
	}
	if (!covariance.Compute(blocks, &problem))
		return false;

	const double scale = std::sqrt(VarianceOfResiduals(problem));
	const auto get = [&](const double* block, double* sigma, int n)
	{
		std::vector<double> c(static_cast<size_t>(n * n), 0);
		if (!problem.IsParameterBlockConstant(block))
			covariance.GetCovarianceBlock(block, block, c.data());
		for (int i = 0; i < n; ++i)
			sigma[i] = scale * std::sqrt(std::max(c[static_cast<size_t>(i * n + i)], 0.0));
	};
	get(&g.w_px, &g.w_px_sigma, 1);
	get(g.distortion.data(), g.distortion_sigma.data(), 5);
	for (size_t s = 0; s < g.states.size(); ++s)
	{
		StateGeometry& state = g.states[s];
		get(state.principal_point.data(), state.principal_point_sigma.data(), 2);
		state.pose_sigmas = state.poses;
		for (size_t p = 0; p < g.states[s].poses.size(); ++p)
			get(PoseOf(g, s, p).data(), g.states[s].pose_sigmas[p].data(), 6);
	}
	return true;
}

/// What the model leaves out of the coordinates, px.
double ModelSigma(const Task& task, const Geometry& g)
{
	std::vector<double> r, sigmas;
	for (size_t s = 0; s < task.states.size(); ++s)
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
			for (const Corner& c : task.states[s].photos[p].corners)
			{
				const Point at = Reproject(task, g, s, p, c.column, c.row);
				r.push_back(at[0] - c.x);
				r.push_back(at[1] - c.y);
				sigmas.insert(sigmas.end(), 2, c.sigma);
			}
	return ModelScatter(r, sigmas, 1e-4);
}

/// Holds the principal points that the photographs leave open. True: there are some.
bool HoldLoosePrincipalPoints(const Task& task, Geometry& g, ceres::Problem& problem, bool solved)
{
	bool any = false;
	for (size_t s = 0; s < g.states.size(); ++s)
	{
		// Two unknowns of the plane's homography are left for the sensor, per photo; three are wanted.
		const bool loose = solved ? std::max(g.states[s].principal_point_sigma[0], g.states[s].principal_point_sigma[1]) > CENTRE_SHARE * task.width
			: task.states[s].photos.size() < 2 && (s == 0 || !g.shared_poses);
		if (!loose || g.states[s].principal_point_fixed)
			continue;
		g.states[s].principal_point = { 0.5 * (task.width - 1), 0.5 * (task.height - 1) };
		HoldNearCentre(task, g.states[s].principal_point, problem);
		g.states[s].principal_point_fixed = true;
		any = true;
	}
	return any;
}

/// One weighted fit from g, with sigmas. False: singular.
bool Fit(const Task& task, double model_sigma, Geometry& g)
{
	ceres::Problem problem;
	Build(task, g, model_sigma, problem);
	HoldDistortion(g, problem);
	AddPrincipalPointPriors(task, g, problem);
	HoldLoosePrincipalPoints(task, g, problem, false);
	Solve(problem);
	bool regular = Sigmas(problem, g);
	if (regular && HoldLoosePrincipalPoints(task, g, problem, true))
	{
		Solve(problem);
		regular = Sigmas(problem, g);
	}
	if (g.shared_poses)
		for (size_t s = 1; s < g.states.size(); ++s)
			g.states[s].poses = g.states[0].poses;
	return regular;
}

/// Any coefficient is 2 sigma from 0.
bool IsDistorted(const Geometry& g)
{
	for (size_t k = 0; k < g.distortion.size(); ++k)
		if (std::abs(g.distortion[k]) > 2 * g.distortion_sigma[k])
			return true;
	return false;
}

}

std::vector<Vec3<double>> LensNormals(const Geometry& g)
{
	std::vector<Vec3<double>> normals;
	for (const StateGeometry& state : g.states)
		normals.push_back(state.lens_normal);
	return normals;
}

void AddPrincipalPointPriors(const Task& task, Geometry& g, ceres::Problem& problem)
{
	for (StateGeometry& state : g.states)
		if (state.principal_point_fixed)
			HoldNearCentre(task, state.principal_point, problem);
}

void HoldDistortion(Geometry& g, ceres::Problem& problem)
{
	enum { K1, K2, P1, P2, K3 };
	switch (g.distortion_terms)
	{
	case 0: problem.SetParameterBlockConstant(g.distortion.data()); break;
	case 1: problem.SetManifold(g.distortion.data(), new ceres::SubsetManifold(5, { K2, P1, P2, K3 })); break;
	case 2: problem.SetManifold(g.distortion.data(), new ceres::SubsetManifold(5, { P1, P2, K3 })); break;
	case 4: problem.SetManifold(g.distortion.data(), new ceres::SubsetManifold(5, { K3 })); break;
	default: break;
	}
}

void MeasureReprojection(const Task& task, Geometry& g)
{
	double total = 0;
	size_t count = 0;
	for (size_t s = 0; s < task.states.size(); ++s)
	{
		g.states[s].photo_rms.clear();
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
		{
			double sum = 0;
			for (const Corner& c : task.states[s].photos[p].corners)
			{
				const Point at = Reproject(task, g, s, p, c.column, c.row);
				sum += (at[0] - c.x) * (at[0] - c.x) + (at[1] - c.y) * (at[1] - c.y);
			}
			const size_t n = task.states[s].photos[p].corners.size();
			g.states[s].photo_rms.push_back(std::sqrt(sum / double(n)));
			total += sum;
			count += n;
		}
	}
	g.rms = std::sqrt(total / double(count));
}

Geometry SolveGeometry(const Task& task, const GeometryOptions& options)
{
	Geometry g;
	g.distortion_terms = options.terms;
	g.shared_poses = options.shared_poses;
	g.states.resize(task.states.size());
	for (size_t s = 0; s < options.lens_normal.size(); ++s)
		g.states[s].lens_normal = options.lens_normal[s];
	Initialise(task, g);
	bool regular = Fit(task, FIRST_MODEL_SIGMA, g);
	if (regular)
		regular = Fit(task, ModelSigma(task, g), g);
	if (!regular || !(g.w_px_sigma < 0.03 * g.w_px))
		throw Refused("the photographs do not determine the image distance: the board is (nearly) parallel to the sensor in all of them. "
			"Photograph it inclined by 20 to 45 degrees, in three or more directions");
	MeasureReprojection(task, g);
	return g;
}

std::optional<Geometry> SolveGeometryIfDetermined(const Task& task, const GeometryOptions& options)
{
	return IfAnswered([&] { return SolveGeometry(task, options); });
}

Geometry SelectGeometry(const Task& task, GeometryOptions options)
{
	options.terms = 0;
	Geometry best = SolveGeometry(task, options);
	if (!options.may_distort)
		return best;
	for (const int terms : { 1, 2, 4, 5 })
	{
		options.terms = terms;
		const std::optional<Geometry> next = SolveGeometryIfDetermined(task, options);
		if (!next || next->rms > 0.985 * best.rms || !IsDistorted(*next))
			break;
		best = *next;
	}
	return best;
}

}
