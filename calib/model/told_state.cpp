// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/told_state.h"

#include "base/numbers.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>

namespace tiltcal
{

namespace
{

const std::string F_NUMBER = "f_number=";

}

ToldState ParseToldState(const std::string& text, const std::string& where)
{
	const size_t colon = text.find(':');
	if (colon == std::string::npos)
		return { text };
	const std::string word = text.substr(colon + 1);
	if (word.compare(0, F_NUMBER.size(), F_NUMBER) != 0)
		throw UsageError(fmt::format("{}: '{}': behind NAME: give f_number=N, such as plus5:f_number=8", where, word));
	const std::string number = word.substr(F_NUMBER.size());
	const std::optional<double> value = FiniteNumber(number);
	if (!value || !(*value > 0))
		throw UsageError(fmt::format("{}: f_number '{}' is no number above 0; give it as it is engraved, such as 5.6", where, number));
	return { text.substr(0, colon), value };
}

ToldPhotographs ParseToldPhotographs(const std::string& text, const std::string& option)
{
	const std::string where = fmt::format("{} {}", option, text);
	size_t equals = text.find('=');
	// The one of f_number=, where there is one, is not the one before the photographs.
	if (equals != std::string::npos && text.find(':') < equals)
		equals = text.find('=', equals + 1);
	if (equals == std::string::npos)
		throw UsageError(fmt::format("{}: give NAME='GLOB', such as plus5='plus5-*.png', or NAME:f_number=8='GLOB'", where));
	return { ParseToldState(text.substr(0, equals), where), text.substr(equals + 1) };
}

bool IsSameFNumber(double a, double b) { return std::max(a, b) < 1.03 * std::min(a, b); }

}
