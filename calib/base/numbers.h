// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Numbers from text. Not strtod: under a program with a German locale it reads 1.5 as 1.

#ifndef TILTCAL_NUMBERS_H
#define TILTCAL_NUMBERS_H

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace tiltcal
{

/// The number at text[at], behind blanks and with a sign; `at` moves behind it. None: no number, or too large for a double.
inline std::optional<double> NumberAt(const std::string& text, size_t& at)
{
	size_t start = text.find_first_not_of(" \t", at);
	if (start == std::string::npos)
		return std::nullopt;
	if (text[start] == '+' && text.compare(start, 2, "+-") != 0)
		++start;
	double value = 0;
	const auto [end, fault] = std::from_chars(text.data() + start, text.data() + text.size(), value);
	if (fault == std::errc::invalid_argument)
		return std::nullopt;
	at = static_cast<size_t>(end - text.data());
	if (fault == std::errc::result_out_of_range)
	{
		// Too small is 0: an exponent is below 0 only behind "e-".
		if (text.find("e-", start) >= at && text.find("E-", start) >= at)
			return std::nullopt;
		return 0.0;
	}
	return value;
}

/// The finite number that the whole text is, or none.
inline std::optional<double> FiniteNumber(const std::string& text)
{
	size_t at = 0;
	const std::optional<double> value = NumberAt(text, at);
	return value && at == text.size() && std::isfinite(*value) ? value : std::nullopt;
}

}

#endif
