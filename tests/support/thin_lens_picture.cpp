// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/thin_lens_picture.h"

#include "support/srgb.h"

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

/// Whether the rims let the ray through S pass that shows P in the camera's direction `v`.
bool PassesRims(const Scene& scene, const Eigen::Vector3d& P, const Eigen::Vector3d& S, const Eigen::Vector3d& v)
{
	for (const Rim& rim : scene.rims)
	{
		const Eigen::Vector3d ray = (rim.distance > 0 ? P : Eigen::Vector3d(-scene.w / v.z() * v)) - S;
		const Eigen::Vector3d at = S + rim.distance / ray.dot(scene.lens_normal) * ray;
		if ((at - rim.distance * scene.lens_normal).norm() > rim.radius)
			return false;
	}
	return true;
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

/// Board point of a pixel's place.
Eigen::Vector2d Through(const cv::Matx33d& H, const Eigen::Vector2d& p)
{
	const double z = H(2, 0) * p.x() + H(2, 1) * p.y() + 1;
	return { (H(0, 0) * p.x() + H(0, 1) * p.y() + H(0, 2)) / z, (H(1, 0) * p.x() + H(1, 1) * p.y() + H(1, 2)) / z };
}

/// The camera's direction in pixel p, and back.
Eigen::Vector3d DirectionOf(const Scene& scene, const Eigen::Vector2d& p)
{
	return { (p.x() - 0.5 * (scene.width - 1)) / scene.w_px, (p.y() - 0.5 * (scene.height - 1)) / scene.w_px, 1 };
}

Eigen::Vector2d PixelOf(const Scene& scene, const Eigen::Vector3d& v)
{
	return { 0.5 * (scene.width - 1) + scene.w_px * v.x() / v.z(), 0.5 * (scene.height - 1) + scene.w_px * v.y() / v.z() };
}

/// Moves a direction about the lens's axis: its distance from the axis over that along it becomes `radius` of what it was.
template<typename Radius>
Eigen::Vector2d MovedAboutLensAxis(const Scene& scene, const Eigen::Vector2d& p, const Radius& radius)
{
	const Eigen::Vector3d v = DirectionOf(scene, p), along = v.dot(scene.lens_normal) * scene.lens_normal, across = v - along;
	const double r = across.norm() / along.norm();
	return r > 0 ? PixelOf(scene, Eigen::Vector3d(along + across * (radius(r) / r))) : p;
}

/// Where a lens without distortion would show what pixel p shows.
Eigen::Vector2d Undistorted(const Scene& scene, const Eigen::Vector2d& p)
{
	if (scene.k1 == 0)
		return p;
	return MovedAboutLensAxis(scene, p, [&](double distorted)
	{
		double r = distorted;
		for (int k = 0; k < 20; ++k)
			r -= (r * (1 + scene.k1 * r * r) - distorted) / (1 + 3 * scene.k1 * r * r);
		return r;
	});
}

Eigen::Vector2d Distorted(const Scene& scene, const Eigen::Vector2d& p)
{
	if (scene.k1 == 0)
		return p;
	return MovedAboutLensAxis(scene, p, [&](double r) { return r * (1 + scene.k1 * r * r); });
}

const int TURNS = 7;
const int RIM = 8;   // points of the lens's rim that bound what a pixel sees

/// A point of the lens, mm, and the picture that a pinhole there takes: board mm from pixels.
struct Pinhole
{
	Eigen::Vector3d point;
	cv::Matx33d board_from_pixel;
};

/// Mean over the lens and the pixel; where both see one shade only and no rim is near, that shade.
double LightOfPixel(const Scene& scene, const Pattern& pattern, const std::vector<Pinhole>& inside, const std::vector<cv::Matx33d>& rim, int x, int y)
{
	const Eigen::Vector2d middle = Undistorted(scene, { x, y });
	const Eigen::Vector2d by_x = Undistorted(scene, { x + 1.0, y }) - middle, by_y = Undistorted(scene, { x, y + 1.0 }) - middle;
	if (pattern.clearance && scene.rims.empty())
	{
		const Eigen::Vector2d seen = Through(inside[0].board_from_pixel, middle);
		double reach = 0;
		for (const cv::Matx33d& H : rim)
			reach = std::max(reach, (Through(H, middle) - seen).norm());
		const double pixel = (Through(inside[0].board_from_pixel, middle + by_x) - seen).norm() + (Through(inside[0].board_from_pixel, middle + by_y) - seen).norm();
		// Eight points of an ellipse miss 8 % of its half axis.
		if (pattern.clearance(seen.x(), seen.y()) > 1.15 * reach + pixel)
			return pattern.light(seen.x(), seen.y());
	}
	double sum = 0;
	// Low-discrepancy points of the pixel (R2 sequence), begun elsewhere in every pixel.
	const double start = 0.5 + x * 0.7548776662 + y * 0.5698402910;
	for (size_t k = 0; k < inside.size(); ++k)
	{
		const double u = start + double(k) * 0.7548776662466927, v = start * 1.7 + double(k) * 0.5698402909980532;
		const Eigen::Vector2d p = middle + (u - std::floor(u) - 0.5) * by_x + (v - std::floor(v) - 0.5) * by_y, at = Through(inside[k].board_from_pixel, p);
		if (scene.rims.empty() || PassesRims(scene, OnBoard(scene, at.x(), at.y()), inside[k].point, DirectionOf(scene, p)))
			sum += pattern.light(at.x(), at.y());
	}
	return sum / double(inside.size());
}

}

