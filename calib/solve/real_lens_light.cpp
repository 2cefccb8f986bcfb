// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_light.h"

#include <Eigen/Dense>

namespace tiltcal
{

namespace
{

/// Fewer patches leave nothing over beside exposure and gradient.
const size_t FEWEST_PATCHES = 6;

void Add(const std::vector<BrightPatch>& patches, const Board* board, RealLensExposure& exposure)
{
	for (const BrightPatch& p : patches)
		// Beyond the lens's image circle there is no light, and no logarithm.
		if (p.value > 0)
			exposure.light.patches.push_back({ p.u, p.v, { board ? 2 * p.board_column / board->columns - 1 : 0, board ? 2 * p.board_row / board->rows - 1 : 0 }, std::log(p.value), p.sigma / p.value, 1 });
}

}

std::vector<RealLensExposure> ExposuresOf(const Task& task, bool shared_poses, double r, const RimSides& sides)
{
	std::vector<RealLensExposure> all;
	const RealLensPatches blank{ {}, {}, r, task.pitch_mm, sides };
	for (const FlatField& field : task.flat_fields)
	{
		all.push_back({ field.state, std::nullopt, false, blank });
		Add(field.patches, nullptr, all.back());
	}
	for (size_t s = 0; task.flat_fields.empty() && s < task.states.size(); ++s)
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
			if (const std::vector<BrightPatch>& white = task.states[s].photos[p].white; white.size() >= FEWEST_PATCHES)
			{
				all.push_back({ s, p, shared_poses, blank });
				Add(white, &task.board, all.back());
			}
	return all;
}

void Weigh(double error, RealLensExposure& exposure)
{
	std::vector<RealLensPatches::Patch>& patches = exposure.light.patches;
	const bool own_gradient = exposure.photo && !exposure.lit_alike;
	Eigen::MatrixXd columns(long(patches.size()), own_gradient ? 3 : 1);
	for (size_t i = 0; i < patches.size(); ++i)
	{
		RealLensPatches::Patch& p = patches[i];
		p.weight = 1 / std::hypot(p.sigma, error);
		columns(long(i), 0) = p.weight;
		for (int k = 0; own_gradient && k < 2; ++k)
			columns(long(i), 1 + k) = p.weight * p.place[k];
	}
	const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
	exposure.light.basis = qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

}
