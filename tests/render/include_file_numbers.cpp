// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The numbers of tilt_lens.inc, as include_file.pov writes them down, against the renderer's own lens (povray-patch/lens): its
// tilt and image distance are those of the lens that ResolveTiltLens makes of the same words, and at the edges of what is
// sharp the blur, by SignedBlurWidth, is the circle of confusion.
//
//   include_file_numbers FILE

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lens/angles.h"
#include "lens/lens_spec.h"
#include "lens/optics.h"

namespace
{

using namespace tilt_lens;

// POV-Ray's vectors are doubles, but its expressions go through 17 printed decimals of numbers down to 1e-3 and through
// differences of inverse distances: ten digits are left.
const double Tolerance = 1e-9;

int failures = 0;

void Expect(const char* what, const std::string& line, double found, double expected)
{
	if(std::fabs(found - expected) <= Tolerance * std::fabs(expected))
		return;
	std::printf("%s: %.17g, but the lens says %.17g, for %s\n", what, found, expected, line.c_str());
	failures++;
}

/// The lens of a camera that looks along `axis` and is focused on a plane.
TiltLens LensOf(double focal_length, double f_number, const Vec3d& location, const Vec3d& axis, const Vec3d& point, const Vec3d& normal)
{
	const Vec3d aside = std::fabs(axis.x) < 0.7 ? Vec3d{ 1.0, 0.0, 0.0 } : Vec3d{ 0.0, 1.0, 0.0 };
	const Vec3d right = Normalized(Cross(aside, axis));
	LensSpec spec;
	spec.enabled = spec.right_given = true;
	spec.focal_plane_point = point;
	spec.focal_plane_normal = normal;
	spec.focal_length = focal_length;
	spec.f_stop = f_number;
	const CameraVectors camera = { location, axis, focal_length * right, focal_length * Cross(axis, right) };
	TiltLens lens;
	std::string error;
	if(!ResolveTiltLens(spec, camera, lens, error))
	{
		std::printf("no lens: %s\n", error.c_str());
		failures++;
	}
	return lens;
}

/// A point of the plane { P : q.P = 1 } on the ray along v, in the frame of q.
Vec3d PointAlong(const Vec3d& q, const Vec3d& v) { return (1.0 / Dot(q, v)) * v; }

void CheckDepth(const std::string& line, const std::vector<double>& n)
{
	const double mm = n[0], f = n[1] * mm, N = n[2], c = n[3] * mm, U = n[4], hyperfocal = n[5], near = n[6], far = n[7];
	const Vec3d origin = { 0.0, 0.0, 0.0 }, axis = { 0.0, 0.0, 1.0 };
	const TiltLens lens = LensOf(f, N, origin, axis, U * axis, axis);
	const auto blur = [&](const TiltLens& l, double z) { return SignedBlurWidth(l.image_distance, l.aperture_diameter, l.inverse_focus_camera, Vec3d{ 0.0, 0.0, z }); };
	Expect("blur at TL_Near", line, blur(lens, near), c);
	if(far < 0.9e30)
		Expect("blur at TL_Far", line, blur(lens, far), -c);
	else if(!(blur(lens, 1e30) > -c * (1.0 + Tolerance)))
		Expect("blur at infinity", line, blur(lens, 1e30), -c);
	// Focused at the hyperfocal distance, what is infinitely far is blurred by c.
	Expect("blur at infinity, focused at TL_Hyperfocal", line, blur(LensOf(f, N, origin, axis, hyperfocal * axis, axis), 1e30), -c);
}

void CheckPlane(const std::string& line, const std::vector<double>& n)
{
	const double mm = n[0], f = n[1] * mm, N = n[2], c = n[3] * mm;
	const auto vector = [&](size_t i) { return Vec3d{ n[i], n[i + 1], n[i + 2] }; };
	const Vec3d location = vector(4), axis = vector(7), near = vector(18), far = vector(21);
	const TiltLens lens = LensOf(f, N, location, axis, vector(10), vector(13));
	Expect("TL_Lens_Tilt", line, n[16] * RadiansPerDegree, AngleFromAxis(lens.normal_camera));
	Expect("TL_Image_Distance", line, n[17], lens.image_distance);
	// On the axis and beside it: signed blur in the frame of the axis, whose z alone matters beside q.P.
	for(const Vec3d& aside : { Vec3d{ 0.0, 0.0, 0.0 }, 0.2 * lens.basis_x, -0.3 * lens.basis_y })
		for(const bool is_far : { false, true })
		{
			const Vec3d& q = is_far ? far : near;
			const Vec3d P = PointAlong(q, axis + aside);
			const double blur = lens.image_distance * lens.aperture_diameter * (1.0 - Dot(lens.inverse_focus, P)) / Dot(axis, P);
			Expect(is_far ? "blur on the far plane of TL_Wedge" : "blur on its near one", line, std::fabs(blur), c);
		}
	if(!(Dot(near - far, axis) > 0.0))
		Expect("the nearer plane", line, Dot(near - far, axis), 1.0);
}

}

int main(int count, char** arguments)
{
	std::ifstream file(count > 1 ? arguments[1] : "");
	int depths = 0, planes = 0;
	for(std::string line; std::getline(file, line); )
	{
		std::string word, kind;
		std::vector<double> numbers;
		std::istringstream words(line);
		words >> word >> kind;
		while(words >> word)
			if(word != "=")
				numbers.push_back(std::stod(word));
		if(kind == "depth:" && numbers.size() == 8)
			CheckDepth(line, numbers), depths++;
		else if(kind == "plane:" && numbers.size() == 24)
			CheckPlane(line, numbers), planes++;
		else
		{
			std::printf("not understood: %s\n", line.c_str());
			failures++;
		}
	}
	std::printf("%d depths of field and %d planes, %d failures\n", depths, planes, failures);
	return failures == 0 && depths == 100 && planes == 100 ? 0 : 1;
}
