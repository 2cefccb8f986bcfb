// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the camera files of a calibration have in common: the photographs' places, and the macros about a camera block.

#ifndef TILTCAL_CAMERA_MACROS_H
#define TILTCAL_CAMERA_MACROS_H

#include <tiltcal/calibration.h>
#include <tiltcal/frames.h>

#include <string>
#include <vector>

namespace tiltcal
{

/// "<x, y, z>"
std::string SdlVector(const Vec3<double>& v, int digits = 9);

/// `#declare`s of where the camera stood, board frame: PREFIX_Photo_1_Location, .., and arrays of all.
std::string PhotoPoses(const std::string& prefix, const std::vector<Photo>& photos, const std::vector<Pose>& poses);

/// `#declare`s of the diameter of every stop, by its f-number, PREFIX_Aperture_Diameter_f5_6, and how to take one; `aperture_mm` is the reference's. Empty: there is but one.
std::string StopDeclares(const std::string& prefix, const std::vector<Stop>& stops, const std::vector<Estimate>& ratios, double aperture_mm);

/// PREFIX(Location, Look_At, Sky) about the block, PREFIX_Body, PREFIX_Pose. `centre`: what Location is.
std::string CameraMacros(const std::string& prefix, const std::string& centre, const std::string& block);

/// PREFIX_Body alone.
std::string BodyMacro(const std::string& prefix);

/// POV-Ray has no infinity, a length of 1e30 mm is one; and no -0.
double SdlNumber(double value);

/// The lines location, direction, right, up, sky and look_at of such a block.
std::string MacroPlace(const std::string& prefix, double width_mm, double height_mm);

}

#endif
