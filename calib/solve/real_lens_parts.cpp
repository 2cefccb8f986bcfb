// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/half_of_edges.h"
#include "solve/real_lens_fit.h"

namespace tiltcal
{

Eigen::VectorXd VarianceByParts(const RealLensFit& whole, const std::vector<RealLensEdge>& edges, const RealLensNumbers& x)
{
	const Eigen::VectorXd told = x.InARow();
	Eigen::VectorXd farthest = Eigen::VectorXd::Zero(told.size());
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
			farthest = farthest.cwiseMax((y.InARow() - told).cwiseAbs2() - scatter->diagonal());
	}
	return farthest;
}

}
