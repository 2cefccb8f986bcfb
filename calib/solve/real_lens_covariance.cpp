// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_covariance.h"

#include "lens/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

using namespace real_lens;

namespace
{

/// A number that people read: `per` of the fit's, number `at`.
struct Told
{
	std::string name;
	int at;
	double per;
};

std::vector<Told> AllOf(const Task& task, const RealLensNumbers& x)
{
	const double f = task.pitch_mm / x.lens[POWER];
	std::vector<Told> all{ { "focal_length_mm", POWER, -f / x.lens[POWER] }, { "pupil_magnification", MAGNIFICATION, 1 }, { "aperture_diameter_mm", OPENING, 2 * x.r }, { "psf_floor_squared_px2", FLOOR_SQUARED, 1 } };
	for (int k = 0; k < tilt_lens::AberrationTerms; ++k)
		all.push_back({ k < tilt_lens::ThirdOrderTerms ? fmt::format("aberrations.{}", tilt_lens::AberrationWords[k]) : fmt::format("aberrations.fifth_order_{}", k - tilt_lens::ThirdOrderTerms + 1),
			LENS_SIZE + k, 1000 / f });
	for (size_t s = 0; s < task.states.size(); ++s)
	{
		const std::string state = task.states[s].name + ".";
		const int at = PlaceOfState(s);
		all.insert(all.end(), { { state + "normal_x", at + NX, 1 }, { state + "normal_y", at + NY, 1 }, { state + "exit_pupil_to_sensor_mm", at + W, task.pitch_mm },
			{ state + "principal_point_u_px", at + CX, 1 }, { state + "principal_point_v_px", at + CY, 1 } });
	}
	for (size_t k = 1; k < task.stops.size(); ++k)
		all.push_back({ fmt::format("stop_f{:g}.log_ratio", task.stops[k].f_number), PlaceOfState(task.states.size()) + int(k) - 1, 1 });
	return all;
}

}

int PlaceOfState(size_t state) { return LENS_SIZE + tilt_lens::AberrationTerms + RIMS_SIZE + STATE_SIZE * int(state); }

NamedCovariance CovarianceOfRealLens(const Task& task, const RealLensAnswer& answer)
{
	const Eigen::MatrixXd& c = answer.judged.by_edges;
	std::vector<Told> told;
	for (const Told& number : AllOf(task, answer.numbers))
		if (c(number.at, number.at) > 0)
			told.push_back(number);
	NamedCovariance named;
	for (const Told& a : told)
	{
		named.names.push_back(a.name);
		for (const Told& b : told)
			named.matrix.push_back(a.per * b.per * c(a.at, b.at));
		if (answer.judged.by_photographs)
			named.by_photographs.push_back(std::abs(a.per) * std::sqrt(std::max(0., (*answer.judged.by_photographs)(a.at, a.at))));
	}
	return named;
}

}
