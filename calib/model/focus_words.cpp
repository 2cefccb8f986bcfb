// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/focus_words.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

/// Below so many sigmas of 1/U the sigma of U is another upwards than downwards by a third and more.
const double LOPSIDED = 6;

std::string Metres(double mm)
{
	const double m = mm / 1000;
	return fmt::format("{:.{}f} m", m, m < 10 ? 2 : m < 100 ? 1 : 0);
}

}

Estimate InverseFocus(const StateLens& lens) { return { lens.q.z, lens.q_sigma.z }; }

FocusPlace FocusPlaceOf(const Estimate& inverse_focus)
{
	if (!(std::abs(inverse_focus.value) > 2 * inverse_focus.sigma))
		return FocusPlace::AT_INFINITY;
	return inverse_focus.value > 0 ? FocusPlace::BEFORE_THE_LENS : FocusPlace::BEYOND_INFINITY;
}

std::optional<std::string> FocusWords(const Estimate& inverse_focus)
{
	const double value = inverse_focus.value, sigma = inverse_focus.sigma;
	switch (FocusPlaceOf(inverse_focus))
	{
	case FocusPlace::AT_INFINITY:
		return sigma > 0 ? fmt::format("at infinity: beyond {} (2 sigma)", Metres(1 / (value + 2 * sigma))) : "at infinity";
	case FocusPlace::BEYOND_INFINITY:
		return fmt::format("beyond infinity: 1/U {:.2g} +- {:.1g} per metre", 1000 * value, 1000 * sigma);
	case FocusPlace::BEFORE_THE_LENS:
		break;
	}
	if (value > LOPSIDED * sigma)
		return std::nullopt;
	return fmt::format("{} ({} to {}, 2 sigma)", Metres(1 / value), Metres(1 / (value + 2 * sigma)), Metres(1 / (value - 2 * sigma)));
}

std::optional<std::string> FocusInShort(const Estimate& inverse_focus)
{
	switch (FocusPlaceOf(inverse_focus))
	{
	case FocusPlace::AT_INFINITY: return "at infinity";
	case FocusPlace::BEYOND_INFINITY: return "beyond infinity";
	case FocusPlace::BEFORE_THE_LENS: break;
	}
	return std::nullopt;
}

}
