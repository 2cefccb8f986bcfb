// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What stands where around a calibrated camera: the shapes of the report's sketch.

#ifndef TILTCAL_SCENE_PARTS_H
#define TILTCAL_SCENE_PARTS_H

#include <tiltcal/calibration.h>

#include <array>
#include <vector>

namespace tiltcal
{

using Polygon = std::vector<Vec3<double>>;

struct BoardPart
{
	Polygon outline;                                      ///< four corners
	std::vector<std::array<Vec3<double>, 2>> sharp;       ///< where the board meets the surface of focus
};

/// One state. Camera frame (x right, y up, z forward, origin at the lens centre), mm. Without the
/// distortion, which a sketch of this size does not show.
struct SceneParts
{
	Vec3<double> q{ 0, 0, 0 }, lens_normal{ 0, 0, 1 };
	double field_curvature = 0, w = 0, d = 0;
	double far = 0;                                ///< depth to which it is drawn
	Vec3<double> tilt_up{ 0, 1, 0 };               ///< unit, in the sensor plane: the direction in which the plane recedes
	std::array<Vec3<double>, 4> corner_rays{};     ///< directions of the picture's corners, z = 1
	std::vector<Polygon> focus;                    ///< the surface of focus inside the frustum
	Polygon focus_section;                         ///< its section with the plane of the axis and tilt_up; empty where it is out of reach
	std::vector<BoardPart> boards;                 ///< by photograph
	bool has_hinge = false;
	/// Point, nearest to the lens, of the line in which the plane of focus meets the plane through the lens centre
	/// parallel to the sensor (Merklinger's hinge).
	Vec3<double> hinge{ 0, 0, 0 };
};

SceneParts MakeScene(const Calibration& calibration, size_t state);

}

#endif
