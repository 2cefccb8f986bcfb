// SPDX-License-Identifier: AGPL-3.0-or-later
//
// An edge is measured as a straight line with one blur width (edge/edge_fit.h). Through a real lens it is bent by distortion,
// its blur grows along it, and in perspective a blur is a little lopsided: up to some hundredths of a pixel, which noise does
// not hide. Once a camera is known, what the measuring makes of a perfect picture of that camera's can be worked out, and
// taken off.

#ifndef TILTCAL_EDGE_BIAS_H
#define TILTCAL_EDGE_BIAS_H

#include "lens/optical_vignetting.h"

#include <tiltcal/calibration.h>

#include <vector>

namespace tiltcal
{

/// `measured` without what the measuring of straight edges leaves out, as the camera of `geometry` and `solution` shows it to first order: places, slopes and
/// blurs of the edges, where on the board they were measured, and the corners. Circles' arcs are as they were. An edge whose
/// correction comes out larger than a first order's can be (a quarter of a pixel and of its blur) is left as it is. With `rims`, which
/// make discs to cat's eyes, as if the whole lens were open.
Task WithoutEdgeBias(const Task& measured, const Geometry& geometry, const Solution& solution, const std::vector<tilt_lens::Rim>& rims = {});

}

#endif
