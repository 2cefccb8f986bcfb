// SPDX-License-Identifier: AGPL-3.0-or-later

#include "oracle_cases.h"
#include "pinholes.h"

#include <stdexcept>

namespace
{

Camera Case(const char* name, double tilt, double tilt_direction)
{
	Camera camera;
	camera.name = name;
	camera.tilt = tilt;
	camera.tilt_direction = tilt_direction;
	return camera;
}

// Another way to say what case `of` says.
Camera Variant(const Camera& of, const char* name)
{
	Camera camera = of;
	camera.name = name;
	camera.truth_of = of.Truth();
	return camera;
}

std::string Block(double focal_distance, double image_distance, double aperture_diameter)
{
	return "focal_distance " + Sdl(focal_distance) + " image_distance " + Sdl(image_distance) + " aperture_diameter " +
		Sdl(aperture_diameter) + " ";
}

// A point of the plane of focus, camera frame, from its offsets right and up of the axis.
Vector OnPlane(const Camera& camera, double x, double y)
{
	const Vector q = LensOf(camera).q;
	return {x, y, (1 - q[0] * x - q[1] * y) / q[2]};
}

void AddPromised(std::vector<Camera>& cameras)
{
	cameras.push_back(Case("zero", 0, 0));
	const Camera up = Case("up", 60, 0);
	const Camera sideways = Case("sideways", 50, 60);
	cameras.push_back(up);
	cameras.push_back(sideways);
	// q_x = -tan(80)/8: the inverse focus distance changes sign at 0.18 right of the axis, the window ends at 0.44.
	cameras.push_back(Case("behind", 80, 90));

	Camera lens = Case("lens", 6, -130);
	lens.tilts_lens = true;
	lens.image_distance = 2;
	lens.location = {0, 2.6, -5.5};
	lens.focal_distance = 9;
	cameras.push_back(lens);

	Camera ground = Case("ground", 0, 0);
	ground.in_world = true;
	ground.point = {3, 0, 5};
	cameras.push_back(ground);

	Camera points = Variant(sideways, "points");
	points.words = "aperture_diameter 0.4 image_distance 1.5 focal_points " + Sdl(InWorld(sideways, OnPlane(sideways, -1, 0.3))) +
		", " + Sdl(InWorld(sideways, OnPlane(sideways, 1.5, -0.5))) + ", " + Sdl(InWorld(sideways, OnPlane(sideways, 0.2, 1)));
	cameras.push_back(points);

	// The camera's words move with `scale`, the block's lengths are the world's.
	Camera scaled = Variant(up, "scaled");
	scaled.scene = scaled.moves = "scale 1e6";
	scaled.words = "focal_plane_tilt 60 " + Block(8e6, 1.5e6, 0.4e6);
	cameras.push_back(scaled);
	Camera huge = Variant(up, "scaled-1e7");
	huge.scene = huge.moves = "scale 1e7";
	huge.words = "focal_plane_tilt 60 " + Block(8e7, 1.5e7, 0.4e7);
	huge.samples = 256;
	cameras.push_back(huge);

	// Location and look_at have x = 0, so this only turns `right` about: the picture is the mirror image, and the angle
	// is counted towards the picture's right.
	Camera mirrored = Variant(sideways, "mirrored");
	mirrored.mirrored = true;
	mirrored.moves = "scale <-1, 1, 1>";
	mirrored.words = "focal_plane_tilt 50 tilt_direction -60 " + Block(8, 1.5, 0.4);
	cameras.push_back(mirrored);
	// The same plane in the world's own words, which mirroring the camera must not move.
	Camera mirrored_points = Variant(mirrored, "mirrored-points");
	mirrored_points.samples = 256;
	Camera plane = Case("", 50, -60);
	mirrored_points.words = "aperture_diameter 0.4 image_distance 1.5 focal_points ";
	for (const auto& [x, y] : {std::pair{-1.0, 0.3}, std::pair{1.5, -0.5}, std::pair{0.2, 1.0}})
	{
		Vector P = OnPlane(plane, x, y);
		P[0] = -P[0];
		mirrored_points.words += Sdl(InWorld(plane, P)) + (x == 0.2 ? "" : ", ");
	}
	cameras.push_back(mirrored_points);

	Camera sheared = Case("sheared", 55, 35);
	sheared.up_x = 0.3;
	sheared.centre_x = 0.12;
	sheared.centre_y = -0.045;
	cameras.push_back(sheared);
}

void AddOtherWords(std::vector<Camera>& cameras)
{
	// focal_length and f_stop instead of image_distance and aperture_diameter: 1/f = |q + e_z/w|.
	const Camera up = Case("up", 60, 0);
	const Vector power = Plus(LensOf(up).q, {0, 0, 1 / up.image_distance});
	const double f = 1 / std::sqrt(Dot(power, power));
	Camera length = Variant(up, "focal-length");
	length.words = "focal_plane_tilt 60 focal_distance 8 focal_length " + Sdl(f) + " f_stop " + Sdl(f / up.aperture_diameter);
	length.samples = 256;
	cameras.push_back(length);

	Camera angle = Case("angle", -55, 20);
	angle.angle = 50;
	angle.image_distance = 0.8;
	angle.samples = 256;
	cameras.push_back(angle);

	// Placed by transformations alone, with a tilt on top: the block's lengths and angles must not be moved twice.
	Camera transformed = Case("transformed", 55, 200);
	transformed.location = {0, 0, 0};
	transformed.look_at = {0, 0, 1};
	transformed.moves = "rotate <12, 0, 15> rotate y * -20 translate <2.5, 3, -3>";
	transformed.samples = 256;
	cameras.push_back(transformed);
	// focal_point is a word of the camera: it moves with it.
	Camera focal_point = Variant(transformed, "focal-point");
	focal_point.words = "focal_plane_tilt 55 tilt_direction 200 image_distance 1.5 aperture_diameter 0.4";
	focal_point.outside = "focal_point " + Sdl(OnPlane(transformed, 1.5, 0.5));
	cameras.push_back(focal_point);
	// A camera of 1e-7: its window is that small, with `angle` the sensor, aperture and plane of focus are not. (A whole
	// scene of that size is beyond POV-Ray, whose intersections begin at 1e-4: stock misses two pixels of three there.)
	Camera tiny = Variant(transformed, "tiny");
	tiny.moves = "scale 1e-7 " + transformed.moves;
	tiny.angle = 2 * std::atan(ASPECT / 2 / transformed.image_distance) / Radians(1);
	cameras.push_back(tiny);
}

void AddHard(std::vector<Camera>& cameras)
{
	// Parallel to the axis: q = (0, -1/2.6, 0), kappa = 0 along the picture's middle row.
	Camera parallel = Case("parallel", 0, 0);
	parallel.in_world = true;
	parallel.look_at = {0, 2.6, 6};
	parallel.samples = 256;
	cameras.push_back(parallel);
	// The hinge at the same place, the plane 0.001 degrees from parallel: q differs by 1.7e-5 in z, which moves no
	// ray by more than 1e-4 pixels.
	Camera near_parallel = Variant(parallel, "tilt-89.999");
	near_parallel.in_world = false;
	near_parallel.words = "focal_plane_tilt 89.999 " + Block(2.6 * std::tan(Radians(89.999)), 1.5, 0.4);
	cameras.push_back(near_parallel);
	Camera near_back = Variant(near_parallel, "tilt-minus-89.999");
	near_back.words = "focal_plane_tilt -89.999 " + Block(-2.6 * std::tan(Radians(89.999)), 1.5, 0.4);
	cameras.push_back(near_back);

	// Focused at infinity: nothing is sharp, and the blur is the aperture itself, hence the small one.
	Camera infinity = Case("infinity-1e30", 0, 0);
	infinity.focal_distance = 1e30;
	infinity.aperture_diameter = 0.2;
	infinity.samples = 256;
	cameras.push_back(infinity);

	// A virtual focus, all of the plane behind the lens: 1/f = 1/w + 1/U, and U < 0 < f. With image_distance given this
	// is the only U below f (f is below w and U when both are positive); with focal_length given it is refused.
	Camera virtual_focus = Case("virtual-focus", 30, 45);
	virtual_focus.focal_distance = -20;
	virtual_focus.aperture_diameter = 0.2;
	virtual_focus.samples = 256;
	cameras.push_back(virtual_focus);

	// The lens plane cuts through the picture: what looks along or behind it (y > 1/tan(75) = 0.268 of 0.333) is empty.
	Camera grazing = Case("grazing", 75, 0);
	grazing.tilts_lens = true;
	grazing.aperture_diameter = 0.2;
	grazing.samples = 256;
	cameras.push_back(grazing);
}

// Effects that stock POV-Ray can show too: from chosen lens points, through a rim that stands before the lens, or
// one colour at a time.
void AddEffects(std::vector<Camera>& cameras)
{
	Camera blades = Case("blades", 60, 0);
	blades.blades = 5;
	blades.blade_rotation = 20;
	blades.effects = "blades 5 rotation 20";
	blades.samples = 256;
	cameras.push_back(blades);

	// At the picture's edges the lens is half covered, in its corners more.
	Camera cat_eye = Case("cat-eye", 12, 180);
	cat_eye.tilts_lens = true;
	cat_eye.rim_radius = 0.25;
	cat_eye.rim_distance = 0.7;
	cat_eye.effects = "vignetting optical 0.25, 0.7";
	cat_eye.samples = 256;
	cameras.push_back(cat_eye);

	// Rims on both sides, as real lenses have them, here the rear one halfway to the sensor; each alone takes a third of the corners.
	Camera rims = cat_eye;
	rims.name = "two-rims";
	rims.tilt_direction = 60;
	rims.rear_radius = 0.34;
	rims.rear_distance = 0.7;
	rims.rim_radius = 0.3;
	rims.cell_limit = 0.0012; // two hard edges in 512 frames: 0.0010 (one, in cat-eye: 0.00096)
	rims.effects = "vignetting optical 0.3, 0.7, 0.34, -0.7";
	cameras.push_back(rims);

	// Coarse enough to show: the colours part by up to 3 pixels, and their planes of focus lie at 1/(1/8 + A).
	Camera chromatic = Case("chromatic", 10, 40);
	chromatic.tilts_lens = true;
	chromatic.lateral[0] = -0.015;
	chromatic.lateral[2] = 0.02;
	chromatic.axial[0] = -0.03;
	chromatic.axial[2] = 0.06;
	chromatic.effects = "chromatic lateral -0.015, 0.02 axial -0.03, 0.06";
	chromatic.samples = 256;
	chromatic.frames = 256; // three times
	cameras.push_back(chromatic);

	Camera together = blades;
	together.name = "effects-together";
	together.frames = 256;
	together.cell_limit = 0.0022; // the rim's hard edge in so few frames: 0.0017; 1024 frames of twice the aperture: 0.0007
	together.rim_radius = 0.25;
	together.rim_distance = 0.6;
	together.aperture_diameter = 0.2; // less noise, so that fewer frames do
	for (int c : {0, 2})
	{
		together.lateral[c] = -chromatic.lateral[c];
		together.axial[c] = -chromatic.axial[c];
	}
	together.effects = "vignetting optical 0.25, 0.6 blades 5 rotation 20 chromatic lateral 0.015, -0.02 axial 0.03, -0.06";
	cameras.push_back(together);
}

}

std::vector<Camera> OracleCameras()
{
	std::vector<Camera> cameras;
	AddPromised(cameras);
	AddOtherWords(cameras);
	AddHard(cameras);
	AddEffects(cameras);
	return cameras;
}

Camera OracleCamera(const std::string& name)
{
	for (const Camera& camera : OracleCameras())
		if (camera.name == name)
			return camera;
	throw std::runtime_error("no case '" + name + "'");
}
