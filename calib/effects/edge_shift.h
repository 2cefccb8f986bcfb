// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which side of the lens the rims leave open, as the places of blurred edges tell it: the middle of a blurred edge lies
// where the middle of the opening sees it. Brightness hardly tells a rim before the lens from one behind it; these move
// edges to opposite sides.

#ifndef TILTCAL_EDGE_SHIFT_H
#define TILTCAL_EDGE_SHIFT_H

#include <tiltcal/calibration.h>
#include "effects/pupil_opening.h"

#include <Eigen/Core>

#include <vector>

namespace tiltcal
{

/// One edge.
struct EdgeShift
{
	size_t photo = 0;             ///< running number of its photograph
	PixelView view;
	double by_x = 0, by_y = 0;    ///< its shift along its normal, px per mm of the opening's centre (axes of BasisOfLensPlane)
	double measured = 0;          ///< along its normal, seen from where its board's pose has it, px
	double sigma = 0;             ///< of that
	/// What its board's pose, w, the distortion and a plane that is not quite one could do to it (own numbers in each photograph).
	Eigen::Matrix<double, 10, 1> nuisance;
};

/// Of all edges of the calibration's photographs; none where it has no poses.
std::vector<EdgeShift> EdgeShifts(const Calibration& calibration);

}

#endif
