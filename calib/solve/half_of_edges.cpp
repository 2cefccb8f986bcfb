// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/half_of_edges.h"

#include "base/robust.h"
#include "solve/each_edge.h"

#include <cmath>

namespace tiltcal
{

namespace
{

/// Of the edges of each photograph those whose number is above its median, or those up to it.
EdgeSubset HalfOf(const Task& task, const std::vector<double>& numbers, bool above)
{
	EdgeSubset half;
	auto first = numbers.begin();
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
		{
			const std::vector<double> own(first, first + std::ptrdiff_t(photo.edges.size()));
			first += std::ptrdiff_t(own.size());
			const double median = own.empty() ? 0 : Median(own);
			for (const double number : own)
				half.push_back((number > median) == above);
		}
	return half;
}

}

std::vector<EdgeSubset> FourHalvesOfEdges(const Task& task, const std::vector<double>& blurs)
{
	std::vector<double> from_middle, widths;
	ForEachEdge(task, [&](size_t, size_t, const Edge& e) { from_middle.push_back(std::hypot(e.x - 0.5 * (task.width - 1), e.y - 0.5 * (task.height - 1))); });
	for (const double blur : blurs)
		widths.push_back(std::abs(blur));
	return { HalfOf(task, from_middle, false), HalfOf(task, from_middle, true), HalfOf(task, widths, false), HalfOf(task, widths, true) };
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
