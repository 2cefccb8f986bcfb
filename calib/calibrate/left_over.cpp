// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/left_over.h"

#include "base/robust.h"
#include "solve/each_edge.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace tiltcal
{

namespace
{

double Middle(std::vector<double> noise) { return noise.empty() ? std::numeric_limits<double>::infinity() : Median(std::move(noise)); }

}

double NoiseOfBlur(const Task& task)
{
	std::vector<double> noise;
	ForEachEdge(task, [&](size_t, size_t, const Edge& e) { noise.push_back(e.blur_sigma); });
	return Middle(std::move(noise));
}

double NoiseOfPlaces(const Task& task)
{
	std::vector<double> noise;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			for (const Corner& corner : photo.corners)
				noise.push_back(corner.sigma);
	return std::sqrt(2.0) * Middle(std::move(noise));
}

bool PlacesAreLeftOver(const Calibration& c) { return c.geometry.rms > MOST_OF_NOISE * NoiseOfPlaces(c.task); }

bool MoreThanNoiseIsLeftOver(const Calibration& c) { return PlacesAreLeftOver(c) || c.solution.rms_blur > MOST_OF_NOISE * NoiseOfBlur(c.task); }

}
