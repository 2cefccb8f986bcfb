// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/fixed_blades.h"

#include "lens/angles.h"
#include <tiltcal/error.h>
#include "base/numbers.h"

#include <fmt/format.h>
#include "lens/blades.h"

#include <cmath>

namespace tiltcal
{

namespace
{

double Number(const std::string& text, const std::string& option)
{
	const std::optional<double> value = FiniteNumber(text);
	if (!value)
		throw UsageError(fmt::format("{}: '{}' is no number", option, text));
	return *value;
}

}

bool TakeBlades(const std::string& text, FixedBlades& blades)
{
	const size_t equals = text.find('=');
	const std::string name = text.substr(0, equals), option = "`fix` " + text;
	if (name != "blades" && name != "blade_rotation" && name != "blade_curvature")
		return false;
	if (equals == std::string::npos)
		throw UsageError(fmt::format("{}: give NAME=VALUE, such as blades=8", option));
	const double value = Number(text.substr(equals + 1), option);
	if (name == "blades")
	{
		if (value != std::floor(value) || value < tilt_lens::FewestBlades || value > tilt_lens::MostBlades)
			throw UsageError(fmt::format("{}: give a whole number from {} to {}", option, tilt_lens::FewestBlades, tilt_lens::MostBlades));
		blades.count = static_cast<int>(value);
	}
	else if (name == "blade_rotation")
		blades.rotation_deg = value;
	else
	{
		if (value < 0 || value > 1)
			throw UsageError(fmt::format("{}: give 0 for straight edges to 1 for a circle", option));
		blades.curvature = value;
	}
	return true;
}

void CheckBlades(const FixedBlades& blades)
{
	if (blades.count == 0 && (blades.rotation_deg != 0 || blades.curvature != 0))
		throw UsageError("`fix` blade_rotation and blade_curvature say how blades stand: give their number too, such as `fix` blades=8");
}

double MeanSquareRadius(const FixedBlades& fixed)
{
	const tilt_lens::Blades blades = tilt_lens::MakeBlades(fixed.count, fixed.rotation_deg * tilt_lens::Pi / 180, fixed.curvature);
	// The map preserves area, so that the mean over the square is that over the opening. r^2 has kinks on the square's diagonals and at the blades' corners.
	const int n = 512;
	double sum = 0;
	for (int i = 0; i < n; ++i)
		for (int k = 0; k < n; ++k)
		{
			const tilt_lens::PupilPoint p = tilt_lens::SquareToBlades(blades, (i + 0.5) / n, (k + 0.5) / n);
			sum += p.x * p.x + p.y * p.y;
		}
	return sum / (double(n) * n);
}

double WideningForBlades(const FixedBlades& blades)
{
	return blades.count ? std::sqrt(0.5 / MeanSquareRadius(blades)) : 1;
}

}
