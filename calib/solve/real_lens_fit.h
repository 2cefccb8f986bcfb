// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The least squares of one real lens (lens/aberrations.h) in all states: where edges lie and how wide they are, against rays through it.

#ifndef TILTCAL_REAL_LENS_FIT_H
#define TILTCAL_REAL_LENS_FIT_H

#include "solve/joint_fit.h"
#include "solve/real_lens_cost.h"

#include <optional>
#include <vector>

namespace tiltcal
{

/// A lens and how it stands in every state; poses from the centre of the entrance pupil.
struct RealLensNumbers
{
	std::vector<std::array<double, real_lens::STATE_SIZE>> states;
	/// With shared poses those of the untilted state alone, and where the centre of the entrance pupil lies in the others, mm, seen from there.
	std::vector<std::vector<Pose>> poses;
	std::vector<std::array<double, 3>> centres;
	bool shared_poses = false;
	std::array<double, real_lens::LENS_SIZE> lens{};
	std::array<double, tilt_lens::AberrationTerms> c{};   ///< mm
	double r = 0;                                         ///< mm
	std::array<bool, tilt_lens::AberrationTerms> free{};  ///< which of c the fit may change
	bool magnification_free = false;
	bool lens_held = false;                               ///< the lens and the states' tilts

	Pose& PoseOf(size_t s, size_t p) { return poses[shared_poses ? 0 : s][p]; }
	const Pose& PoseOf(size_t s, size_t p) const { return poses[shared_poses ? 0 : s][p]; }
};

/// From the thin lens that was found: its poses, planes and aperture; no aberrations.
RealLensNumbers StartOfRealLens(const Task& task, const Geometry& geometry, const Solution& thin);

struct RealLensFit
{
	const Task& task;
	std::vector<tilt_lens::Rim> rims;
	ModelError error;

	/// Every edge, linear about these numbers, state by state; what the others take.
	std::vector<RealLensEdge> EdgesAbout(const RealLensNumbers& x) const;

	/// As JointFit's.
	std::vector<std::array<double, 2>> Residuals(const std::vector<RealLensEdge>& edges, const RealLensNumbers& x) const;
	bool Minimise(const std::vector<RealLensEdge>& edges, RealLensNumbers& x, bool coarse) const;

	/// Sigmas in the shape of the numbers themselves, by the edges and by the photographs; and what each photograph is predicted to by the
	/// others, its pose being its own: the RMS of all residuals, in their sigmas.
	struct Judged
	{
		Eigen::MatrixXd by_edges;                    ///< of lens, c and the states one after the other
		std::optional<Eigen::MatrixXd> by_photographs;
		double held_out = 0;                         ///< 0: cannot be had
	};
	/// `x` has poses of each state's own.
	std::optional<Judged> Judge(const std::vector<RealLensEdge>& edges, RealLensNumbers& x) const;
};

struct RealLensAnswer
{
	RealLensNumbers numbers;
	/// Where poses are shared, the same lens in the same tilts about them: a body that stands still while the lens turns. `numbers` has poses of each state's own, for
	/// what six numbers leave out of the picture would go into the tilts otherwise.
	std::optional<RealLensNumbers> about_shared_poses;
	ModelError error;
	RealLensFit::Judged judged;
};

/// The six third-order aberrations, m, the glass's power and every state's attitude, distance and principal point, from the thin lens on. `rims`: what
/// vignettes, as lens/optical_vignetting.h has it. None: no convergence, or singular.
std::optional<RealLensAnswer> SolveRealLens(const Task& task, const Geometry& geometry, const Solution& thin, const std::vector<tilt_lens::Rim>& rims);

}

#endif
