// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Numbers with their sigmas, and the lens in one state. Lengths mm, angles degrees, pictures pixels; frames of frames.h.

#ifndef TILTCAL_ESTIMATE_H
#define TILTCAL_ESTIMATE_H

#include <tiltcal/frames.h>

namespace tiltcal
{

/// An estimate and its standard deviation.
struct Estimate
{
	double value = 0, sigma = 0;
};

/// The lens in one state.
struct StateLens
{
	bool converged = true;
	bool chosen_by_power = false;   ///< the blur fits two planes; the one that keeps f was taken
	Vec3<double> q{ 0, 0, 0 }, q_sigma{ 0, 0, 0 };   ///< plane of focus, 1/mm
	Estimate lens_tilt, focal_plane_tilt, tilt_direction, focus_distance, focal_length;   ///< near infinity q_z says more than U: U may be huge, or < 0
	double rms_blur = 0;     ///< px, measured against predicted
	int edges = 0;
};

}

#endif
