// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/priors.h"

#include <tiltcal/error.h>
#include "base/numbers.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

const struct
{
	const char* name;
	Quantity quantity;
} NAMES[] = {
	{ "focal_length", Quantity::FOCAL_LENGTH },
	{ "f_number", Quantity::F_NUMBER },
	{ "image_distance", Quantity::IMAGE_DISTANCE },
	{ "focus_distance", Quantity::FOCUS_DISTANCE },
	{ "aperture_diameter", Quantity::APERTURE_DIAMETER },
};

const double FIXED = 1e-6;

double Positive(const std::string& text, const std::string& option)
{
	const std::optional<double> value = FiniteNumber(text);
	if (!value || !(*value > 0))
		throw UsageError(fmt::format("{}: '{}' is no positive number", option, text));
	return *value;
}

Prior Parse(const std::string& text, const char* option, bool with_sigma)
{
	const std::string where = fmt::format("{} {}", option, text);
	const size_t equals = text.find('=');
	const std::string name = text.substr(0, equals);
	for (const auto& known : NAMES)
	{
		if (name != known.name || equals == std::string::npos)
			continue;
		const std::string numbers = text.substr(equals + 1);
		const size_t colon = numbers.find(':');
		if ((colon != std::string::npos) != with_sigma)
			throw UsageError(fmt::format(with_sigma ? "{}: give NAME=VALUE:SIGMA, such as f_number=2.8:0.1" : "{}: give NAME=VALUE, such as focal_length=45; `prior` takes a sigma", where));
		const double value = Positive(numbers.substr(0, colon), where);
		return { known.quantity, value, with_sigma ? Positive(numbers.substr(colon + 1), where) : FIXED * value };
	}
	std::string names;
	for (const auto& known : NAMES)
		names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
	throw UsageError(fmt::format("{}: there is no '{}'; give one of {} (mm)", where, name, names));
}

}

std::string Prior::Name() const
{
	for (const auto& known : NAMES)
		if (known.quantity == quantity)
			return known.name;
	return "";
}

Prior ParseFix(const std::string& text) { return Parse(text, "`fix`", false); }
Prior ParsePrior(const std::string& text) { return Parse(text, "`prior`", true); }

}
