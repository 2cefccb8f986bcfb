// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tasks with a part of their edges, for speed.

#ifndef TILTCAL_FEWER_EDGES_H
#define TILTCAL_FEWER_EDGES_H

#include <tiltcal/task.h>

#include <cstddef>
#include <vector>

namespace synthetic
{

/// Every n-th edge of each photograph, from the first on.
inline tiltcal::Task WithEveryNth(size_t n, tiltcal::Task task)
{
	for (tiltcal::State& state : task.states)
		for (tiltcal::Photo& photo : state.photos)
		{
			std::vector<tiltcal::Edge> kept;
			for (size_t k = 0; k < photo.edges.size(); k += n)
				kept.push_back(photo.edges[k]);
			photo.edges = kept;
		}
	return task;
}

}

#endif
