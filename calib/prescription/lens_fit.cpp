// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/lens_fit.h"

#include "solve/jet_value.h"
#include "solve/least_squares.h"

#include <Eigen/Dense>
#include <ceres/autodiff_cost_function.h>
#include <ceres/manifold.h>
#include <fmt/format.h>
#include <tiltcal/error.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

using tilt_lens::Aberrations;
using tilt_lens::AberrationTerms;
using tilt_lens::PupilRay;
using tilt_lens::RealLens;

/// The ray at the height z.
template<typename T>
PupilRay<T> AtHeight(const Ray<double>& ray, const T& z)
{
	const double u = ray.direction.x / ray.direction.z, v = ray.direction.y / ray.direction.z;
	const T along = z - ray.point.z;
	return { ray.point.x + along * u, ray.point.y + along * v, T(u), T(v) };
}

/// An offset across the axis, moved along a ray of these slopes onto the sensor: right and up there.
template<typename T>
std::array<T, 2> OnSensor(const GlassFrame& frame, const T& slope_x, const T& slope_y, const T& x, const T& y)
{
	const auto along = [&](double a, double b, double n) { return slope_x * a + slope_y * b + n; };
	const T back = (x * frame.x.z + y * frame.y.z) / along(frame.x.z, frame.y.z, frame.axis.z);
	return { x * frame.x.x + y * frame.y.x - back * along(frame.x.x, frame.y.x, frame.axis.x), x * frame.x.y + y * frame.y.y - back * along(frame.x.y, frame.y.y, frame.axis.y) };
}

/// The linear part's numbers as the fit has them: focal length, magnification, heights of the pupils.
enum { FOCAL_LENGTH, MAGNIFICATION, ENTRANCE_PUPIL, EXIT_PUPIL, LINEAR_NUMBERS };

/// `glass`: etendue is conserved, as a thin lens does not.
template<typename T>
RealLens<T> MakeLens(const T* linear, const T* c, const T& radius, bool glass)
{
	RealLens<T> lens{ linear[MAGNIFICATION], T(1) / linear[FOCAL_LENGTH], {}, glass };
	std::copy(c, c + AberrationTerms, lens.aberrations.c);
	lens.aberrations.radius = radius;
	return lens;
}

template<typename T>
Aberrations<double> ValuesOf(const Aberrations<T>& a)
{
	Aberrations<double> values;
	std::transform(a.c, a.c + AberrationTerms, values.c, [](const T& c) { return ValueOf(c); });
	values.radius = ValueOf(a.radius);
	return values;
}

/// Unaberrate with derivatives: solved in plain numbers, then one Newton step with derivatives from there, which has them right
/// (the implicit function's) for a twentieth of the time.
template<typename T>
bool UnaberrateOnce(const Aberrations<T>& a, const PupilRay<T>& aberrated, PupilRay<T>& ray)
{
	const Aberrations<double> values = ValuesOf(a);
	PupilRay<double> found;
	if (!tilt_lens::Unaberrate(values, { ValueOf(aberrated.x), ValueOf(aberrated.y), ValueOf(aberrated.slope_x), ValueOf(aberrated.slope_y) }, found))
		return false;
	ray = { T(found.x), T(found.y), T(found.slope_x), T(found.slope_y) };
	const PupilRay<T> there = tilt_lens::Aberrate<true>(a, ray);
	const T error[4] = { (aberrated.x - there.x) / values.radius, (aberrated.y - there.y) / values.radius, aberrated.slope_x - there.slope_x, aberrated.slope_y - there.slope_y };
	T* const parts[4] = { &ray.x, &ray.y, &ray.slope_x, &ray.slope_y };
	for (int k = 0; k < 4; ++k)
	{
		double J[4][4], column[4] = {};
		column[k] = 1;
		tilt_lens::AberrationJacobian(values, found, J);
		tilt_lens::SolveFour(J, column);
		for (int i = 0; i < 4; ++i)
			*parts[i] += (i < 2 ? values.radius : 1) * column[i] * error[k];
	}
	return true;
}

