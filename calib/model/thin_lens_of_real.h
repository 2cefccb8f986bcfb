// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_THIN_LENS_OF_REAL_H
#define TILTCAL_THIN_LENS_OF_REAL_H

namespace tiltcal
{

/// One standard deviation of the logarithm of a pupil magnification that nobody told, about 1: double Gauss 0.9 to 1.1, telephoto lenses down to 0.5, retrofocus
/// ones up to 2, which are two of it.
const double PUPIL_MAGNIFICATION_SIGMA = 0.35;

/// |q + e_z / w|, 1/mm, of the thin lens that does near its axis what one of the power 1/f and the pupil magnification m does
/// (povray-patch/lens/MODEL.md, Real lenses). normal_z: of the unit lens normal, along the sensor's; w_mm: a thin lens's, the exit pupil
/// stands m w before the sensor.
template<typename T>
inline T PowerOfThinLens(const T& m, const T& power, const T& normal_z, const T& w_mm) { return m * power - (m - T(1)) * normal_z / w_mm; }

/// The other way round: f, mm, of a real lens of the pupil magnification m that does near its axis what a thin one of `thin_power` does.
inline double FocalLengthOfReal(double m, double thin_power, double normal_z, double w_mm) { return m / (thin_power + (m - 1) * normal_z / w_mm); }

/// Along the sensor's normal to the plane of focus of a thin lens of that power, mm; infinite or negative: at infinity, beyond.
inline double FocusOfThinLens(double power, double normal_z, double w_mm) { return 1 / (power * normal_z - 1 / w_mm); }

}

#endif
