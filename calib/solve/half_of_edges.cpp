// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/half_of_edges.h"

#include "base/robust.h"

#include <cmath>

namespace tiltcal
{

namespace
{

/// Of the edges of each photograph those whose number `of` is above its median, or those up to it.
template<typename Number>
EdgeSubset HalfOf(const Task& task, Number of, bool above)
{
	EdgeSubset half;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
		{
			std::vector<double> numbers;
			for (const Edge& edge : photo.edges)
				numbers.push_back(of(edge));
			const double median = numbers.empty() ? 0 : Median(numbers);
			for (const double number : numbers)
				half.push_back((number > median) == above);
		}
	return half;
}

}

std::vector<EdgeSubset> FourHalvesOfEdges(const Task& task)
{
	const auto from_middle = [&](const Edge& e) { return std::hypot(e.x - 0.5 * (task.width - 1), e.y - 0.5 * (task.height - 1)); };
	const auto blur = [](const Edge& e) { return std::abs(e.blur); };
	return { HalfOf(task, from_middle, false), HalfOf(task, from_middle, true), HalfOf(task, blur, false), HalfOf(task, blur, true) };
}

Task WithEdges(const Task& task, const EdgeSubset& subset)
{
	Task part = task;
	size_t k = 0;
	for (State& state : part.states)
		for (Photo& photo : state.photos)
		{
			std::vector<Edge> kept;
			for (const Edge& edge : photo.edges)
				if (subset[k++])
					kept.push_back(edge);
			photo.edges = std::move(kept);
		}
	return part;
}

}
