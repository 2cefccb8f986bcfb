// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The part of a round lens that its rims leave open for one pixel: area and centre of gravity.

#ifndef TILTCAL_PUPIL_OPENING_H
#define TILTCAL_PUPIL_OPENING_H

#include <tiltcal/calibration.h>

#include "lens/optical_vignetting.h"

#include <vector>

namespace tiltcal
{

struct Disc
{
	double x, y, radius;
};

/// What several discs have in common.
struct Opening
{
	double area = 0;
	double x = 0, y = 0;   ///< its centre of gravity; (0, 0) where there is no area
};

/// By Green's theorem along the arcs that bound it. At least one disc, radii > 0; good to 1e-15 of the largest radius squared.
Opening CommonOpening(const std::vector<Disc>& discs);

/// How a pixel sees the lens, mm and world of camera.h.
struct PixelView
{
	Vec3<double> n{ 0, 0, 1 };       ///< lens normal
	Vec3<double> v{ 0, 0, 1 };       ///< direction on the scene's side
	Vec3<double> pixel{ 0, 0, 1 };   ///< direction of the pixel, as the sensor sees it
	double kappa = 0;                ///< inverse focus distance of v, 1/mm
	double opening = 1;              ///< radius of the photograph's stop, in those of the reference
};

/// Of the pixel (u, v) of state `s`, as the calibration's solution of an exact model says.
PixelView ViewOfPixel(const Calibration& calibration, size_t s, double u, double v);

/// What the rims leave of a lens of that radius, mm, at the view's stop, in the axes of BasisOfLensPlane(n). `image_distance`: w, mm.
Opening OpeningOf(const PixelView& view, double lens_radius, double image_distance, const std::vector<tilt_lens::Rim>& rims);

}

#endif
