// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which part of a round lens its rims leave open for one pixel.

#ifndef TILTCAL_RIMS_ON_LENS_H
#define TILTCAL_RIMS_ON_LENS_H

#include "lens/optical_vignetting.h"

#include <tiltcal/calibration.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tiltcal
{

/// Without their sigmas.
inline std::vector<tilt_lens::Rim> RimsOf(const std::vector<RimEstimate>& estimates)
{
	std::vector<tilt_lens::Rim> rims;
	for (const RimEstimate& rim : estimates)
		rims.push_back({ rim.radius_mm.value, rim.distance_mm.value });
	return rims;
}

/// A rim as the lens's plane has it: its centre from the lens's, normal to the lens's axis, and its radius; mm.
struct RimOnLens
{
	tilt_lens::Vec3<double> centre;
	double radius;
};

/// Of a lens with the unit normal n at w mm before the sensor; v: direction of the pixel's light in the scene, kappa its inverse focus distance, 1/mm; pixel: direction
/// to the pixel; both of camera.h, any length.
inline std::vector<RimOnLens> RimsOnLens(const tilt_lens::Vec3<double>& n, const tilt_lens::Vec3<double>& v, double kappa, const tilt_lens::Vec3<double>& pixel, double image_distance,
	const std::vector<tilt_lens::Rim>& rims)
{
	// A rim whose image on the lens would be larger than so many times itself is cut or open as a whole: sums keep their digits.
	const double least_scale = 1e-3;
	std::vector<RimOnLens> seen;
	for (const tilt_lens::Rim& rim : rims)
	{
		const tilt_lens::RimView<double> view = rim.distance < 0 ? tilt_lens::ViewOfRimBehind(n, { 0, 0, 1 }, pixel, image_distance, 1.0, rim.distance) : tilt_lens::ViewOfRim(n, v, kappa, rim.distance);
		const double scale = std::copysign(std::max(std::abs(view.scale), least_scale), view.scale);
		seen.push_back({ (-1 / scale) * view.offset, rim.radius / std::abs(scale) });
	}
	return seen;
}

}

#endif
