// SPDX-License-Identifier: AGPL-3.0-or-later

#include <cmath>

#include "lens/preview.h"

namespace tilt_lens
{

namespace
{

const Rgb Nearer = { 0.10, 0.35, 1.00 };
const Rgb Farther = { 1.00, 0.35, 0.03 };
const Rgb PlaneColour = { 0.90, 0.05, 0.60 };
const Rgb Empty = { 0.15, 0.0, 0.0 };

Rgb Mix(const Rgb& a, const Rgb& b, double t)
{
	return { a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b) };
}

double Grey(const Rgb& c)
{
	return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

}

double BlurInPixels(const PixelFocus& pixel, double aperture_diameter)
{
	return aperture_diameter * (pixel.inverse_depth - pixel.kappa) * pixel.pixels_per_slope;
}

Rgb ShowFocus(const Rgb& scene, const PixelFocus& pixel, double aperture_diameter)
{
	// A contour is drawn this far to either side of its blur width, in octaves.
	const double contour = 0.035;

	if(pixel.empty)
		return Empty;
	const double blur = BlurInPixels(pixel, aperture_diameter);
	const double width = std::fabs(blur);
	if(width < 1.0)
		return scene;

	const double dim = 0.30 * Grey(scene);
	const double octave = std::log2(width);
	const double nearest = std::floor(octave + 0.5);
	if(nearest >= 1.0 && std::fabs(octave - nearest) < contour)
		return Mix({ dim, dim, dim }, blur > 0.0 ? Nearer : Farther, 0.8);
	return Mix({ dim, dim, dim }, blur > 0.0 ? Nearer : Farther, 0.06);
}

Rgb ShowLabel(FocusLabels::Paint paint, bool nearer)
{
	return paint == FocusLabels::Ink ? Rgb{ 1.0, 1.0, 1.0 } : Mix({ 0.0, 0.0, 0.0 }, nearer ? Nearer : Farther, 0.45);
}

Rgb ShowPlane(const Rgb& scene, const PixelFocus& pixel)
{
	if(pixel.empty)
		return Empty;
	// Relative distance of what is seen from the plane, without dividing by kappa.
	const double offset = pixel.inverse_depth - pixel.kappa;
	if(pixel.kappa <= 0.0)
		return scene;
	if(std::fabs(offset) < 0.005 * pixel.kappa)
		return PlaneColour;
	// The sheet ends where there is nothing behind it: no haze over the sky.
	return offset < 0.0 && pixel.inverse_depth > 0.0 ? Mix(scene, PlaneColour, 0.18) : scene;
}

}
