// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pictures of flat patterns through a thin lens, as the mean of many pinhole pictures, one from each of a few hundred
// points of the lens. A pinhole picture of a plane is a homography; it is fixed by four points, each followed by
// straight lines: board point, lens point, plane of focus, lens centre. No formula of a blur is in it.

#ifndef TILTCAL_THIN_LENS_PICTURE_H
#define TILTCAL_THIN_LENS_PICTURE_H

#include <tiltcal/board.h>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include <functional>
#include <vector>

namespace synthetic
{

/// A circle about the lens's axis that stops light, mm: a mount, or the edge of another glass. `distance` along the axis, before the lens > 0, behind it < 0.
struct Rim
{
	double radius = 0, distance = 0;
};

struct Scene
{
	int width = 640, height = 480;
	double w_px = 800;                        ///< image distance, px; the axis meets the picture's middle
	double aperture = 0;                      ///< diameter of the lens, mm
	Eigen::Vector3d lens_normal{ 0, 0, 1 };   ///< x right, y down, z forward, here and below
	Eigen::Vector3d focus_point{ 0, 0, 500 }, focus_normal{ 0, 0, 1 };   ///< plane of focus, mm
	Eigen::Matrix3d camera_from_board = Eigen::Matrix3d::Identity();     ///< board: x along the columns, y down the rows
	Eigen::Vector3d origin{ 0, 0, 500 };      ///< of the board, camera frame, mm
	double noise = 0;                         ///< standard deviation, linear light
	unsigned seed = 1;
	double vignetting = 1;                    ///< the corners are darker by this factor
	bool eight_bit = false;                   ///< sRGB-coded, rounded and decoded
	int lens_points = 300;
	double k1 = 0;                            ///< radial distortion about the lens's axis: distorted = ideal (1 + k1 r^2), in units of the axial distance
	double w = 0;                             ///< image distance, mm; only rims behind the lens ask for it
	std::vector<Rim> rims{};
};

/// Light of the board's plane at (x, y) mm, 0..1.
struct Pattern
{
	std::function<float(double x, double y)> light;
	/// No farther than the nearest change of the light, mm; empty: not known.
	std::function<double(double x, double y)> clearance{};
};

/// Squares of `square_mm`, the first inner corner at the origin, black at the top left, one square of white around.
Pattern Checkerboard(int columns, int rows, double square_mm);

/// Dark circles on white, the first centre at the origin, white half a spacing beyond the circles. Asymmetric: circles two spacings apart in a row, every
/// second row moved by one. Diameters up to a spacing.
Pattern Circles(int columns, int rows, double spacing_mm, double diameter_mm, bool asymmetric);

/// CV_32FC1, linear light.
cv::Mat TakePicture(const Scene& scene, const Pattern& pattern);

/// Where the lens centre sees (x, y) of the board, px.
Eigen::Vector2d PixelOf(const Scene& scene, double x, double y);

/// Radius of the blur of a point (x, y) mm, px, across (nx, ny): half the width of what the lens's rim paints.
double BlurRadius(const Scene& scene, double x, double y, double nx, double ny);

/// Sets the plane of focus, by Gauss's equation along the lens's axis for three points of the sensor, `w` behind the lens: focal length `f`, mm.
void FocusOn(Scene& scene, double w, double f);

/// Unit normal of a lens tilted by `tilt` towards `direction`, degrees; y is down.
Eigen::Vector3d LensNormal(double tilt, double direction);

/// Points the camera at (x, y) mm of the board from `distance`, inclined by `incline` degrees about the picture's x axis turned
/// by `direction`, the board turned by `turn` in the picture before.
void Aim(Scene& scene, double x, double y, double distance, double incline, double direction, double turn);

}

#endif
