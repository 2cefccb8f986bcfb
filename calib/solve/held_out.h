// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How well a model predicts a photograph that it was not fitted to: the measure by which
// models with more unknowns and with fewer can be compared.

#ifndef TILTCAL_HELD_OUT_H
#define TILTCAL_HELD_OUT_H

#include "solve/blur_fit.h"

namespace tiltcal
{

struct HeldOut
{
	double rms = 0;                 ///< over all photographs left out, px; 0 where no state has two, or where without one there is no answer
	std::vector<LeftOut> photos;    ///< those without which there is one
};

/// Each photograph in turn is left out, the blur is fitted to the others from x on, and its own edges are
/// predicted: RMS of the differences, px, each counted as no more than `most` (a shadow on one edge must
/// not decide). Poses and w are held. Photographs that are their state's only one cannot be left out;
/// 0 when none can.
HeldOut HoldOut(const BlurFit& fit, const Unknowns& x, double most);

}

#endif
