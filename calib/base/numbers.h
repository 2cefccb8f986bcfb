// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_NUMBERS_H
#define TILTCAL_NUMBERS_H

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

namespace tiltcal
{

/// The finite number that the whole text is, or none.
inline std::optional<double> FiniteNumber(const std::string& text)
{
	size_t used = 0;
	double value = 0;
	try
	{
		value = std::stod(text, &used);
	}
	catch (const std::exception&)
	{
		return std::nullopt;
	}
	return used == text.size() && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

}

#endif
