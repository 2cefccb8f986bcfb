// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The least squares of vignetting: the brightness of evenly bright patches against the two effects of
// lens/natural_vignetting.h and lens/optical_vignetting.h. In logarithms, so that exposure and lighting add:
//   log value = gain of the photograph + gradient of its lighting . place + log natural fall-off + log open share(R, Z)

#ifndef TILTCAL_FALLOFF_FIT_H
#define TILTCAL_FALLOFF_FIT_H

#include "effects/pupil_opening.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace tiltcal
{

/// One patch, and how the lens sees it.
struct FalloffSample : PixelView
{
	size_t gain = 0;            ///< which number stands for its exposure
	size_t light = 0;           ///< which pair of numbers for the gradient of its lighting
	double place[2] = { 0, 0 }; ///< on the surface, about -1 to 1
	double log_natural = 0;     ///< of NaturalFalloff
	double log_value = 0;
	double sigma = 0;           ///< of log_value
};

struct FalloffFit;
/// Log of what the natural fall-off, where the fit has it, and the rims leave of a patch's light.
double LogLight(const FalloffFit& fit, const FalloffSample& sample, const std::vector<tilt_lens::Rim>& rims);

struct FalloffUnknowns
{
	double rim[2] = { 0, 0 };   ///< log R, log Z; R and Z in mm
	std::vector<double> gain;
	std::vector<std::array<double, 2>> gradient;
};

struct FalloffFit
{
	std::vector<FalloffSample> samples;
	double lens_radius = 0;     ///< mm, at the reference stop
	bool natural = true, optical = true;
	std::vector<tilt_lens::Rim> rims;   ///< mm; where there are any, they stand instead of the unknown one, and `optical` is false
	double image_distance = 0;  ///< w, mm
	bool gradients = true;      ///< else the light is even
	double model_sigma = 0.02;  ///< robust scatter of log_value, noise and all

	/// Log of the part that the effects leave of a patch's light.
	double Effects(const FalloffSample& sample, const double* rim) const;
	/// Predicted minus measured log_value.
	double Residual(const FalloffSample& sample, const FalloffUnknowns& x) const;

	/// Gains and gradients for the rim that x has, by weighted least squares.
	void SolveLighting(FalloffUnknowns& x) const;

	/// Robust fit from x, in place. Returns the final cost, none without convergence.
	std::optional<double> Minimise(FalloffUnknowns& x) const;

	/// Fit from several starts, twice: with model_sigma as it is, then with what is left over, which it becomes. The cost
	/// has kinks where the rim begins to cut. False: no convergence.
	bool Search(double focal_length, FalloffUnknowns& x);

	/// Covariance of log R and log Z, rescaled by the residuals. False: singular, as where the rim cuts nothing.
	bool Covariance(FalloffUnknowns& x, Eigen::Matrix2d& covariance) const;
};

}

#endif
