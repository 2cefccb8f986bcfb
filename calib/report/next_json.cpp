// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/next_json.h"

namespace tiltcal
{

namespace
{

Json SigmasJson(const std::vector<ExpectedSigma>& sigmas)
{
	Json list = Json::array();
	for (const ExpectedSigma& s : sigmas)
		list.push_back({ { "name", s.name }, { "unit", s.unit }, { "sigma", s.now }, { "expected", s.then }, { "wanted", s.wanted } });
	return list;
}

}

Json NextPhotographsJson(const Calibration& c)
{
	Json json{ { "missing", c.next.missing }, { "sigmas", SigmasJson(c.next.sigmas) }, { "photographs", Json::array() } };
	for (const NextPhotograph& next : c.next.photographs)
	{
		Json states = Json::array();
		for (const size_t s : next.states)
			states.push_back(c.task.states[s].name);
		json["photographs"].push_back({ { "text", next.text }, { "states", states }, { "middle_px", next.middle_px }, { "distance_mm", next.distance_mm }, { "incline_deg", next.incline_deg },
			{ "recedes_deg", next.recedes_deg }, { "outline_px", next.outline_px }, { "blur_px", next.blur_px }, { "sigmas", SigmasJson(next.sigmas) } });
	}
	return json;
}

}
