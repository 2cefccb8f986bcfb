// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Rays from a sensor through the glass: what an aberration function is fitted to.

#ifndef TILTCAL_BUNDLE_H
#define TILTCAL_BUNDLE_H

#include "prescription/mount.h"

#include <vector>

namespace tiltcal
{

/// A ray that came through, in the frame of the glass, from the sensor to the scene.
struct TracedRay
{
	size_t state;
	std::array<double, 2> pixel;
	Vec3<double> sensor_point;             ///< where it lands
	Ray<double> image, object;             ///< behind and before the glass; direction.z > 0
};

struct BundleSize
{
	int columns = 13, rows = 9;            ///< of pixels, in the middles of as many equal parts of the picture
	int across = 11;                       ///< points across the exit pupil
	double reach = 1.1;                    ///< how far from the axis these go, in paraxial radii of the exit pupil: the real one wanders
	Rims rims = Rims::CUT;
};

/// From pixels all over the sensor through points all over the opening. Rays that the rims cut off, that miss or are reflected are left
/// out. Throws Error (EXIT_REFUSED) where a state has no ray at all.
std::vector<TracedRay> TraceBundle(const Prescription& lens, const Paraxial& paraxial, const Sensor& sensor, const std::vector<GlassState>& states,
	const BundleSize& size = {});

}

#endif
