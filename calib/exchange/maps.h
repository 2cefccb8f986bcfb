// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Cameras as pictures: STMaps and rays.

#ifndef TILTCAL_MAPS_H
#define TILTCAL_MAPS_H

#include "exchange/flat_view.h"

#include "base/file_set.h"

#include <string>

namespace tiltcal
{

/// STMaps as Nuke, Fusion, Flame and Blender read them: channel R is x, G is y, 0 to 1 over the picture that is looked up, 0 its left and
/// BOTTOM edge, so that pixel (i, j) of W x H has ((i + 0.5) / W, 1 - (j + 0.5) / H). -1: outside. B is 0.
/// STEM-undistort.exr: for every pixel of the flat view, where the photograph shows it. STEM-redistort.exr: for every pixel of the photograph,
/// where the flat view shows it. Returns SharePictured.
double WriteStMaps(const StateCamera& camera, const Margins& margins, const std::string& stem, FileSet& set);

/// For every pixel of the photograph, ray.X, ray.Y, ray.Z: the unit direction of what it sees through the lens centre, camera frame
/// (frames.h: x right, y up, z forward); focus.Z: depth z of the point on that line which is in focus, mm, on the bowl where there is one:
/// infinite for a line along the surface, < 0 where it meets that behind the lens only.
void WriteRayMap(const StateCamera& camera, const std::string& file, FileSet& set);

/// Depth z, mm, of the point in focus on the line of direction v (v.z > 0) through the lens centre; as in WriteRayMap.
double FocusDepth(const StateCamera& camera, const Vec3<double>& v);

}

#endif
