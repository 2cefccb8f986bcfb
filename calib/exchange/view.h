// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What renderers without a tilted lens take of a camera.

#ifndef TILTCAL_VIEW_H
#define TILTCAL_VIEW_H

#include <tiltcal/camera.h>

#include <array>
#include <optional>

namespace tiltcal
{

/// The pinhole's view without distortion, and the surface of focus as a plane. Camera frame, mm.
struct View
{
	double width_mm = 0, height_mm = 0;       ///< of the sensor
	double shift_x_mm = 0, shift_y_mm = 0;    ///< of the picture's centre from the principal axis, x right, y up
	Vec3<double> centre{ 0, 0, 1 };           ///< direction of the picture's centre, z = 1
	double focus_depth_mm = 0;                ///< z of what is in focus in the picture's centre; infinite; < 0: nothing in front of the lens
	std::array<Vec3<double>, 3> in_focus{};   ///< three points of the plane of focus, where `has_plane`
	/// A square of that plane about its point in the picture's centre, or about its point nearest to the lens where that has none.
	std::array<Vec3<double>, 4> square{};
	bool has_plane = false;                   ///< not at infinity
};

View ViewOf(const StateCamera& camera);

/// A name of letters, digits and _ for other programs' scenes: "tiltcal_" and the state's.
std::string SceneName(const StateCamera& camera);

/// 15 digits: what the scene languages read back to the last of a double but one.
std::string SceneNumber(double value);

}

#endif
