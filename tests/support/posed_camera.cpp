// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/posed_camera.h"

#include "camera/opencv_yaml.h"

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

#include <random>

using namespace tiltcal;
using Eigen::Vector3d;

StateCamera TiltedCamera()
{
	StateCamera c;
	c.state = "plus8";
	c.width = 1800;
	c.height = 1200;
	c.pitch_mm = 0.02;
	c.image_distance_mm = 48.32;
	c.principal_point = { 911.7, 588.3 };
	c.distortion = { -0.09, 0.12, 0.0013, -0.0021, 0 };
	c.lens_tilt_deg = 8;
	c.tilt_direction_deg = 40;
	return c;
}

PosedScene LookAt(const Vector3d& location, const Vector3d& at)
{
	const Vector3d forward = (at - location).normalized();
	const Vector3d right = Vector3d::UnitY().cross(forward).normalized();
	Eigen::Matrix3d rows;
	rows << right.transpose(), forward.cross(right).transpose(), forward.transpose();
	return { Eigen::AngleAxisd(0.35, Vector3d::UnitZ()).toRotationMatrix() * rows, location };
}

std::vector<PosePoint> Photographed(const StateCamera& camera, const PosedScene& scene, const std::vector<Vector3d>& world, double noise, unsigned seed)
{
	const OpenCvCamera o = ToOpenCv(camera);
	const cv::Matx33d K(o.fx, 0, o.centre[0], 0, o.fy, o.centre[1], 0, 0, 1);
	const std::vector<double> coefficients{ o.distortion[0], o.distortion[1], o.distortion[2], o.distortion[3], o.distortion[4], 0, 0, 0, 0, 0, 0, 0, o.tau_x, o.tau_y };
	const Eigen::Matrix3d opencv_from_world = OpenCvFromCamera(camera.LensNormal()) * scene.camera_from_world;
	std::mt19937 random(seed);
	std::normal_distribution<double> gauss(0, 1);
	std::vector<PosePoint> points;
	for (const Vector3d& X : world)
	{
		const Vector3d p = opencv_from_world * (X - scene.location);
		std::vector<cv::Point2d> pixel;
		cv::projectPoints(std::vector<cv::Point3d>{ { p.x(), p.y(), p.z() } }, cv::Vec3d(), cv::Vec3d(), K, coefficients, pixel);
		points.push_back({ pixel[0].x + noise * gauss(random), pixel[0].y + noise * gauss(random), { X.x(), X.y(), X.z() }, static_cast<int>(points.size()) + 2 });
	}
	return points;
}

double DegreesBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
	return Eigen::AngleAxisd(a * b.transpose()).angle() * 180 / 3.14159265358979323846;
}
