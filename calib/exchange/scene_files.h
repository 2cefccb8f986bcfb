// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The camera in other renderers' words. What none of them holds is said in the files: the distortion (STMaps do), and where a program has
// no tilted lens, the tilt.

#ifndef TILTCAL_SCENE_FILES_H
#define TILTCAL_SCENE_FILES_H

#include <tiltcal/camera.h>

#include <string>

namespace tiltcal
{

/// Most blades that Blender takes.
const int MOST_BLENDER_BLADES = 16;

/// What of a camera's blades a program that takes their number, `most` of them, does not get, as ", ..."; empty where there is nothing.
std::string LostBlades(const StateCamera& camera, int most);

/// A script for Blender (bpy): camera with sensor, shift and aperture, resolution, and the plane of focus as an object, its child. `unit_mm`:
/// millimetres of a unit of the scene.
std::string BlenderScript(const StateCamera& camera, double unit_mm);

/// A RIB block for RenderMan's PxrCamera, which is given three points of the plane of focus. The camera is at the world's origin.
std::string RenderManText(const StateCamera& camera, double unit_mm);

/// options and persp_camera for Arnold's .ass. The camera is at the world's origin and looks along -z.
std::string ArnoldText(const StateCamera& camera, double unit_mm);

}

#endif
