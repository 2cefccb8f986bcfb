// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The least squares of several rims: the brightness of evenly bright patches (falloff_fit.h) and the places of blurred edges
// (edge_shift.h) together. Exposure, lighting, and what the boards' poses can do to edges are projected out of the residuals,
// so that the rims' numbers are the only unknowns.

#ifndef TILTCAL_RIM_FIT_H
#define TILTCAL_RIM_FIT_H

#include "effects/edge_shift.h"
#include "effects/falloff_fit.h"

#include <limits>
#include <optional>

namespace tiltcal
{

using Rims = std::vector<tilt_lens::Rim>;

/// Below this many sigma a rim is not told from noise: its radius and distance are searched over all places where a rim could stand, and the best of many is 2 or 3 sigma by chance
/// (2.4 to 2.9 in simulated cameras without one).
const double SIGNIFICANT_RIM = 4;

class RimFit
{
public:
	/// No group is left out.
	static constexpr size_t NONE = std::numeric_limits<size_t>::max();

	/// `light`: its samples, lens, natural fall-off and gradients are taken; its model_sigma to begin with. `light_group`: of
	/// each sample, what is left out with it. `first_edge_group`: that of photograph 0's edges; n's is the n-th after it.
	RimFit(const FalloffFit& light, std::vector<size_t> light_group, std::vector<EdgeShift> edges, size_t first_edge_group);

	/// Fits in place, each rim's sign of the distance kept, without one group. Returns the cost, half the sum of squares beyond
	/// which residuals of 3 sigma count linearly; none without convergence, or where nothing is left.
	/// `few_iterations`: from a solution that is near; then the limit of 6 is no failure.
	std::optional<double> Minimise(Rims& rims, size_t left_out = NONE, bool few_iterations = false) const;

	/// From several starts: `start` and, where `distance_sign` is not 0, one more rim on that side of the lens, from a grid. The
	/// standard deviations of both kinds of residuals become what is left over. False: no convergence.
	bool Search(Rims& rims, int distance_sign, double focal_length);

	/// What the rims leave over of the logarithm of a patch's light, as the last Search learnt it.
	double LightSigma() const { return light_.model_sigma; }

	/// Twice the cost.
	double ChiSquared(const Rims& rims) const;

	/// Mean of the squared residuals, in sigmas and as the fit counts them, of one group alone, with a lighting of its own.
	/// `count`: how many there are.
	double MeanOfGroup(const Rims& rims, size_t group, size_t& count) const;

	/// Covariance of (log R, log |Z|) of all rims in turn, rescaled by the residuals. False: singular.
	bool Covariance(const Rims& rims, Eigen::MatrixXd& covariance) const;

	size_t Groups() const { return groups_; }
	size_t Residuals() const { return light_.samples.size() + edges_.size(); }

private:
	enum class Part { WITHOUT, ONLY };
	struct Block;
	std::vector<Block> Blocks(Part part, size_t group) const;
	Eigen::VectorXd Evaluate(const std::vector<Block>& blocks, const Rims& rims) const;
	/// `at_most`: iterations, whose limit is no failure; 0: to convergence.
	std::optional<double> Solve(const std::vector<Block>& blocks, Rims& rims, int at_most) const;
	void LearnSigmas(const Rims& rims);

	FalloffFit light_;
	std::vector<size_t> light_group_;
	std::vector<EdgeShift> edges_;
	size_t first_edge_group_, groups_;
	double edge_sigma_ = 0.05;   ///< px, what the model leaves out of an edge's place
};

}

#endif
