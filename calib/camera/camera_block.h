// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_CAMERA_BLOCK_H
#define TILTCAL_CAMERA_BLOCK_H

#include <string>

namespace tiltcal
{

/// The values of a `camera { tilt_lens { .. } .. }` block as POV-Ray shall read them: numbers
/// or identifiers. Lengths in world units, angles in degrees.
struct CameraBlock
{
	/// "focal_plane_tilt A", or "lens_tilt A", which states a focus at infinity too.
	std::string tilt;
	std::string tilt_direction, focal_distance, image_distance, shift_x, shift_y, aperture_diameter;
	std::string effects;   ///< lines of the tilt_lens block, each indented by two tabs and ended
	std::string place;     ///< lines: location, direction, right, up, .., each indented by one tab and ended
};

/// The effects of a tilt_lens block: numbers or identifiers behind the word; empty: the word is absent.
struct EffectWords
{
	std::string field_curvature;
	std::string distortion;        ///< k1, k2, p1, p2, k3
	std::string distortion_only_if;   ///< a condition, for `#if`; empty: always
	bool natural_vignetting = false;
	std::string optical_vignetting;   ///< R, Z of every rim
	std::string optical_only_if;   ///< as distortion_only_if
	std::string lateral, axial;    ///< red, blue
	std::string blades;            ///< N rotation A curvature C
};

/// Lines for CameraBlock::effects.
std::string EffectLines(const EffectWords& words);

/// The one place that writes camera blocks. Sets blur_samples by TiltCal_Blur_Samples, which
/// BlurSamplesDefault declares. Ends with a line end.
std::string CameraBlockText(const CameraBlock& block);

/// `#ifndef`, to be put before the first block of a file.
std::string BlurSamplesDefault();

}

#endif
