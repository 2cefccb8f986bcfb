// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/transfer.h>

#include <tiltcal/error.h>
#include "base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

Transfer ParseTransfer(const std::string& text)
{
	if (text == "srgb")
		return { Transfer::SRGB, 1 };
	if (text == "linear")
		return { Transfer::LINEAR, 1 };
	const double gamma = FiniteNumber(text).value_or(0);
	if (!(gamma >= 0.1 && gamma <= 10))
		throw UsageError(fmt::format("`transfer` {}: give srgb, linear or a gamma between 0.1 and 10, such as 2.2", text));
	return { Transfer::GAMMA, gamma };
}

std::string TransferName(const Transfer& transfer)
{
	switch (transfer.kind)
	{
	case Transfer::SRGB: return "srgb";
	case Transfer::LINEAR: return "linear";
	case Transfer::GAMMA: break;
	}
	return fmt::format("{}", transfer.gamma);
}

double ToLinear(const Transfer& transfer, double coded)
{
	switch (transfer.kind)
	{
	case Transfer::SRGB:
		return coded <= 0.04045 ? coded / 12.92 : std::pow((coded + 0.055) / 1.055, 2.4);
	case Transfer::LINEAR:
		return coded;
	case Transfer::GAMMA:
		break;
	}
	return std::pow(std::max(coded, 0.0), transfer.gamma);
}

double EncodeSrgb(double linear)
{
	const double c = linear > 0 ? std::min(linear, 1.0) : 0.0;   // no number is black
	return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

}
