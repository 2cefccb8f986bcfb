// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What evenly bright patches say of a real lens and its rims: the light that the sensor gets through what they leave of the opening, of which every point of the
// exit pupil sends
//   dE = L cos(theta_lens) cos(theta_sensor) / r^2 dA
// (Lambert's law, as lens/natural_vignetting.h has it for a small opening).

#ifndef TILTCAL_REAL_LENS_LIGHT_H
#define TILTCAL_REAL_LENS_LIGHT_H

#include "solve/moving_rays.h"

#include <tiltcal/task.h>

#include <Eigen/Core>
#include <ceres/cost_function.h>

#include <optional>
#include <vector>

namespace tiltcal
{

/// Sides of the rims that there are: 1 before the entrance pupil, -1 behind the exit pupil.
using RimSides = std::vector<int>;

/// Derivatives by the numbers of a ray (solve/moving_rays.h) and the rims.
const int LIGHT_NUMBERS = RAY_NUMBERS + real_lens::RIMS_SIZE;
using ByLight = Eigen::Matrix<double, LIGHT_NUMBERS, 1>;

/// Log of the light of one place of the picture, but for a constant. `opening`: its radius as the entrance pupil's, mm. `moving`: the rays to the same place; then `by` receives the derivatives.
double LogLightThroughRims(const MountedLens<double>& mounted, double opening, const double* rims, const RimSides& sides, const MovingRays* moving = nullptr, ByLight* by = nullptr);

/// The patches of one exposure. Its gain, and the gradient of its lighting where that is its own, are projected out of the residuals.
struct RealLensPatches
{
	struct Patch { double u, v, place[2], log_value, sigma, weight; };
	std::vector<Patch> patches;
	Eigen::MatrixXd basis;           ///< orthonormal columns: what is projected out, in weighted residuals
	double r, pitch_mm;
	RimSides sides;

	/// Log of the light by the lens minus what was measured, gain and gradient not taken out, not weighted. `by`: a patch a row, by LIGHT_NUMBERS; that by `gradient` is the patch's place.
	Eigen::VectorXd See(const double* state, const double* lens, const double* c, const double* rims, const double* gradient, Eigen::MatrixXd* by = nullptr) const;
};

/// The residuals of patches as the fit counts them: weighted, without what is projected out, and beyond 3 sigma as Huber's cost does. Blocks: state, lens, c, rims, gradient.
class RealLensLightCost final : public ceres::CostFunction
{
public:
	/// `patches` outlive this.
	explicit RealLensLightCost(const RealLensPatches& patches);

	bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

private:
	const RealLensPatches& light;
};

/// Of all exposures with their lens's state, in one order: the flat fields where there are any, else the photographs' white squares.
struct RealLensExposure
{
	size_t state;
	std::optional<size_t> photo;     ///< none: a flat field
	bool lit_alike;                  ///< its gradient is that of the photograph of the same number in the other states
	RealLensPatches light;
	size_t stop = 0;                 ///< of the task; a flat field is of the reference
};
std::vector<RealLensExposure> ExposuresOf(const Task& task, bool shared_poses, double r, const RimSides& sides);

/// Sets the patches' weights, `error` being what the model leaves out of each, and what is projected out.
void Weigh(double error, RealLensExposure& exposure);

}

#endif
