// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the parts of calibration.json are made of.

#ifndef TILTCAL_JSON_PARTS_H
#define TILTCAL_JSON_PARTS_H

#include <tiltcal/calibration.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>

namespace tiltcal
{

// Ordered: people read this file.
using Json = nlohmann::ordered_json;

/// name_unit and name_sigma_unit.
inline void Put(Json& json, const std::string& name, const std::string& unit, const Estimate& e)
{
	const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
	json[name + unit] = number(e.value);
	json[name + "_sigma" + unit] = number(e.sigma);
}

inline void PutTilt(Json& json, const StateLens& lens)
{
	Put(json, "lens_tilt", "_deg", lens.lens_tilt);
	Put(json, "tilt_direction", "_deg", lens.tilt_direction);
}

/// `aperture_mm`: the reference's diameter.
inline Json StopsJson(const std::vector<Stop>& stops, const std::vector<Estimate>& ratios, double aperture_mm)
{
	Json list = Json::array();
	for (size_t k = 0; k < ratios.size(); ++k)
	{
		Json one{ { "f_number", stops[k].f_number } };
		Put(one, "ratio", "", ratios[k]);
		one["aperture_diameter_mm"] = aperture_mm * ratios[k].value;
		list.push_back(one);
	}
	return list;
}

/// Each pair once, and every number with itself.
inline Json CovarianceJson(const NamedCovariance& c)
{
	Json json;
	for (size_t i = 0; i < c.names.size(); ++i)
		for (size_t j = i; j < c.names.size(); ++j)
			json[c.names[i]][c.names[j]] = c.matrix[i * c.names.size() + j];
	return json;
}

/// Null: too few photographs.
inline Json SigmasByPhotographs(const NamedCovariance& c)
{
	Json json;
	for (size_t i = 0; i < c.by_photographs.size(); ++i)
		json[c.names[i]] = c.by_photographs[i];
	return json;
}

/// Null for what was not found out.
inline Json PositiveOrNull(double x) { return std::isfinite(x) && x > 0 ? Json(x) : Json(); }

}

#endif
