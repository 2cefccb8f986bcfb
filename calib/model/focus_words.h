// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Where along the axis a lens is focused, in words. What blur tells is 1/U, and a lens at its infinity stop may be a little beyond.

#ifndef TILTCAL_FOCUS_WORDS_H
#define TILTCAL_FOCUS_WORDS_H

#include <tiltcal/calibration.h>

#include <optional>
#include <string>

namespace tiltcal
{

enum class FocusPlace
{
	BEFORE_THE_LENS,   ///< U > 0, and finite by 2 sigma
	AT_INFINITY,       ///< 1/U is 0 within 2 sigma
	BEYOND_INFINITY    ///< 1/U < 0 by 2 sigma: the plane of focus meets the axis behind the lens
};

/// 1/U and its sigma, 1/mm.
Estimate InverseFocus(const StateLens& lens);

FocusPlace FocusPlaceOf(const Estimate& inverse_focus);

/// "at infinity: beyond 41.3 m (2 sigma)"; none where U and its sigma, in mm, say it as well.
std::optional<std::string> FocusWords(const Estimate& inverse_focus);

/// The same for a column of a table: "at infinity".
std::optional<std::string> FocusInShort(const Estimate& inverse_focus);

}

#endif
