// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a thin lens's numbers are worth where a real lens is seen.

#ifndef TILTCAL_BESIDE_REAL_LENS_H
#define TILTCAL_BESIDE_REAL_LENS_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// Where a real lens is the answer, the thin lens that is told beside it predicts photographs left out worse: its w, f, U and d are those of a
/// model that is known to be wrong, however little they scatter, and so are its own tilts. Their sigmas are widened by how far the real lenses found put the same
/// number elsewhere, the farther one's distance in quadrature (tilts: those that are told): f and d those of the glass, w the distance of the exit pupil over the pupil
/// magnification, U where the whole opening is sharpest. `covariance` and `sigma_by_photographs` stay what scatters.
/// The real lenses are widened alike: f, pupil magnification and aperture of third and fifth order by each other, the apertures by the thin lens's too, and all that
/// the fifth order shares with the third by the third, for closed loops through glass put theirs nearer to the truth (exit pupil, principal point, tilt).
void WidenByRealLens(Calibration& c);

/// What is seen of a board tells its distance over w: no distance of a board is known better than w, relatively. After w has its last sigma.
void WidenPlacesByImageDistance(Calibration& c);

/// The tilts that are told, those of third order, where the fifth predicts photographs left out better and puts them elsewhere. Before both are widened by WidenByRealLens.
void WidenTilts(Calibration& c);

}

#endif
