// SPDX-License-Identifier: AGPL-3.0-or-later

#include "simulated_camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace cameras
{

Eigen::Vector2d MiddleOf(const tiltcal::Board& b)
{
	if (b.IsCheckerboard())
		return 0.5 * b.square_mm * Eigen::Vector2d(b.columns - 2, b.rows - 2);
	return 0.5 * b.square_mm * Eigen::Vector2d(b.CircleColumn(b.columns - 1, b.rows - 1), b.rows - 1);
}

namespace
{

using Random = std::mt19937;
using synthetic::Scene;

const double RADIANS = M_PI / 180;

double Between(Random& random, double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); }

/// Where the boards stand: at the plane of focus, or for a focus far away as near as the blur allows.
double UsualDistance(const Camera& c)
{
	const double far_away = 60 * c.focal_length;
	return c.focus_distance > 0 ? std::min(c.focus_distance, far_away) : far_away;
}

Scene SceneOf(const Camera& c, double tilt, double direction)
{
	Scene scene;
	scene.width = c.width;
	scene.height = c.height;
	scene.w_px = c.ImageDistance() / c.pitch;
	scene.aperture = c.Aperture();
	scene.lens_normal = synthetic::LensNormal(tilt, direction);
	scene.k1 = c.k1;
	scene.lens_points = c.lens_points;
	for (const synthetic::Rim& rim : c.rims)
		scene.rims.push_back({ rim.radius * c.Aperture() / 2, rim.distance * c.focal_length });
	synthetic::FocusOn(scene, c.ImageDistance(), c.focal_length);
	return scene;
}

/// What a photographer sees of a pose in the finder: whether the board is in the picture, and its blur in squares.
struct Look
{
	bool inside = true;
	double least = 1e9, most = 0, square_px = 1e9;
};

Look LookAt(const Scene& scene, const tiltcal::Board& board)
{
	Look look;
	const double s = board.square_mm;
	// Squares: from the outline to the outline; circles: the outermost ones.
	const double first = board.IsCheckerboard() ? -1 : -0.8;
	const double columns = board.IsCheckerboard() ? board.columns - 1 : board.CircleColumn(board.columns - 1, board.rows - 1) + 0.8;
	const double rows = board.IsCheckerboard() ? board.rows - 1 : board.rows - 0.2;
	std::vector<Eigen::Vector2d> places;
	for (int i = 0; i <= 4; ++i)
		for (int j = 0; j <= 4; ++j)
			places.emplace_back(s * (first + (columns - first) * i / 4.0), s * (first + (rows - first) * j / 4.0));
	// Whether it is in the picture first: that is quickly seen, and most poses are not.
	for (const Eigen::Vector2d& at : places)
	{
		const double x = at.x(), y = at.y();
		const Eigen::Vector3d P = scene.camera_from_board * Eigen::Vector3d(x, y, 0) + scene.origin;
		if (!(P.z() > 0.05 * scene.origin.norm()))
			return { false };
		const Eigen::Vector2d p = synthetic::PixelOf(scene, x, y);
		const double margin = 0.01 * scene.width;
		if (p.x() < margin || p.y() < margin || p.x() > scene.width - 1 - margin || p.y() > scene.height - 1 - margin)
			return { false };
	}
	for (const Eigen::Vector2d& at : places)
	{
		const double x = at.x(), y = at.y();
		const Eigen::Vector2d p = synthetic::PixelOf(scene, x, y);
		const double side = std::min((synthetic::PixelOf(scene, x + s, y) - p).norm(), (synthetic::PixelOf(scene, x, y + s) - p).norm());
		const double blur = std::max(synthetic::BlurRadius(scene, x, y, 1, 0), synthetic::BlurRadius(scene, x, y, 0, 1));
		look.square_px = std::min(look.square_px, side);
		look.least = std::min(look.least, blur / side);
		look.most = std::max(look.most, blur / side);
	}
	return look;
}

/// Turns the board about its own middle, `middle` mm on it, and puts that on the ray of pixel `at`, `distance` deep.
void Place(Scene& scene, const Eigen::Vector2d& middle, const Eigen::Matrix3d& turn, const Eigen::Vector2d& at, double distance)
{
	scene.camera_from_board = turn;
	const Eigen::Vector3d ray((at.x() - 0.5 * (scene.width - 1)) / scene.w_px, (at.y() - 0.5 * (scene.height - 1)) / scene.w_px, 1);
	scene.origin = distance * ray - turn * Eigen::Vector3d(middle.x(), middle.y(), 0);
}


/// A board that fills as much of the picture at the usual distance as it should.
void SizeBoard(Camera& c)
{
	const double wide = c.board.IsCheckerboard() ? c.board.columns : c.board.CircleColumn(c.board.columns - 1, 1) + 2, high = c.board.IsCheckerboard() ? c.board.rows : c.board.rows + 1;
	const double scale = UsualDistance(c) * c.pitch / c.ImageDistance();
	c.board.square_mm = c.fill * scale * std::min(c.width / wide, c.height / high);
	if (!c.board.IsCheckerboard())
		c.board.circle_diameter_mm = 0.55 * c.board.CirclePitch() * c.board.square_mm;
}

/// One pose of this state: drawn until the board is in the picture and its blur spans from nearly sharp to what can be measured.
bool DrawPose(const Camera& c, Random& random, const std::vector<Scene>& states, std::vector<Scene>& out)
{
	const Eigen::Vector3d front = Eigen::Vector3d::UnitZ();
	for (int attempt = 0; attempt < 4000; ++attempt)
	{
		// The tilted state's plane of focus may be far from parallel to the sensor: a board between the two.
		Eigen::Vector3d plane = states.back().focus_normal;
		if (plane.z() < 0)
			plane = -plane;
		const Eigen::Vector3d normal = (front + Between(random, 0, 1.2) * (plane - front)).normalized();
		const double incline = Between(random, 15, 40) * RADIANS, direction = Between(random, 0, 2 * M_PI);
		const Eigen::Matrix3d turn = (Eigen::Quaterniond::FromTwoVectors(front, normal) * Eigen::AngleAxisd(incline, Eigen::Vector3d(std::cos(direction), std::sin(direction), 0))
			* Eigen::AngleAxisd(Between(random, -10, 10) * RADIANS, front)).toRotationMatrix();
		// Steeper than 60 degrees nobody holds a board.
		if (turn(2, 2) < 0.5)
			continue;
		const Eigen::Vector2d at(c.width * Between(random, 0.4, 0.6), c.height * Between(random, 0.4, 0.6));
		const double distance = UsualDistance(c) * Between(random, 0.85, 1.3);
		bool good = true;
		out.clear();
		for (const Scene& state : states)
		{
			Scene scene = state;
			Place(scene, MiddleOf(c.board), turn, at, distance);
			const Look look = LookAt(scene, c.board);
			const double most = c.board.IsCheckerboard() ? 0.4 : 0.2;
			good = look.inside && look.most < most && look.square_px > 14 && (attempt > 2000 || (look.least < 0.08 && look.most * look.square_px > 2));
			if (!good)
				break;
			out.push_back(scene);
		}
		if (good)
			return true;
	}
	return false;
}

}

double Camera::ImageDistance() const
{
	return 1 / (1 / focal_length - 1 / focus_distance);
}

std::vector<std::vector<Scene>> PhotographAll(Camera& c, unsigned seed)
{
	Random random(seed);
	if (c.board.square_mm == 0)
		SizeBoard(c);
	std::vector<Scene> states{ SceneOf(c, 0, 0) };
	for (const auto& [tilt, direction] : c.tilts)
		states.push_back(SceneOf(c, tilt, direction));
	std::vector<std::vector<Scene>> all(states.size());
	std::vector<Scene> poses;
	for (int k = 0; k < c.photos; ++k)
		if (c.shared_poses)
		{
			if (!DrawPose(c, random, states, poses))
				throw std::runtime_error(c.name + ": no pose of the board has a blur that can be measured in every state");
			for (size_t s = 0; s < states.size(); ++s)
				all[s].push_back(poses[s]);
		}
		else
			for (size_t s = 0; s < states.size(); ++s)
			{
				if (!DrawPose(c, random, { states[s] }, poses))
					throw std::runtime_error(c.name + ": no pose of the board has a blur that can be measured");
				all[s].push_back(poses[0]);
			}
	return all;
}

}
