// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Both ways between pixels and directions, where the lens's distortion has an inverse.

#ifndef TILTCAL_PICTURE_VIEW_H
#define TILTCAL_PICTURE_VIEW_H

#include "lens/vec3.h"

#include <tiltcal/frames.h>

#include <array>
#include <optional>

namespace tiltcal
{

/// How one state puts directions in its picture: image distance and principal point, px, distortion about the unit lens normal.
struct PictureView
{
	double w_px = 0;
	std::array<double, 5> distortion{};
	Point principal_point{};
	Vec3<double> normal{ 0, 0, 1 };
};

/// Pixel where P (camera frame) is seen through the lens centre. None: P is not in front of the lens plane, its z is not above 0, or it is beyond
/// the angle where Brown's polynomial turns back, and shows what is inside.
std::optional<Point> PixelOf(const PictureView& view, const Vec3<double>& P);

/// Direction (camera frame, any length) that a pixel sees through the lens centre: (u, v, 1) of it with the distortion taken off. None where no
/// direction before the polynomial turns back leads there.
std::optional<Vec3<double>> DirectionOf(const PictureView& view, const Point& pixel);

/// A pixel that sees nothing, of 33 x 33 over a picture of that size and half a per cent beyond it: the renderer refuses such a camera
/// (lens/check_effects.h). None where all see something. Pixels that look along or behind the lens plane do not count.
std::optional<Point> FirstFold(const PictureView& view, int width, int height);

}

#endif
