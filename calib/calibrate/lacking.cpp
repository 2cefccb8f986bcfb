// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/next_photographs.h"

#include "calibrate/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// The farther side over the nearer one: a board as wide as a third of its distance, turned by 20 degrees, gives 1.12.
const double INCLINED = 1.1;
/// Directions to which boards must recede, so that the image distance and both coordinates of the axis are told.
const size_t LEAST_SIDES = 2;
/// px; a blur that changes by less over a board is not told from the lens's own.
const double LEAST_CHANGE_OF_BLUR = 1;

/// 0 up, 1 right, 2 down, 3 left.
size_t SideOf(const Stance& s) { return size_t((int(std::lround(s.recedes_deg / 90)) % 4 + 4) % 4); }

void LackOfInclined(const std::vector<Stance>& all, std::vector<std::string>& lines)
{
	size_t inclined = 0;
	double most = 1;
	bool sides[4] = {};
	for (const Stance& s : all)
	{
		most = std::max(most, s.depth_ratio);
		if (s.depth_ratio < INCLINED)
			continue;
		++inclined;
		sides[SideOf(s)] = true;
	}
	const auto seen = size_t(std::count(sides, sides + 4, true));
	if (inclined >= LEAST_PHOTOGRAPHS && seen >= LEAST_SIDES)
		return;
	lines.push_back(inclined == 0 ? fmt::format("missing: no board is inclined (the farther side is at most {:.0f} % farther away than the nearer one): boards parallel to the sensor do not tell the image distance", 100 * (most - 1))
		: fmt::format("missing: {} of {} boards {} inclined, to {} of four sides: three, to two sides, tell the image distance", inclined, all.size(), inclined == 1 ? "is" : "are", seen));
	size_t asked = 0;
	const char* const axes[] = { "level", "upright", "level", "upright" };
	for (const size_t side : { size_t(1), size_t(0), size_t(3), size_t(2) })
		if (!sides[side] && asked++ < 2)
			lines.push_back(fmt::format("next: turn the board by 30 to 40 degrees about its {} axis, its {} away from the camera, so that it fills most of the picture, in every state", axes[side], SideWords(90.0 * double(side))));
}

void LackOfState(const Task& task, size_t s, const std::vector<Stance>& own, std::vector<std::string>& lines)
{
	const State& state = task.states[s];
	if (own.size() < LEAST_PHOTOGRAPHS)
		lines.push_back(fmt::format("missing: state {} has {} photograph{}: {} are the least", state.name, own.size(), own.size() == 1 ? "" : "s", LEAST_PHOTOGRAPHS));
	double change = 0;
	for (const Stance& stance : own)
		change = std::max(change, stance.most_blur - stance.least_blur);
	if (!own.empty() && change < LEAST_CHANGE_OF_BLUR)
		lines.push_back(fmt::format("missing: in state {} the blur changes by {:.1f} px over a board at most: open the aperture, or incline the board so that a part of it lies before the plane of focus and a part behind", state.name, change));
}

}

std::vector<std::string> WhatPhotographsLack(const Task& task)
{
	std::vector<std::string> lines;
	std::vector<Stance> all;
	for (size_t s = 0; s < task.states.size(); ++s)
	{
		std::vector<Stance> own;
		for (const Photo& photo : task.states[s].photos)
			own.push_back(StanceOf(photo));
		LackOfState(task, s, own, lines);
		all.insert(all.end(), own.begin(), own.end());
	}
	LackOfInclined(all, lines);
	return lines;
}

}
