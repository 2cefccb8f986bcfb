// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The least squares of one real lens (lens/aberrations.h) in all states: where edges lie and how wide they are, against rays through it.

#ifndef TILTCAL_REAL_LENS_FIT_H
#define TILTCAL_REAL_LENS_FIT_H

#include "solve/joint_fit.h"
#include "solve/real_lens_light.h"

#include <algorithm>
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
	std::array<double, real_lens::RIMS_SIZE> rims{};      ///< of those that `sides` has
	RimSides sides;
	StopRatios stops;
	std::vector<std::array<double, 2>> gradients;         ///< of the lighting of the photographs that are lit alike, by their number
	std::array<double, 2> no_gradient{};                  ///< of the others, held
	bool rims_free = false;
	std::array<bool, tilt_lens::AberrationTerms> free{};  ///< which of c the fit may change
	bool magnification_free = false;
	bool lens_held = false;                               ///< the lens, its stops and the states' tilts

	std::array<double, 2>& GradientOf(const RealLensExposure& exposure) { return exposure.lit_alike ? gradients[*exposure.photo] : no_gradient; }
	const std::array<double, 2>& GradientOf(const RealLensExposure& exposure) const { return exposure.lit_alike ? gradients[*exposure.photo] : no_gradient; }
	/// As a photograph of that stop sees the lens: with its opening, and the rims where they are.
	RealLensNumbers AtStop(size_t stop) const;
	std::vector<RealLensNumbers> AtEveryStop() const;
	std::vector<tilt_lens::Rim> Rims() const;             ///< mm
	Eigen::VectorXd InARow() const;                       ///< lens, c, rims, the states and the logarithms of the further stops one after the other
	Pose& PoseOf(size_t s, size_t p) { return poses[shared_poses ? 0 : s][p]; }
	const Pose& PoseOf(size_t s, size_t p) const { return poses[shared_poses ? 0 : s][p]; }
};

/// Diameter of the light from the point in focus on the axis that this rim lets pass, mm at the entrance pupil: of a lens of that focus (1/mm before it), image distance (mm, of its thin lens) and pupil magnification.
double DiameterOnAxis(const tilt_lens::Rim& rim, double inverse_focus_distance, double w, double pupil_magnification);

/// From the thin lens that was found: its poses, planes, aperture, distortion and field curvature.
RealLensNumbers StartOfRealLens(const Task& task, const Geometry& geometry, const Solution& thin, const std::vector<tilt_lens::Rim>& rims);

struct RealLensFit
{
	const Task& task;
	Rings rings = FEW;
	ModelError error{};
	/// Whether the shape of blurs counts, and what the model leaves out of it. Six numbers leave out most of it: fifth-order spherical aberration shows in it first.
	bool shapes = false;
	std::array<double, SHAPES> shape_error{ 0.03, 0.03 };
	/// Of the residuals, noise and all, as LearnErrors found them.
	EdgeScatter scatter{ 0, 0 };
	std::array<double, SHAPES> shape_scatter{};
	double light_error = 0.02;             ///< what the model leaves out of the logarithm of a patch's light
	std::vector<RealLensExposure> exposures{};
	/// Rims behind the lens stay where they were told when m changes, by which they tell m a little, which edges tell badly; else the shape that they leave of the opening stays.
	bool rims_know_pupils = false;
	/// Standard deviations of what is known of the numbers before: of c, about 0, and of the rims, about `rims_about`; 0: nothing is known.
	std::array<double, tilt_lens::AberrationTerms> likely_c{};
	std::array<double, real_lens::RIMS_SIZE> rims_about{};

	/// Every edge, linear about these numbers, state by state; what the others take.
	std::vector<RealLensEdge> EdgesAbout(const RealLensNumbers& x) const;

	/// As JointFit's.
	std::vector<std::array<double, 2>> Residuals(const std::vector<RealLensEdge>& edges, const RealLensNumbers& x) const;
	double ErrorOfLight(const RealLensNumbers& x) const;
	/// The errors become what is left over, and edges and patches count so.
	void LearnErrors(const std::vector<RealLensEdge>& edges, const RealLensNumbers& x);
	bool Minimise(const std::vector<RealLensEdge>& edges, RealLensNumbers& x, bool coarse) const;

	/// Sigmas in the shape of the numbers themselves, by the edges and by the photographs; and what each photograph is predicted to by the
	/// others, its pose being its own: the RMS of all residuals, in their sigmas.
	struct Judged
	{
		Eigen::MatrixXd by_edges;                    ///< of RealLensNumbers::InARow
		std::optional<Eigen::MatrixXd> by_photographs;
		double held_out = 0;                         ///< 0: cannot be had
		/// Of every number what four halves of the edges (solve/half_of_edges.h), each by itself, are apart from the whole, linear about it, squared and less what the half
		/// scatters itself: the farthest. What the model leaves out is the same in every photograph, by which neither residuals nor photographs scatter.
		Eigen::VectorXd variance_by_parts;
		int parts_without_answer = 0;                ///< halves too few to tell all numbers apart: they say nothing against the whole

		/// By edges or photographs, the larger.
		double Variance(int k) const { return std::max(by_edges(k, k), by_photographs ? (*by_photographs)(k, k) : 0); }
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
	EdgeScatter scatter{ 0, 0 };
	std::optional<std::array<double, SHAPES>> shape_scatter;   ///< where shapes counted
	std::vector<std::array<double, 2>> residuals;   ///< RealLensFit::Residuals
	RealLensFit::Judged judged;
	double held_out_before = 0;   ///< of FitSceneLens: of the lens that it began with, in the same units
};

/// The six third-order aberrations, m, the glass's power and every state's attitude, distance and principal point, from the thin lens on. `rims`: what
/// vignettes, as lens/optical_vignetting.h has it; at most MOST_RIMS of them. None: no convergence, or singular.
std::optional<RealLensAnswer> SolveRealLens(const Task& task, const Geometry& geometry, const Solution& thin, const std::vector<tilt_lens::Rim>& rims);

/// Those of both orders that are significant, by the shapes of blurs too, and the rims, which the light tells together with the edges, from SolveRealLens' answer on.
/// SolveRealLens has all of its six: a tilt without one of them would lack what that one leaves uncertain.
std::optional<RealLensAnswer> SolveSceneLens(const Task& task, const Geometry& geometry, const RealLensNumbers& six);

/// Standard deviations of the fifth-order numbers, mm, 0 before them: at the rim of lens and picture, where the slope is `slope`, a term is likely no more than
/// those terms of the third order are from which it comes by one more P, R or Q.
std::array<double, tilt_lens::AberrationTerms> LikelyFifthOrder(const std::array<double, tilt_lens::AberrationTerms>& c, double slope);

}

#endif
