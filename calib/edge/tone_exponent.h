// SPDX-License-Identifier: AGPL-3.0-or-later
//
// An edge whose values are a power of its light: where it is found, and what power that tells of.

#ifndef TILTCAL_TONE_EXPONENT_H
#define TILTCAL_TONE_EXPONENT_H

namespace tiltcal
{

/// How far to the bright side, over the radius of its disc, FitEdge finds an edge whose values are light^exponent: an edge is half-way up
/// in such values where it is not in light. `dark`: the dark side's light over the bright one's, 0 to 1; `reach`: how far the pixels that are used lie
/// from the edge, over the radius, at least 2: nearer, a gradient of the lighting looks the same. The disc is taken to be large beside a pixel. 0 for an exponent of 1; grows with the exponent; NaN where nothing can be fitted.
double ShiftOfExponent(double exponent, double dark, double reach);

/// The exponent that makes this shift, of an edge whose sides' values (not their light) are `dark_value` over 1. NaN where none from 1/4 to 4 does.
double ExponentOfShift(double shift, double dark_value, double reach);

}

#endif
