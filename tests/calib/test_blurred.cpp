// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Corners and blur widths of strongly blurred checkerboards (blurred_checker.h), against pictures that are the mean of pinhole
// pictures (thin_lens_picture.h).

#include "blurred_checker.h"
#include "detect.h"
#include "error.h"
#include "measure.h"
#include "thin_lens_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace
{

using namespace tiltcal;
using namespace synthetic;

const double SQUARE = 25;

struct Errors
{
	double corner = 0, corner_sigmas = 0;   // RMS: px, and in units of sigma
	double blur = 0, blur_sigmas = 0;       // RMS of the radius: px, sigma
	double blur_mean = 0;                   // mean error of the radius, px
	size_t edges = 0, dropped = 0;
	double ratio = 0;                       // mean
};

Errors Measure(const Scene& scene, bool any = true)
{
	const Board board = ParseBoard("12x9", SQUARE);
	const cv::Mat picture = TakePicture(scene, Checkerboard(12, 9, SQUARE));
	Photo photo;
	photo.file = "synthetic";
	photo.corners = DetectCorners(picture, board, { any }, photo.file);
	MeasureEdges(picture, board, photo);
	Errors e;
	for (const Corner& c : photo.corners)
	{
		const Eigen::Vector2d d = Eigen::Vector2d(c.x, c.y) - PixelOf(scene, c.column * SQUARE, c.row * SQUARE);
		e.corner += d.squaredNorm();
		e.corner_sigmas += d.squaredNorm() / (2 * c.sigma * c.sigma);
	}
	for (const Edge& k : photo.edges)
	{
		const double nx = k.nx - k.slope * k.ny, ny = k.ny + k.slope * k.nx, length = std::hypot(nx, ny);
		const double d = 0.5 * k.blur - BlurRadius(scene, k.board_column * SQUARE, k.board_row * SQUARE, nx / length, ny / length);
		e.blur += d * d;
		e.blur_mean += d;
		e.blur_sigmas += std::pow(2 * d / k.blur_sigma, 2);
		e.ratio += k.BlurRatio();
	}
	const double n = double(photo.corners.size()), m = double(photo.edges.size());
	e.edges = photo.edges.size();
	e.dropped = size_t(photo.edges_dropped);
	e.corner = std::sqrt(e.corner / n);
	e.corner_sigmas = std::sqrt(e.corner_sigmas / n);
	e.blur = std::sqrt(e.blur / m);
	e.blur_mean /= m;
	e.blur_sigmas = std::sqrt(e.blur_sigmas / m);
	e.ratio /= m;
	std::printf("ratio %.3f corners %.3f px (%.2f sigma), blur radius %.3f px RMS (%.2f sigma), mean %+.3f, %zu edges, %zu dropped\n",
		e.ratio, e.corner, e.corner_sigmas, e.blur, e.blur_sigmas, e.blur_mean, e.edges, e.dropped);
	return e;
}

/// The board in front of the plane of focus so that its blur radius is `ratio` of a square of 40 px.
Scene Frontal(double ratio)
{
	Scene scene;
	Aim(scene, 125, 87.5, 500, 0, 0, 0);
	// Width: w d |1/U - 1/z|, U = 700, z = 500.
	scene.focus_point = { 0, 0, 700 };
	scene.aperture = 2 * ratio * 40 / (scene.w_px * (1.0 / 500 - 1.0 / 700));
	scene.noise = 0.005;
	return scene;
}

TEST(Blurred, SweepForNow)
{
	for (const double ratio : { 0.05, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45, 0.5 })
		try { Measure(Frontal(ratio)); } catch (const Error& e) { std::printf("%g: %s\n", ratio, e.what()); }
	for (const double incline : { 30.0, 45.0, 60.0 })
		for (const double turn : { 0.0, 100.0, 215.0 })
		{
			Scene scene = Frontal(0.2);
			Aim(scene, 125, 87.5, 500, incline, 20, turn);
			scene.vignetting = 5;
			std::printf("incline %g turn %g: ", incline, turn);
			try { Measure(scene); } catch (const Error& e) { std::printf("%s\n", e.what()); }
		}
}

}
