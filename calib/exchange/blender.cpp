// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/scene_files.h"

#include "base/plain_text.h"
#include "exchange/view.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

/// Beyond it nothing of a scene is out of focus, mm.
const double FARTHEST_FOCUS_MM = 1e8;

/// Blender's camera looks along -z, x right, y up.
std::string Vertex(const Vec3<double>& P) { return fmt::format("({}, {}, {})", SceneNumber(P.x), SceneNumber(P.y), SceneNumber(-P.z)); }

std::string PlaneLines(const View& view, const StateCamera& c)
{
	if (!c.KnowsFocus())
		return "# Aperture and plane of focus are unknown: everything is sharp.\n";
	if (!view.has_plane)
		return "# The plane of focus is at infinity.\n";
	std::string vertices;
	for (const Vec3<double>& P : view.square)
		vertices += Vertex(P) + ", ";
	return fmt::format("# The plane of focus, part of it, as the camera's child: seen while you work, not rendered.\n"
		"vertices_mm = [{}]\n"
		"mesh = bpy.data.meshes.new(NAME + \" plane of focus\")\n"
		"mesh.from_pydata([tuple(x / UNIT_MM for x in vertex) for vertex in vertices_mm], [], [(0, 1, 2, 3)])\n"
		"plane = bpy.data.objects.new(NAME + \" plane of focus\", mesh)\n"
		"plane.parent = placed\n"
		"plane.display_type = \"WIRE\"\n"
		"plane.hide_render = True\n"
		"scene.collection.objects.link(plane)\n", vertices.substr(0, vertices.size() - 2));
}

}

std::string BlenderScript(const StateCamera& c, double unit_mm)
{
	const View view = ViewOf(c);
	const double depth = view.focus_depth_mm > 0 && view.focus_depth_mm < FARTHEST_FOCUS_MM ? view.focus_depth_mm : FARTHEST_FOCUS_MM;
	std::string out = fmt::format("# The camera of state {}, by tiltcal {}. In Blender: Scripting, open this file, Run; or blender --python FILE.\n"
		"# Not in it: the tilt (Cycles has none: what is sharp is what a lens along the camera's axis makes sharp, and the plane of focus is an\n"
		"# object to look at), the distortion (tiltcal export --stmap), the lens's other effects{}.\n"
		"import math\n\nimport bpy\nfrom mathutils import Matrix\n\n"
		"NAME = \"{}\"\n"
		"UNIT_MM = {}    # millimetres of a unit of the scene\n\n"
		"scene = bpy.context.scene\n"
		"scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = {}, {}, 100\n"
		"scene.render.pixel_aspect_x = scene.render.pixel_aspect_y = 1\n\n",
		OneLine(c.state), TILTCAL_VERSION, LostBlades(c, MOST_BLENDER_BLADES), SceneName(c), SceneNumber(unit_mm), c.width, c.height);
	out += fmt::format("camera = bpy.data.cameras.new(NAME)\n"
		"camera.type, camera.sensor_fit = \"PERSP\", \"HORIZONTAL\"\n"
		"camera.sensor_width, camera.sensor_height = {}, {}    # mm\n"
		"camera.lens = {}    # mm: the image distance, from the lens to the sensor\n"
		"camera.shift_x, camera.shift_y = {}, {}    # in widths of the sensor\n"
		"camera.clip_start, camera.clip_end = 1 / UNIT_MM, 1e6 / UNIT_MM    # a millimetre, a kilometre\n",
		SceneNumber(view.width_mm), SceneNumber(view.height_mm), SceneNumber(c.image_distance_mm), SceneNumber(view.shift_x_mm / view.width_mm),
		SceneNumber(view.shift_y_mm / view.width_mm));
	if (c.KnowsFocus())
		out += fmt::format("camera.dof.use_dof = True\n"
			"camera.dof.focus_distance = {} / UNIT_MM    # depth of what is in focus in the picture's centre\n"
			"# Blender's opening is lens / 1000 / f-stop units wide: {} mm.\n"
			"camera.dof.aperture_fstop = camera.lens * UNIT_MM / 1000 / {}\n"
			"camera.dof.aperture_blades = {}\n",
			SceneNumber(depth), SceneNumber(c.aperture_diameter_mm), SceneNumber(c.aperture_diameter_mm), c.blades.count > MOST_BLENDER_BLADES ? 0 : c.blades.count);
	return out + "\nplaced = bpy.data.objects.new(NAME, camera)\n"
		"placed.matrix_world = Matrix.Rotation(math.radians(90), 4, \"X\")    # at the origin, looking along +y, z up\n"
		"scene.collection.objects.link(placed)\n"
		"scene.camera = placed\n\n" + PlaneLines(view, c);
}

}
