// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Cameras as COLMAP's cameras.txt has them (its documentation, "Output format" and "Camera models").

#ifndef TILTCAL_COLMAP_H
#define TILTCAL_COLMAP_H

#include <tiltcal/camera.h>

#include <string>

namespace tiltcal
{

/// COLMAP's FULL_OPENCV, whose distortion is about the camera's own z axis. Pixels as COLMAP counts them: (0.5, 0.5) is the centre of the
/// top left one.
struct ColmapCamera
{
	double fx = 0, fy = 0;
	Point centre{};
	Distortion distortion{};       ///< k4, k5, k6 are 0
	double rms_px = 0, worst_px = 0;   ///< over the picture, what the camera sees elsewhere: 0 for an untilted lens
};

/// Our camera frame with y down is COLMAP's. Of an untilted lens it is exact; of a tilted one, whose distortion is about another axis, the
/// best by least squares over the picture.
ColmapCamera ToColmap(const StateCamera& camera);

/// cameras.txt with this one camera, CAMERA_ID 1.
std::string ColmapText(const StateCamera& camera);

}

#endif
