// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pictures of flat patterns through real glass: from each pixel through points of the exit pupil and every surface of a prescription to
// the board, the mean of what is seen there. No formula of a blur, of aberrations or of a thin lens is in it. The sibling of
// thin_lens_picture.h, with its patterns.

#ifndef TILTCAL_TRACED_PICTURE_H
#define TILTCAL_TRACED_PICTURE_H

#include "prescription/mount.h"
#include "support/thin_lens_picture.h"

namespace synthetic
{

struct TracedScene
{
	tiltcal::Prescription glass;             ///< at its size, its stop closed as it is to be (StoppedTo)
	tiltcal::Sensor sensor;
	tiltcal::GlassState state;               ///< FocusedBackDistance says where the sensor stands
	/// Board to camera: x right, y down, z forward, the origin in the entrance pupil (near the axis) of the lens while untilted.
	Eigen::Matrix3d camera_from_board = Eigen::Matrix3d::Identity();
	Eigen::Vector3d origin{ 0, 0, 500 };
	double exposure = 1;                     ///< value of light 1 in the middle of the picture, the lens untilted; clipped at 1
	double noise = 0;                        ///< standard deviation, linear light
	unsigned seed = 1;
	bool eight_bit = false;                  ///< sRGB-coded, rounded and decoded
	int rays = 200;                          ///< a pixel, where it sees more than one shade
	cv::Rect part{};                         ///< only these pixels are traced, the others 0; empty: all
};

/// CV_32FC1, linear light, of the sensor's size.
cv::Mat TakeTracedPicture(const TracedScene& scene, const Pattern& pattern);

/// Where the middle of the stop sees (x, y) of the board, px: the ray through the stop's centre, found by steps.
Eigen::Vector2d TracedPixelOf(const TracedScene& scene, double x, double y);

}

#endif
