// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Corners and blur widths of strongly blurred checkerboards (blurred_checker.h), against pictures that are the mean of pinhole
// pictures (thin_lens_picture.h).

#include "edge/blurred_checker.h"
#include <tiltcal/photo.h>
#include "measure/detect.h"
#include <tiltcal/error.h>
#include "measure/measure.h"
#include "support/thin_lens_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <tuple>
#include <vector>

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
	size_t corners = 0, edges = 0, dropped = 0;
	double ratio = 0;                       // mean
};

/// Both as RMS over several pictures of the same board.
Errors Pooled(const std::vector<Errors>& of)
{
	Errors all;
	for (const Errors& e : of)
	{
		const double n = double(e.corners), m = double(e.edges);
		all.corner += n * e.corner * e.corner;
		all.corner_sigmas += n * e.corner_sigmas * e.corner_sigmas;
		all.blur += m * e.blur * e.blur;
		all.blur_sigmas += m * e.blur_sigmas * e.blur_sigmas;
		all.ratio += m * e.ratio;
		all.corners += e.corners;
		all.edges += e.edges;
		all.dropped += e.dropped;
	}
	all.corner = std::sqrt(all.corner / double(all.corners));
	all.corner_sigmas = std::sqrt(all.corner_sigmas / double(all.corners));
	all.blur = std::sqrt(all.blur / double(all.edges));
	all.blur_sigmas = std::sqrt(all.blur_sigmas / double(all.edges));
	all.ratio /= double(all.edges);
	return all;
}

/// A sigma is honest within a factor of 2 either way. Of n independent errors that are normal, the mean square in units of a sigma that is off by
/// a factor f is f^2 chi^2_n / n, beyond these bounds once in a thousand (Wilson and Hilferty's quantile).
void ExpectHonest(double rms_sigmas, size_t n, const char* what)
{
	const double k = 2 / (9 * double(n));
	EXPECT_LT(rms_sigmas, 2 * std::pow(1 - k + 3.09 * std::sqrt(k), 1.5)) << what;
	EXPECT_GT(rms_sigmas, 0.5 * std::pow(1 - k - 3.09 * std::sqrt(k), 1.5)) << what;
}

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
	e.corners = photo.corners.size();
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
	scene.noise = 0.006;
	scene.lens_points = 600;
	return scene;
}

class BlurRatio : public testing::TestWithParam<double> {};

TEST_P(BlurRatio, CornersAndBlurOfAFrontalBoard)
{
	const double ratio = GetParam();
	std::vector<Errors> pictures;
	// Three where sigma is nearest to its bounds.
	for (unsigned seed = 1; seed <= (ratio < 0.4 ? 1u : 3u); ++seed)
	{
		Scene scene = Frontal(ratio);
		scene.seed = seed;
		pictures.push_back(Measure(scene));
	}
	const Errors e = Pooled(pictures);
	EXPECT_NEAR(e.ratio, ratio, 0.01);
	// The task's own bounds; squares of 40 px, noise as of 20000 electrons.
	EXPECT_LT(e.corner, ratio <= 0.2 ? 0.06 : 0.15);
	EXPECT_LT(e.blur, std::max(0.1, 0.01 * ratio * 40));
	EXPECT_EQ(e.dropped, 0u);
	ExpectHonest(e.corner_sigmas, 2 * e.corners, "corners"); // two coordinates each
	ExpectHonest(e.blur_sigmas, e.edges, "blur");
}

INSTANTIATE_TEST_SUITE_P(Steps, BlurRatio, testing::Values(0.05, 0.1, 0.2, 0.25, 0.3, 0.4));

TEST(Blurred, InclinedTurnedVignettedBoards)
{
	const struct { double incline, direction, turn, ratio; } cases[] = { { 30, 20, 100, 0.2 }, { 45, 110, 215, 0.15 }, { 60, 20, 300, 0.1 } };
	for (const auto& c : cases)
	{
		Scene scene = Frontal(c.ratio);
		Aim(scene, 125, 87.5, 500, c.incline, c.direction, c.turn);
		scene.vignetting = 5;
		scene.lens_points = 300;
		scene.eight_bit = true;
		const Errors e = Measure(scene);
		// Squares of 40 px frontal, of 15 to 25 across at 60 degrees, and a fifth of the light in the corners.
		EXPECT_LT(e.corner, 0.15) << c.incline;
		EXPECT_LT(e.blur, 0.1) << c.incline;
		EXPECT_LT(e.dropped, 5u) << c.incline;
		ExpectHonest(e.corner_sigmas, 2 * e.corners, "corners");
		ExpectHonest(e.blur_sigmas, e.edges, "blur");
	}
}

TEST(Blurred, TooMuchIsRefusedWithTheRatio)
{
	for (const double ratio : { 0.6, 0.7 })
		try
		{
			Scene scene = Frontal(ratio);
			scene.lens_points = 200;
			Measure(scene);
			ADD_FAILURE() << ratio << " was measured";
		}
		catch (const Error& e)
		{
			EXPECT_NE(std::string(e.what()).find("of a square"), std::string::npos) << e.what();
		}
}

/// The share of the unit disc in a wedge against a sum over a grid of 2000 x 2000 points.
TEST(Blurred, WedgeShareIsTheArea)
{
	for (const auto& [t1, t2, angle] : { std::tuple{ 0.0, 0.0, 1.57 }, std::tuple{ 0.3, -0.5, 1.0 }, std::tuple{ -0.7, 0.6, 2.4 },
		std::tuple{ -0.9, -0.95, 0.4 }, std::tuple{ 0.9, 0.9, 1.5 }, std::tuple{ -1.2, 0.2, 1.1 }, std::tuple{ -0.8, -0.8, 3.0 } })
	{
		const int n = 2000;
		long inside = 0, disc = 0;
		for (int j = 0; j < n; ++j)
			for (int i = 0; i < n; ++i)
			{
				const double x = (2 * i + 1.0) / n - 1, y = (2 * j + 1.0) / n - 1;
				disc += x * x + y * y < 1;
				inside += x * x + y * y < 1 && x > t1 && x * std::cos(angle) + y * std::sin(angle) > t2;
			}
		const Wedge w = WedgeShare(t1, t2, angle);
		// A border of length 2 through 2000 points: some 1e-4 of the disc.
		EXPECT_NEAR(w.share, double(inside) / double(disc), 3e-4);
		const double h = 1e-6;
		EXPECT_NEAR(w.d_t1, (WedgeShare(t1 + h, t2, angle).share - WedgeShare(t1 - h, t2, angle).share) / (2 * h), 1e-6);
		EXPECT_NEAR(w.d_t2, (WedgeShare(t1, t2 + h, angle).share - WedgeShare(t1, t2 - h, angle).share) / (2 * h), 1e-6);
	}
}

}
