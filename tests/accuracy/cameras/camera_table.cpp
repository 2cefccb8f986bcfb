// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The table of cameras.

#include "simulated_camera.h"

#include <cmath>
#include <random>

namespace cameras
{

namespace
{

using tiltcal::Board;
using tiltcal::TargetKind;

/// Its size is chosen with the pictures.
Board Unsized(TargetKind kind, int columns, int rows)
{
	Board board;
	board.kind = kind;
	board.columns = columns;
	board.rows = rows;
	return board;
}

Board Squares(int columns, int rows) { return Unsized(TargetKind::CHECKERBOARD, columns, rows); }
Board Circles(int columns, int rows) { return Unsized(TargetKind::CIRCLES, columns, rows); }

const double FAR_AWAY = HUGE_VAL;

}

std::vector<Camera> AllCameras()
{
	// Sensors of 36 x 24 mm unless said otherwise, at the megapixels of the name's place in the table.
	return {
		{ "17 mm wide", 17, 4, 300, 1800, 1200, 0.02, Squares(12, 9), { { 3, 0 }, { 4, 120 } }, -0.08, false, 5 },
		{ "24 mm wide, shared poses", 24, 3.5, 400, 1800, 1200, 0.02, Squares(12, 9), { { 2, 45 }, { 2, -135 } }, -0.05, true, 6 },
		{ "45 mm, little tilt", 45, 2.8, 700, 1800, 1200, 0.02, Squares(12, 9), { { 0.3, 200 }, { 1, 70 } }, 0, false, 5 },
		{ "45 mm, 7x5 board", 45, 2.8, 500, 1500, 1000, 0.024, Squares(7, 5), { { 5, 0 } }, 0, false, 6 },
		{ "90 mm at 0.6 m", 90, 4, 600, 2400, 1600, 0.015, Squares(14, 9), { { 6, 30 }, { 8, -90 } }, 0, false, 5 },
		{ "90 mm, 12 degrees", 90, 8, 1200, 1800, 1200, 0.02, Squares(12, 9), { { 12, 90 } }, 0, false, 6 },
		{ "135 mm, 30x20 board", 135, 5.6, 2000, 2400, 1600, 0.015, Squares(30, 20), { { 4, 180 } }, 0.03, false, 5 },
		{ "macro, 45 mm at 0.15 m", 45, 8, 150, 1800, 1200, 0.02, Squares(12, 9), { { 4, 10 } }, 0, false, 6 },
		{ "45 mm at infinity", 45, 2.8, FAR_AWAY, 1800, 1200, 0.02, Squares(12, 9), { { 1, 0 } }, 0, false, 6 },
		{ "45 mm beyond infinity", 45, 2.8, -20000, 1800, 1200, 0.02, Squares(12, 9), { { 4, 60 } }, 0, false, 6 },
		{ "machine vision, 25 mm f/1.8", 25, 1.8, 400, 2048, 1536, 0.00345, Squares(12, 9), { { 3, 90 }, { 5, 0 } }, 0, false, 5 },
		{ "machine vision, 0.3 megapixels", 16, 2.8, 300, 640, 480, 0.0074, Squares(9, 7), { { 4, 0 } }, 0, false, 6 },
		{ "phone, 5 mm f/1.8", 5, 1.8, 120, 4000, 3000, 0.0014, Squares(12, 9), { { 3, -30 } }, 0, false, 4 },
		{ "circles, 50 mm", 50, 4, 700, 1800, 1200, 0.02, Circles(11, 8), { { 4, 60 } }, 0, false, 5 },
		{ "60 megapixels, 90 mm", 90, 5.6, 1000, 9504, 6336, 0.00376, Squares(14, 10), { { 3, 0 } }, 0, false, 4 },
	};
}

Camera Quick(Camera c, double megapixels)
{
	c.lens_points = 200;
	const double pixels = std::sqrt(1e6 * megapixels / (double(c.width) * c.height));
	if (pixels >= 1)
		return c;
	const double wide = c.width * c.pitch;
	c.width = int(std::lround(c.width * pixels));
	c.height = int(std::lround(c.height * pixels));
	c.pitch = wide / c.width;
	return c;
}

Camera RandomCamera(unsigned seed)
{
	std::mt19937 random(seed * 7919u + 17);
	const auto between = [&random](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
	const auto one_of = [&random](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
	Camera c;
	c.name = "random " + std::to_string(seed);
	// Small pictures, so that many can be tried; what matters is lens against sensor against board.
	const struct { int width, height; } sizes[] = { { 640, 480 }, { 900, 600 }, { 800, 800 } };
	const auto& size = sizes[one_of(3)];
	c.width = size.width;
	c.height = size.height;
	const double sensor = std::exp(between(std::log(5.0), std::log(36.0)));   // width, mm
	c.pitch = sensor / c.width;
	const double view = between(0.6, 3.8);                                    // focal length in widths of the sensor
	c.focal_length = view * sensor;
	c.focus_distance = c.focal_length * std::exp(between(std::log(6.0), std::log(40.0)));
	const Board boards[] = { Squares(7, 5), Squares(9, 7), Squares(12, 9), Squares(10, 7) };
	c.board = boards[one_of(4)];
	c.f_number = std::exp(between(std::log(1.8), std::log(8.0)));
	const double tilt = std::exp(between(std::log(0.3), std::log(8.0)));
	c.tilts = { { tilt, between(-180, 180) } };
	c.k1 = one_of(2) ? between(-0.1, 0.1) : 0;
	c.shared_poses = one_of(3) == 0;
	c.photos = 4 + one_of(3);
	return c;
}

}
