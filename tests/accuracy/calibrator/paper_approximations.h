// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The two approximations of the paper's equation (4), each to be switched off.

#ifndef PAPER_APPROXIMATIONS_H
#define PAPER_APPROXIMATIONS_H

namespace calibrator_cost
{

struct Mended
{
	bool depth_along_ray;   ///< the focal depth of a feature is where its own ray meets the plane of focus, not U + y tan(theta_F)
	bool refocused;         ///< U follows the lens equation when the lens tilts, 1/U' = cos(theta_L)/f - 1/w, instead of staying
};

/// The lens tilt, degrees, that least squares of the blur widths finds by (4) and (1), for a thin lens tilted by
/// `true_tilt` degrees that photographs pose 0..5 of synthetic_lens.h without noise; camera, pose, d and U are known.
double TiltByPaper(int pose, double true_tilt, const Mended& mended);

}

#endif
