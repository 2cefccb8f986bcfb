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

/// The one place that writes camera blocks. Sets blur_samples by TiltCal_Blur_Samples, which
/// BlurSamplesDefault declares. Ends with a line end.
std::string CameraBlockText(const CameraBlock& block);

/// `#ifndef`, to be put before the first block of a file.
std::string BlurSamplesDefault();

}

#endif
