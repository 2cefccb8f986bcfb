// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/half_of_edges.h"
#include "solve/real_lens_fit.h"

#include <algorithm>

namespace tiltcal
{

namespace
{

/// As Judged has them.
Eigen::VectorXd InARow(const RealLensNumbers& x)
{
	std::vector<double> all;
	const auto add = [&all](const auto& block) { all.insert(all.end(), block.begin(), block.end()); };
	add(x.lens);
	add(x.c);
	add(x.rims);
	for (const auto& state : x.states)
		add(state);
	return Eigen::Map<const Eigen::VectorXd>(all.data(), long(all.size()));
}

}

Eigen::VectorXd VarianceByParts(const RealLensFit& whole, const std::vector<RealLensEdge>& edges, const RealLensNumbers& x)
{
	Eigen::VectorXd farthest = Eigen::VectorXd::Zero(InARow(x).size());
	for (const EdgeSubset& half : FourHalvesOfEdges(whole.task))
	{
		const Task task = WithEdges(whole.task, half);
		const RealLensFit part{ task, whole.rings, whole.error, whole.light_error, whole.exposures, whole.rims_know_pupils, whole.likely_c, whole.rims_about };
		std::vector<RealLensEdge> kept;
		for (size_t k = 0; k < edges.size(); ++k)
			if (half[k])
				kept.push_back(edges[k]);
		RealLensNumbers y = x;
		if (!part.Minimise(kept, y, false))
			continue;
		// Too few photographs or edges to tell all numbers apart say nothing against the whole.
		if (const std::optional<Eigen::MatrixXd> scatter = part.ByEdges(kept, y))
			farthest = farthest.cwiseMax((InARow(y) - InARow(x)).cwiseAbs2() - scatter->diagonal());
	}
	return farthest;
}

}
