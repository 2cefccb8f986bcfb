// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrator_statistics.h"

#include <cmath>

namespace calibrator_cost
{

TiltError ErrorOf(double lens_tilt, double tilt_direction, double true_tilt)
{
	const double phi = tilt_direction * 3.14159265358979323846 / 180;
	return { lens_tilt * std::sin(phi), lens_tilt * std::cos(phi) - true_tilt };
}

void Summarise(const std::vector<std::vector<TiltError>>& errors, double share, double existing, Row& row)
{
	row.answers = static_cast<int>(errors.size());
	if (errors.empty())
		return;
	const size_t states = errors[0].size();
	const double n = double(errors.size());
	double squares = 0, bias = 0, deviations = 0;
	for (size_t s = 0; s < states; ++s)
		for (size_t axis = 0; axis < 2; ++axis)
		{
			double sum = 0, square = 0;
			for (const auto& draw : errors)
			{
				sum += draw[s][axis];
				square += draw[s][axis] * draw[s][axis];
			}
			const double mean = sum / n;
			squares += square;
			bias += mean * mean;
			for (const auto& draw : errors)
				deviations += (draw[s][axis] - mean) * (draw[s][axis] - mean);
		}
	row.rms = std::sqrt(squares / (n * double(states)));
	row.bias = std::sqrt(bias / double(states));
	if (errors.size() < 2 || share >= 1)
		return;
	double variance = deviations / ((n - 1) * double(states));
	if (existing > 0)
		variance *= (existing - 1) / existing;
	row.scatter = std::sqrt(variance / (1 - share));
}

}