/// How an object-side ray that is `change` off arrives by the linear part: right and up on the sensor.
std::array<double, 2> OnSensorByLinearPart(const Paraxial& p, const GlassFrame& frame, const TracedRay& ray, const PupilRay<double>& change)
{
	const PupilRay<double> seen = tilt_lens::BehindLinearLens(p.pupil_magnification, 1 / p.focal_length, change);
	const double depth = p.exit_pupil - frame.ToGlass(ray.sensor_point).z;
	return OnSensor(frame, ray.image.direction.x / ray.image.direction.z, ray.image.direction.y / ray.image.direction.z, seen.x - depth * seen.slope_x, seen.y - depth * seen.slope_y);
}

/// Where the fit starts: the map states the object-side ray, in which the numbers are linear; what they leave of it is seen through the linear part. From
/// zeros the other direction's rays may fold on their way to the answer, and the fit stops there.
void StartFromObjectSide(const std::vector<TracedRay>& rays, const std::vector<GlassFrame>& frames, const Paraxial& p, int terms, double* c)
{
	Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(terms, terms);
	Eigen::VectorXd right = Eigen::VectorXd::Zero(terms);
	const Aberrations<double> unit{ {}, p.entrance_radius };
	for (const TracedRay& ray : rays)
	{
		const GlassFrame& frame = frames[ray.state];
		const PupilRay<double> linear = tilt_lens::BeforeLinearLens(p.pupil_magnification, 1 / p.focal_length, AtHeight(ray.image, p.exit_pupil));
		PupilRay<double> truth;
		if (!tilt_lens::UprightPupil(p.pupil_magnification, 1 / p.focal_length, AtHeight(ray.object, p.entrance_pupil), truth))
			continue;
		PupilRay<double> by_c[AberrationTerms];
		tilt_lens::AberrateByCoefficients(unit, linear, by_c);
		const std::array<double, 2> off = OnSensorByLinearPart(p, frame, ray, { truth.x - linear.x, truth.y - linear.y, truth.slope_x - linear.slope_x, truth.slope_y - linear.slope_y });
		Eigen::MatrixXd by(2, terms);
		for (int k = 0; k < terms; ++k)
		{
			const std::array<double, 2> moved = OnSensorByLinearPart(p, frame, ray, by_c[k]);
			by.col(k) << moved[0], moved[1];
		}
		squares += by.transpose() * by;
		right += by.transpose() * Eigen::Vector2d(off[0], off[1]);
	}
	Eigen::Map<Eigen::VectorXd>(c, terms) = squares.completeOrthogonalDecomposition().solve(right);
}

/// Misses, with derivatives.
struct LandingError
{
	const TracedRay& ray;
	const GlassFrame& frame;
	double radius, weight;
	bool glass;

	template<typename T>
	bool operator()(const T* linear, const T* c, T* residual) const
	{
		const RealLens<T> lens = MakeLens(linear, c, T(radius), glass);
		PupilRay<T> before, object = AtHeight(ray.object, linear[ENTRANCE_PUPIL]);
		const PupilRay<T> outside = object;
		if (glass && !tilt_lens::UprightPupil(lens.pupil_magnification, lens.power, outside, object))
			return false;
		if (!UnaberrateOnce(lens.aberrations, object, before))
			return false;
		const PupilRay<T> seen = tilt_lens::BehindLinearLens(lens.pupil_magnification, lens.power, before);
		const PupilRay<T> truth = AtHeight(ray.image, linear[EXIT_PUPIL]);
		const T depth = linear[EXIT_PUPIL] - frame.ToGlass(ray.sensor_point).z;
		// Both at the height of the sensor's point; from there along the ray that the lens makes.
		const T x = seen.x - truth.x - depth * (seen.slope_x - truth.slope_x), y = seen.y - truth.y - depth * (seen.slope_y - truth.slope_y);
		const std::array<T, 2> miss = OnSensor(frame, seen.slope_x, seen.slope_y, x, y);
		residual[0] = weight * miss[0];
		residual[1] = weight * miss[1];
		return true;
	}
};

