// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Parts of the edges: what a model leaves out is the same in every photograph, but not in every part of the picture and of the blur.

#ifndef TILTCAL_HALF_OF_EDGES_H
#define TILTCAL_HALF_OF_EDGES_H

#include <tiltcal/task.h>

#include <vector>

namespace tiltcal
{

/// Which edges are taken, in the order of ForEachEdge.
using EdgeSubset = std::vector<bool>;

/// Of each photograph's edges the half nearer to the picture's middle and the half farther from it, the sharper half and the more blurred one. `blurs`: of every edge, as a
/// model has it; halves by the blur that was measured would be chosen by its noise.
std::vector<EdgeSubset> FourHalvesOfEdges(const Task& task, const std::vector<double>& blurs);

/// The task with these alone.
Task WithEdges(const Task& task, const EdgeSubset& subset);

}

#endif
