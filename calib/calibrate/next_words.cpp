// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/next_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const struct { const char *name, *words; } NUMBERS[] = { { "image_distance", "the image distance" }, { "aperture_diameter", "the aperture" }, { "inverse_focus_distance", "the inverse focus distance" },
	{ "principal_point_u", "the principal point, sideways" }, { "principal_point_v", "the principal point, up and down" },
	{ "lens_tilt", "the tilt" }, { "tilt_across", "the tilt, across its direction" } };

std::string StatesText(const Calibration& c, const std::vector<size_t>& states)
{
	std::string names;
	for (size_t k = 0; k < states.size(); ++k)
		names += (k == 0 ? "" : k + 1 < states.size() ? ", " : " and ") + c.task.states[states[k]].name;
	return names;
}

std::string Turn(const NextPhotograph& next)
{
	if (next.incline_deg < 1)
		return "hold the board parallel to the sensor";
	const int side = int(std::lround(next.recedes_deg / 45)) % 8;
	const char* const axis = side % 4 == 0 ? "its level axis" : side % 4 == 2 ? "its upright axis" : "its diagonal";
	return fmt::format("turn the board by {:.0f} degrees about {}, its {} away from the camera", next.incline_deg, axis, SideWords(next.recedes_deg));
}

}

std::string NameForPeople(const std::string& name)
{
	const size_t dot = name.find('.');
	const std::string number = dot == std::string::npos ? name : name.substr(dot + 1), state = dot == std::string::npos ? "" : " of " + name.substr(0, dot);
	for (const auto& known : NUMBERS)
		if (number == known.name)
		{
			const std::string words = known.words;
			const size_t comma = words.find(',');
			return state.empty() || comma == std::string::npos ? words + state : words.substr(0, comma) + state + words.substr(comma);
		}
	return name;
}

std::vector<std::string> WhatIsMissing(const Calibration& c, const std::vector<ExpectedSigma>& sigmas, const Thirds& seen, size_t least)
{
	std::vector<std::string> missing;
	for (const ExpectedSigma& s : sigmas)
		if (s.now > s.wanted)
			missing.push_back(fmt::format("{} is known to {:.3g} {}; {:.3g} are wanted", NameForPeople(s.name), s.now, s.unit, s.wanted));
	for (const State& state : c.task.states)
		if (state.photos.size() < least)
			missing.push_back(fmt::format("state {} has {} photograph{}: with {} they can be held against each other", state.name, state.photos.size(), state.photos.size() == 1 ? "" : "s", least));
	std::string empty;
	for (size_t k = 0; k < seen.size(); ++k)
		if (!seen[k])
			empty += (empty.empty() ? "" : ", ") + std::string(NameOfThird(k));
	if (!empty.empty())
		missing.push_back(fmt::format("no corner of the board was ever seen in a ninth of the picture ({}): nothing tells distortion and light there", empty));
	return missing;
}

std::string HowToTake(const Calibration& c, const NextPhotograph& next)
{
	const size_t x = size_t(std::clamp(3 * (next.middle_px[0] + 0.5) / c.task.width, 0.0, 2.0)), y = size_t(std::clamp(3 * (next.middle_px[1] + 0.5) / c.task.height, 0.0, 2.0));
	double left = HUGE_VAL, right = -HUGE_VAL;
	for (const Point& p : next.outline_px)
	{
		left = std::min(left, p[0]);
		right = std::max(right, p[0]);
	}
	const std::string where = x == 1 && y == 1 ? "the middle" : fmt::format("the {}", NameOfThird(3 * y + x));
	std::string text = fmt::format("{} {}: {}, bring its middle to {} of the picture, {:.2f} m away; its squares then take {:.0f} % of the picture's width", next.states.size() > 1 ? "in the states" : "in the state",
		StatesText(c, next.states), Turn(next), where, next.distance_mm / 1000, 100 * (right - left) / c.task.width);
	if (next.states.size() > 1)
		text += "; tilt the lens only in between";
	return text;
}

}
