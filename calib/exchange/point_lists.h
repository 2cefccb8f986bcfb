// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Lists of points through a camera, as CSV.

#ifndef TILTCAL_POINT_LISTS_H
#define TILTCAL_POINT_LISTS_H

#include <tiltcal/camera.h>

#include <string>

namespace tiltcal
{

/// Reads x,y,z (camera frame, mm; `file` "-": standard input) and gives x,y,z,u_px,v_px,blur_px; behind the lens the last three are empty.
/// Throws FileError with file:line.
std::string ProjectedPoints(const StateCamera& camera, const std::string& file);

/// Reads u_px,v_px and gives u_px,v_px,x,y,z,focus_z_mm: the unit direction of what the pixel sees, camera frame, and the depth z of what is in
/// focus on it (maps.h). Throws FileError with file:line.
std::string UnprojectedPixels(const StateCamera& camera, const std::string& file);

}

#endif
