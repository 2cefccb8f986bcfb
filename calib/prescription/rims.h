// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Clear diameters as the camera knows them: discs beside the opening (lens/optical_vignetting.h).

#ifndef TILTCAL_PRESCRIPTION_RIMS_H
#define TILTCAL_PRESCRIPTION_RIMS_H

#include "lens/optical_vignetting.h"
#include "prescription/lens_fit.h"

#include <vector>

namespace tiltcal
{

/// The edge of one surface as seen from outside, through what is before it (or behind it).
struct GlassRim
{
	size_t surface;
	tilt_lens::Rim rim;      ///< distance > 0: before the entrance pupil; < 0: behind the exit pupil
	double cuts;             ///< share of the opening's rays, over the whole picture, that it cuts and the rims before it do not
};

struct GlassRims
{
	/// Of the round opening, as the entrance pupil's: the real exit pupil is no disc of the paraxial radius; this one fits it best.
	double opening_radius = 0;
	std::vector<GlassRim> rims;        ///< those that cut, by how much; at most MostRims
	double left_out = 0;               ///< share of the rays that further ones would cut
	/// Light of a pixel as the rims and the round opening let it through, less that of the glass, in parts of the open lens: RMS
	/// over the pixels, and the largest one with its state and pixel.
	double rms_light = 0, worst_light = 0;
	size_t worst_state = 0;
	std::array<double, 2> worst_pixel{};
};

/// A surface's edge seen through curved glass is no circle at one distance; its radius and distance are those that fit the rays near
/// the edge best.
GlassRims FitRims(const Prescription& lens, const Paraxial& paraxial, const FittedLens& fitted, const Sensor& sensor, const std::vector<GlassState>& states);

}

#endif