Pattern Checkerboard(int columns, int rows, double s)
{
	const auto light = [=](double x, double y)
	{
		const double i = x / s + 1, j = y / s + 1;
		if (i >= 0 && j >= 0 && i < columns && j < rows)
			return (static_cast<int>(i) + static_cast<int>(j)) % 2 == 0 ? 0.05f : 0.8f;
		return i >= -1 && j >= -1 && i <= columns + 1 && j <= rows + 1 ? 0.8f : 0.3f;
	};
	// Every change lies on a line of the lattice, and none beyond the white around the squares.
	const auto clearance = [=](double x, double y)
	{
		const double i = x / s + 1, j = y / s + 1;
		if (i < -2 || j < -2 || i > columns + 2 || j > rows + 2)
			return s;
		return s * std::min(std::abs(i - std::round(i)), std::abs(j - std::round(j)));
	};
	return { light, clearance };
}

Pattern Circles(int columns, int rows, double s, double diameter, bool asymmetric)
{
	const auto light = [=](double x, double y)
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
	return { light };
}

cv::Mat TakePicture(const Scene& scene, const Pattern& pattern)
{
	// Fermat's spiral covers the disc evenly; turned from pixel to pixel, so that its grain is not the same along an edge.
	const int n = scene.lens_points;
	std::vector<std::vector<Pinhole>> inside(TURNS);
	for (int turn = 0; turn < TURNS; ++turn)
		for (int k = 0; k < n; ++k)
		{
			const Eigen::Vector3d S = LensPoint(scene, std::sqrt((k + 0.5) / n), k * 2.399963229728653 + turn * 2 * M_PI / TURNS);
			inside[size_t(turn)].push_back({ S, Homography(scene, S) });
		}
	std::vector<cv::Matx33d> rim;
	for (int k = 0; k < RIM; ++k)
		rim.push_back(Homography(scene, LensPoint(scene, 1, k * 2 * M_PI / RIM)));
	cv::Mat picture(scene.height, scene.width, CV_32FC1);
	cv::parallel_for_(cv::Range(0, scene.height), [&](const cv::Range& range)
	{
		for (int y = range.start; y < range.end; ++y)
			for (int x = 0; x < scene.width; ++x)
			{
				const double dx = (x + 0.5) / scene.width - 0.5, dy = (y + 0.5) / scene.height - 0.5;
				picture.at<float>(y, x) = static_cast<float>(LightOfPixel(scene, pattern, inside[size_t((3 * x + 5 * y) % TURNS)], rim, x, y) * (1 - (1 - 1 / scene.vignetting) * 2 * (dx * dx + dy * dy)));
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
	return Distorted(scene, PixelThrough(scene, OnBoard(scene, x, y), Eigen::Vector3d::Zero()));
}

double BlurRadius(const Scene& scene, double x, double y, double nx, double ny)
{
	double least = 1e30, most = -1e30;
	// 720 points of the rim leave out 1e-5 of the width.
	for (int k = 0; k < 720; ++k)
	{
		const Eigen::Vector2d p = Distorted(scene, PixelThrough(scene, OnBoard(scene, x, y), LensPoint(scene, 1, k * M_PI / 360)));
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
	scene.w = w;
	Eigen::Vector3d seen[3];
	int k = 0;
	for (const auto& [x, y] : { std::pair{ 0.0, 0.0 }, std::pair{ 10.0, 0.0 }, std::pair{ 0.0, 10.0 } })
	{
		const Eigen::Vector3d X(x, y, -w);
		const double image = -X.dot(scene.lens_normal);
		// At infinity: a million kilometres away.
		const double inverse = 1 / f - 1 / image;
		seen[k++] = -X * (1 / (std::abs(inverse) < 1e-12 ? 1e-12 : inverse) / image);
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
