// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `chromatic`: a lens has not quite the same focal length and magnification
// for every colour. Three wavelengths stand for red, green and blue; green is the one
// that all other words mean.
//   lateral CR, CB   the image of red (blue) is (1 + C) times as large as that of green,
//                    about the lens axis; after the distortion, ideal -> image
//   axial AR, AB     the power of the lens for red (blue) is 1/f + A, in 1/length; the lens
//                    equation n/f = q + e_z/w then moves its plane of focus to q + A n

#ifndef TILT_LENS_CHROMATIC_H
#define TILT_LENS_CHROMATIC_H

#include "lens/vec3.h"

namespace tilt_lens
{

/// The order of the colours' channels.
enum Wavelength { RedWavelength, GreenWavelength, BlueWavelength, Wavelengths };

/// The direction, on the scene's side, of what a pixel of direction v (v.n > 0, any length)
/// sees in a colour whose image is (1 + lateral) times as large; v.n is kept. n unit.
/// Domain: lateral > -1.
template<typename T>
inline Vec3<T> LateralDirection(const Vec3<T>& n, const T& lateral, const Vec3<T>& v)
{
	const Vec3<T> along = Dot(v, n) * n;
	return along + (T(1) / (T(1) + lateral)) * (v - along);
}

/// kappa in a colour for which the lens has `axial` more power.
template<typename T>
inline T AxialFocus(const Vec3<T>& n, const T& axial, const Vec3<T>& v, const T& kappa)
{
	return kappa + axial * Dot(v, n);
}

}

#endif
