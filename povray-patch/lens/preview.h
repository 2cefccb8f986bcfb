// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The preview of focus: what `show focus` and `show plane` paint over the scene.
// Free of POV-Ray. One pixel at a time and from that pixel alone, so that the
// picture does not depend on the order in which pixels are traced.

#ifndef TILT_LENS_PREVIEW_H
#define TILT_LENS_PREVIEW_H

#include "lens/focus_labels.h"
#include "lens/lens_spec.h"

namespace tilt_lens
{

/// Linear red, green, blue.
struct Rgb
{
	double r, g, b;
};

/// What one pinhole ray found out about its pixel.
struct PixelFocus
{
	double inverse_depth;       ///< 1/z of what the pixel sees, along the axis; 0 for the background
	double kappa;               ///< inverse focus distance of the pixel
	double pixels_per_slope;    ///< pixels per unit of v.x, of the picture whose pixels count
	bool empty;                 ///< the pixel looks along or behind the lens plane
};

/// Signed blur width in pixels: positive nearer than the focus.
/// b = w d |1 - q.P| / z with P = z v, in units of a pixel.
double BlurInPixels(const PixelFocus& pixel, double aperture_diameter);

/// `show focus`: in colour where the blur is under one pixel, grey and dim
/// elsewhere, with contours where it is 2, 4, 8, ... pixels: blue nearer than the
/// plane of focus, orange beyond it. Empty pixels are dark red.
Rgb ShowFocus(const Rgb& scene, const PixelFocus& pixel, double aperture_diameter);

/// What a label makes of a pixel that it covers.
Rgb ShowLabel(FocusLabels::Paint paint, bool nearer);

/// `show plane`: the plane of focus as a sheet of coloured glass, and its trace,
/// where it cuts the scene, as a line one percent of the distance wide.
Rgb ShowPlane(const Rgb& scene, const PixelFocus& pixel);

}

#endif
