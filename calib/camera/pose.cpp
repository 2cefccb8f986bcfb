// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose.h"

#include "lens/angles.h"
#include "model/projection.h"
#include <tiltcal/error.h>
#include "camera/pose_fit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace tiltcal
{

namespace
{

const double DEGREES = tilt_lens::DegreesPerRadian;

/// Nobody measures points in a photograph better; two poses that differ by less cannot be told apart.
/// Fewer than 6 points say nothing about their own noise: they may have been clicked by hand.
const double LEAST_NOISE_PX = 0.1, LEAST_NOISE_OF_FEW_PX = 0.5;
const size_t ENOUGH_FOR_SIGMA = 6;

/// Scattered by more than this share of the picture's width, these are not the points.
const double WORST_RMS_SHARE = 0.01;

/// A point is called a mistake beyond so many robust standard deviations, and never below a pixel:
/// less may be what the calibrated lens leaves over.
const double FAR_OFF_SIGMAS = 6, FAR_OFF_PX = 1;

void RefuseNowhere(const std::vector<PosePoint>& points, const std::string& file)
{
	for (const PosePoint& p : points)
		if (p.placed == Placed::NOWHERE)
			throw Refused(fmt::format("{}:{}: the point has no pixel; give `photo`, so that it can be looked for there", file, p.line));
}

void RefuseFew(const std::vector<PosePoint>& points, const std::string& file)
{
	std::set<std::tuple<double, double, double>> places;
	for (const PosePoint& p : points)
		places.insert({ p.world.x, p.world.y, p.world.z });
	if (places.size() < 4)
		throw Refused(fmt::format("{}: {} different points; a pose needs at least 4, and 6 for a sigma", file, places.size()));
}

/// Points within a thousandth of their length of one line leave the turn about it open.
void RefuseLine(const PoseFit& fit, const std::string& file)
{
	if (!(fit.Extents()[1] > 1e-3 * fit.Extents()[0]))
		throw Refused(fmt::format("{}: the points lie on one line, about which the camera could turn: add points beside it", file));
}

[[noreturn]] void RefuseBehind(const PoseFit& fit, const std::string& file)
{
	const std::vector<int> lines = fit.LinesBehind();
	throw Refused(fmt::format("{}: no camera has all these points before it{}; check the world's axes and which pixel belongs to which point", file,
		lines.empty() ? "" : fmt::format(": line {} would lie behind the camera", fmt::join(lines, ", "))));
}

double Rms(double misfit, size_t n) { return std::sqrt(misfit / static_cast<double>(n)); }

/// The same points in a mirrored world.
std::vector<PosePoint> Mirrored(std::vector<PosePoint> points)
{
	for (PosePoint& p : points)
		p.world.x = -p.world.x;
	return points;
}

/// Fits the mirrored world too, and refuses when it explains the picture far better: points in
/// one plane fit both ways and pass.
void RefuseMirrored(const StateCamera& camera, const std::vector<PosePoint>& points, const std::vector<PoseMinimum>& minima, const std::string& file, double unit_mm)
{
	double scale = 0;
	const std::vector<PoseMinimum> mirrored = PoseFit(camera, Mirrored(points), unit_mm).Minima(scale);
	if (mirrored.empty())
		return;
	const double other = Rms(mirrored[0].misfit, points.size());
	const double here = minima.empty() ? std::numeric_limits<double>::infinity() : Rms(minima[0].misfit, points.size());
	if (other <= WORST_RMS_SHARE * camera.width && here > 3 * std::max(other, LEAST_NOISE_PX))
		throw Refused(fmt::format("{}: the world is mirrored: it fits to {:.2f} px, its mirror image to {:.2f} px. POV-Ray's axes are left-handed "
			"(x right, y up, z away): swap y and z of a right-handed survey, or negate one axis", file, here, other));
}

void RefuseAmbiguous(const PoseFit& fit, const std::vector<PoseMinimum>& minima, double noise, size_t n, const std::string& file)
{
	for (size_t i = 1; i < minima.size(); ++i)
	{
		// Within three standard deviations of the likelihood ratio of one number.
		if (SamePose(minima[0], minima[i]) || minima[i].misfit - minima[0].misfit > 9 * noise * noise)
			continue;
		const auto place = [&](const PoseMinimum& m)
		{
			const Eigen::Vector3d p = fit.ToWorld(m.location);
			return fmt::format("<{:.6g}, {:.6g}, {:.6g}> ({:.3f} px)", p.x(), p.y(), p.z(), Rms(m.misfit, n));
		};
		throw Refused(fmt::format("{}: two camera places fit equally, {} and {}: points in a plane seen from afar leave this open; "
			"add points off their plane, or nearer the picture's edges", file, place(minima[0]), place(minima[i])));
	}
}

CameraPose Finish(const PoseFit& fit, const PoseMinimum& best, double scale, double noise, const std::vector<PosePoint>& points, const std::string& file)
{
	CameraPose pose;
	pose.camera_from_world = best.rotation.toRotationMatrix();
	pose.location = fit.ToWorld(best.location);
	pose.residuals = fit.Residuals(best);
	pose.misfit = best.misfit;
	pose.far_off = std::max(FAR_OFF_SIGMAS * scale, FAR_OFF_PX);
	double sum = 0;
	for (size_t i = 0; i < points.size(); ++i)
	{
		sum += pose.residuals[i].squaredNorm();
		pose.outliers += pose.residuals[i].norm() > pose.far_off * points[i].sigma;
		if (pose.residuals[i].norm() > pose.residuals[pose.worst].norm())
			pose.worst = i;
	}
	pose.rms = Rms(sum, points.size());
	Eigen::Matrix<double, 6, 6> covariance;
	if (!fit.Covariance(best, scale, covariance))
		throw Refused(fmt::format("{}: the points do not determine the camera: spread them over the picture and in depth", file));
	const Eigen::Matrix<double, 6, 1> sigma = noise * covariance.diagonal().cwiseSqrt();
	const bool enough = points.size() >= ENOUGH_FOR_SIGMA;
	const Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
	pose.rotation_sigma_deg = enough ? Eigen::Vector3d(sigma.head<3>() * DEGREES) : unknown;
	pose.location_sigma = enough ? Eigen::Vector3d(sigma.tail<3>() * fit.Spread()) : unknown;
	return pose;
}

}

bool SeenAt(const StateCamera& camera, const CameraPose& pose, const Vec3<double>& world, Point& pixel)
{
	const Eigen::Vector3d p = pose.camera_from_world * (Eigen::Vector3d(world.x, world.y, world.z) - pose.location);
	const Vec3<double> P{ p.x(), p.y(), p.z() }, n = camera.LensNormal();
	if (!(P.z > 0) || !(Dot(P, n) > 0))
		return false;
	MakePicture(camera.ImageDistancePx(), camera.distortion.data(), camera.principal_point.data(), n).Project(P, pixel.data());
	return true;
}

void RefuseOutside(const StateCamera& c, const std::vector<PosePoint>& points, const std::string& file)
{
	for (const PosePoint& p : points)
		if (p.u < -0.5 || p.v < -0.5 || p.u > c.width - 0.5 || p.v > c.height - 0.5)
			throw Refused(fmt::format("{}:{}: pixel ({:g}, {:g}) lies outside the calibrated picture of {} x {}: measure in the photograph at its full size",
				file, p.line, p.u, p.v, c.width, c.height));
}

CameraPose SolvePose(const StateCamera& camera, const std::vector<PosePoint>& points, const std::string& file, double unit_mm)
{
	RefuseNowhere(points, file);
	RefuseFew(points, file);
	RefuseOutside(camera, points, file);
	const PoseFit fit(camera, points, unit_mm);
	RefuseLine(fit, file);
	double scale = 0;
	const std::vector<PoseMinimum> minima = fit.Minima(scale);
	RefuseMirrored(camera, points, minima, file, unit_mm);
	if (minima.empty())
		RefuseBehind(fit, file);
	const PoseMinimum& best = minima[0];
	const size_t n = points.size();
	if (Rms(best.misfit, n) > WORST_RMS_SHARE * camera.width)
	{
		const CameraPose pose = Finish(fit, best, scale, 0, points, file);
		throw Refused(fmt::format("{}: no camera fits these points: {:.1f} px RMS, worst line {} ({:.1f} px); check which pixel belongs to which point",
			file, pose.rms, points[pose.worst].line, pose.residuals[pose.worst].norm()));
	}
	const double noise = std::sqrt(best.misfit / static_cast<double>(2 * n - 6));
	RefuseAmbiguous(fit, minima, std::max(noise, n < ENOUGH_FOR_SIGMA ? LEAST_NOISE_OF_FEW_PX : LEAST_NOISE_PX), n, file);
	return Finish(fit, best, scale, noise, points, file);
}

}
