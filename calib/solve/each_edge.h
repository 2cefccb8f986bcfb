// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_EACH_EDGE_H
#define TILTCAL_EACH_EDGE_H

#include <tiltcal/task.h>

#include <cstddef>

namespace tiltcal
{

/// Calls each(state, photo, edge), state by state and photograph by photograph.
template<typename Each>
void ForEachEdge(const Task& task, Each each)
{
	for (size_t s = 0; s < task.states.size(); ++s)
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
			for (const Edge& e : task.states[s].photos[p].edges)
				each(s, p, e);
}

}

#endif
