// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/thin_lens_picture.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <random>

namespace synthetic
{

namespace
{

const double RAD = M_PI / 180;

/// Pixel in which the lens point S shows P: the ray from S through P meets the plane of focus where the ray of the
/// lens centre in that pixel does.
Eigen::Vector2d PixelThrough(const Scene& scene, const Eigen::Vector3d& P, const Eigen::Vector3d& S)
{
	const Eigen::Vector3d ray = P - S;
	const double t = (scene.focus_point - S).dot(scene.focus_normal) / ray.dot(scene.focus_normal);
	const Eigen::Vector3d focus = S + t * ray;
	return { 0.5 * (scene.width - 1) + scene.w_px * focus.x() / focus.z(), 0.5 * (scene.height - 1) + scene.w_px * focus.y() / focus.z() };
}

Eigen::Vector3d OnBoard(const Scene& scene, double x, double y)
{
	return scene.camera_from_board * Eigen::Vector3d(x, y, 0) + scene.origin;
}

Eigen::Vector3d LensPoint(const Scene& scene, double radius, double angle)
{
	const Eigen::Vector3d a = scene.lens_normal.unitOrthogonal(), b = scene.lens_normal.cross(a);
	return 0.5 * scene.aperture * radius * (std::cos(angle) * a + std::sin(angle) * b);
}

/// Board mm from pixels through the lens point S.
cv::Matx33d Homography(const Scene& scene, const Eigen::Vector3d& S)
{
	std::vector<cv::Point2f> board, pixels;
	cv::Mat A(8, 8, CV_64F, cv::Scalar(0)), b(8, 1, CV_64F), h;
	int row = 0;
	for (const double x : { -50.0, 50.0 })
		for (const double y : { -50.0, 50.0 })
		{
			const Eigen::Vector2d p = PixelThrough(scene, OnBoard(scene, x, y), S);
			const double u[] = { p.x(), p.y(), 1, 0, 0, 0, -x * p.x(), -x * p.y() }, v[] = { 0, 0, 0, p.x(), p.y(), 1, -y * p.x(), -y * p.y() };
			for (int k = 0; k < 8; ++k)
			{
				A.at<double>(row, k) = u[k];
				A.at<double>(row + 1, k) = v[k];
			}
			b.at<double>(row) = x;
			b.at<double>(row + 1) = y;
			row += 2;
		}
	cv::solve(A, b, h);
	return { h.at<double>(0), h.at<double>(1), h.at<double>(2), h.at<double>(3), h.at<double>(4), h.at<double>(5), h.at<double>(6), h.at<double>(7), 1 };
}

float ThroughSrgb(float v)
{
	const double c = v <= 0 ? 0 : v >= 1 ? 1 : v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
	const double rounded = std::round(c * 255) / 255;
	return static_cast<float>(rounded <= 0.04045 ? rounded / 12.92 : std::pow((rounded + 0.055) / 1.055, 2.4));
}

}

Pattern Checkerboard(int columns, int rows, double s)
{
	return [=](double x, double y)
	{
		const double i = x / s + 1, j = y / s + 1;
		if (i >= 0 && j >= 0 && i < columns && j < rows)
			return (static_cast<int>(i) + static_cast<int>(j)) % 2 == 0 ? 0.05f : 0.8f;
		return i >= -1 && j >= -1 && i <= columns + 1 && j <= rows + 1 ? 0.8f : 0.3f;
	};
}

Pattern Circles(int columns, int rows, double s, double diameter, bool asymmetric)
{
	return [=](double x, double y)
	{
		const double row = std::floor(y / s + 0.5);
		// A circle reaches into the rows next to its own when it is larger than a spacing; none does in these pictures.
		if (row >= 0 && row < rows)
		{
			const double step = asymmetric ? 2 * s : s, first = asymmetric && static_cast<int>(row) % 2 == 1 ? s : 0;
			const double i = std::floor((x - first) / step + 0.5), dx = x - first - i * step, dy = y - row * s;
			if (i >= 0 && i < columns && dx * dx + dy * dy < 0.25 * diameter * diameter)
				return 0.05f;
		}
		const double margin = 0.5 * (diameter + s), width = asymmetric ? (2 * columns - 1) * s : (columns - 1) * s;
		return x >= -margin && y >= -margin && x <= width + margin && y <= (rows - 1) * s + margin ? 0.8f : 0.3f;
	};
}

cv::Mat TakePicture(const Scene& scene, const Pattern& pattern)
{
	std::vector<cv::Matx33d> homographies;
	const int n = scene.lens_points;
	// Fermat's spiral covers the disc evenly.
	for (int k = 0; k < n; ++k)
		homographies.push_back(Homography(scene, LensPoint(scene, std::sqrt((k + 0.5) / n), k * 2.399963229728653)));
	cv::Mat picture(scene.height, scene.width, CV_32FC1);
	cv::parallel_for_(cv::Range(0, scene.height), [&](const cv::Range& range)
	{
		for (int y = range.start; y < range.end; ++y)
			for (int x = 0; x < scene.width; ++x)
			{
				double sum = 0;
				for (int k = 0; k < n; ++k)
				{
					// Low-discrepancy points of the pixel (R2 sequence), begun elsewhere in every pixel.
					const double start = 0.5 + x * 0.7548776662 + y * 0.5698402910;
					const double u = start + k * 0.7548776662466927, v = start * 1.7 + k * 0.5698402909980532;
					const double px = x + u - std::floor(u) - 0.5, py = y + v - std::floor(v) - 0.5;
					const cv::Matx33d& H = homographies[static_cast<size_t>(k)];
					const double z = H(2, 0) * px + H(2, 1) * py + 1;
					sum += pattern((H(0, 0) * px + H(0, 1) * py + H(0, 2)) / z, (H(1, 0) * px + H(1, 1) * py + H(1, 2)) / z);
				}
				const double dx = (x + 0.5) / scene.width - 0.5, dy = (y + 0.5) / scene.height - 0.5;
				picture.at<float>(y, x) = static_cast<float>(sum / n * (1 - (1 - 1 / scene.vignetting) * 2 * (dx * dx + dy * dy)));
			}
	});
	std::mt19937 random(scene.seed);
	std::normal_distribution<float> normal(0, static_cast<float>(std::max(scene.noise, 1e-9)));
	for (int y = 0; y < scene.height; ++y)
		for (int x = 0; x < scene.width; ++x)
		{
			float& v = picture.at<float>(y, x);
			v += normal(random);
			if (scene.eight_bit)
				v = ThroughSrgb(v);
		}
	return picture;
}

Eigen::Vector2d PixelOf(const Scene& scene, double x, double y)
{
	return PixelThrough(scene, OnBoard(scene, x, y), Eigen::Vector3d::Zero());
}

double BlurRadius(const Scene& scene, double x, double y, double nx, double ny)
{
	double least = 1e30, most = -1e30;
	// 720 points of the rim leave out 1e-5 of the width.
	for (int k = 0; k < 720; ++k)
	{
		const Eigen::Vector2d p = PixelThrough(scene, OnBoard(scene, x, y), LensPoint(scene, 1, k * M_PI / 360));
		least = std::min(least, p.x() * nx + p.y() * ny);
		most = std::max(most, p.x() * nx + p.y() * ny);
	}
	return 0.5 * (most - least);
}

Eigen::Vector3d LensNormal(double tilt, double direction)
{
	const double t = tilt * M_PI / 180, phi = direction * M_PI / 180;
	return { -std::sin(t) * std::sin(phi), std::sin(t) * std::cos(phi), std::cos(t) };
}

void FocusOn(Scene& scene, double w, double f)
{
	Eigen::Vector3d seen[3];
	int k = 0;
	for (const auto& [x, y] : { std::pair{ 0.0, 0.0 }, std::pair{ 10.0, 0.0 }, std::pair{ 0.0, 10.0 } })
	{
		const Eigen::Vector3d X(x, y, -w);
		const double image = -X.dot(scene.lens_normal);
		seen[k++] = -X * (1 / (1 / f - 1 / image) / image);
	}
	scene.focus_point = seen[0];
	scene.focus_normal = (seen[1] - seen[0]).cross(seen[2] - seen[0]).normalized();
}

void Aim(Scene& scene, double x, double y, double distance, double incline, double direction, double turn)
{
	const Eigen::Vector3d axis(std::cos(direction * RAD), std::sin(direction * RAD), 0);
	scene.camera_from_board = (Eigen::AngleAxisd(incline * RAD, axis) * Eigen::AngleAxisd(turn * RAD, Eigen::Vector3d::UnitZ())).toRotationMatrix();
	scene.origin = Eigen::Vector3d(0, 0, distance) - scene.camera_from_board * Eigen::Vector3d(x, y, 0);
}

}
