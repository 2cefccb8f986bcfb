// SPDX-License-Identifier: AGPL-3.0-or-later
//
// White patches as a vignetting lens shows them, by following rays through a disc of lens points to the rim: Gauss's equation
// and straight lines. Nothing of lens/optical_vignetting.h is in it.

#ifndef TILTCAL_SHADED_LENS_H
#define TILTCAL_SHADED_LENS_H

#include "support/synthetic_lens.h"

#include <vector>

namespace synthetic
{

struct Shade
{
	bool natural = true;
	double rim_radius = 0, rim_distance = 0;   ///< mm; 0: no rim
	double gradient = 0;                       ///< of the lighting: its relative difference from the board's left to its right
	double rear_radius = 0, rear_distance = 0; ///< of a rim so far behind the lens
	double front_radius = 0, front_distance = 0;   ///< of another before it
};

/// Share of its light that a patch at (u, v) has left, times the natural fall-off.
double LightLeft(const Lens& lens, const Shade& shade, double u, double v);

/// What tiltcal would have found of these lenses, without fitting: the first is untilted. Every state has `photos` photographs with
/// white patches that scatter by `noise` of themselves, and edges where the middle of the open part of the lens sees them, to 0.03 px;
/// photograph n stands in one pose in all states.
tiltcal::Calibration Shaded(const std::vector<Lens>& lenses, const Shade& shade, double noise, unsigned seed, int photos = 4);

/// A flat field in cells of 45 px.
tiltcal::FlatField ShadedField(const Lens& lens, size_t state, const Shade& shade, double noise, unsigned seed);

}

#endif