void MeasureMisses(const std::vector<TracedRay>& rays, const std::vector<GlassFrame>& frames, FittedLens& fit)
{
	std::vector<double> sum(frames.size()), count(frames.size());
	for (const TracedRay& ray : rays)
	{
		std::array<double, 2> miss;
		if (!Misses(fit, frames[ray.state], ray, miss))
			throw Refused("the function that fits this glass best folds within the picture: its aberrations are too large for it at this opening; a larger f-number may do");
		sum[ray.state] += miss[0] * miss[0] + miss[1] * miss[1];
		count[ray.state] += 1;
	}
	double all = 0;
	fit.state_rms_mm.clear();
	for (size_t s = 0; s < frames.size(); ++s)
	{
		all += sum[s];
		fit.state_rms_mm.push_back(std::sqrt(sum[s] / std::max(1.0, count[s])));
	}
	fit.rms_mm = std::sqrt(all / double(rays.size()));
}

/// Which of `count` numbers stay as they are.
ceres::Manifold* KeptFrom(int count, int first)
{
	std::vector<int> kept;
	for (int k = first; k < count; ++k)
		kept.push_back(k);
	return new ceres::SubsetManifold(count, kept);
}

}

FittedLens ParaxialLens(const Paraxial& p)
{
	FittedLens fit;
	fit.entrance_pupil = p.entrance_pupil;
	fit.exit_pupil = p.exit_pupil;
	fit.lens = { p.pupil_magnification, 1 / p.focal_length, { {}, p.entrance_radius } };
	return fit;
}

bool Misses(const FittedLens& fit, const GlassFrame& frame, const TracedRay& ray, std::array<double, 2>& offset)
{
	PupilRay<double> image;
	if (!tilt_lens::ImageSideRay(fit.lens, AtHeight(ray.object, fit.entrance_pupil), image))
		return false;
	const Vec3<double> direction = frame.DirectionToSensor({ image.slope_x, image.slope_y, 1 });
	const Vec3<double> point = frame.ToSensor({ image.x, image.y, fit.exit_pupil });
	const double along = point.z / direction.z;
	offset = { point.x - along * direction.x - ray.sensor_point.x, point.y - along * direction.y - ray.sensor_point.y };
	return std::isfinite(offset[0]) && std::isfinite(offset[1]);
}

FittedLens FitLens(const std::vector<TracedRay>& rays, const std::vector<GlassFrame>& frames, const Paraxial& p, int terms, LinearPart part)
{
	if (rays.size() < 100)
		throw Refused(fmt::format("only {} rays come through the glass: too few to learn its aberrations from", rays.size()));
	double linear[LINEAR_NUMBERS] = { p.focal_length, p.pupil_magnification, p.entrance_pupil, p.exit_pupil }, c[AberrationTerms] = {};
	FittedLens fit = ParaxialLens(p);
	if (terms > 0)
	{
		StartFromObjectSide(rays, frames, p, terms, c);
		fit.lens = MakeLens(linear, c, p.entrance_radius, true);
		// For its refusal of a start that folds.
		MeasureMisses(rays, frames, fit);
	}
	ceres::Problem problem;
	for (const TracedRay& ray : rays)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<LandingError, 2, LINEAR_NUMBERS, AberrationTerms>(
			new LandingError{ ray, frames[ray.state], p.entrance_radius, 1e3 / std::sqrt(double(rays.size())), terms > 0 }), nullptr, linear, c);
	if (terms == 0)
		problem.SetParameterBlockConstant(c);
	else if (terms < AberrationTerms)
		problem.SetManifold(c, KeptFrom(AberrationTerms, terms));
	if (part == LinearPart::PARAXIAL)
		problem.SetParameterBlockConstant(linear);
	else
		problem.SetManifold(linear, new ceres::SubsetManifold(LINEAR_NUMBERS, { MAGNIFICATION, ENTRANCE_PUPIL }));
	if (terms > 0 || part == LinearPart::FITTED)
	{
		LeastSquares how;
		how.linear_solver = ceres::DENSE_NORMAL_CHOLESKY;
		how.function_tolerance = 1e-12;
		how.iterations = 300;
		how.threads = AllThreads();
		std::string why;
		if (!SolveLeastSquares(how, problem, &why))
			throw Refused("the aberrations' fit did not converge: " + why);
	}
	fit.entrance_pupil = linear[ENTRANCE_PUPIL];
	fit.exit_pupil = linear[EXIT_PUPIL];
	fit.lens = MakeLens(linear, c, p.entrance_radius, terms > 0);
	MeasureMisses(rays, frames, fit);
	return fit;
}

}
