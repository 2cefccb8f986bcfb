// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/write_inc.h"

#include "model/projection.h"
#include <tiltcal/calibrate.h>
#include "camera/camera_block.h"
#include "effects/effects.h"
#include "base/files.h"
#include "effects/fixed_blades.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

std::string Declare(const std::string& prefix, const std::string& name, const Estimate& e, const std::string& comment)
{
	// POV-Ray has no infinity; a focus at 1e30 mm is one.
	const double value = std::isfinite(e.value) ? e.value : 1e30;
	return fmt::format("#declare {}_{} = {:.10g};   // +- {:.2g} {}\n", prefix, name, value, e.sigma, comment);
}

std::string Vector(const Vec3<double>& v, int digits = 9)
{
	return fmt::format("<{0:.{3}g}, {1:.{3}g}, {2:.{3}g}>", v.x, v.y, v.z, digits);
}

/// The camera's place in the board frame: location -R^T t, look_at along R^T e_z, sky R^T e_y.
std::string PhotoPose(const std::string& prefix, size_t number, const Photo& photo, const Pose& pose)
{
	double R[9];
	ceres::AngleAxisToRotationMatrix(pose.data(), R);   // column-major: R[3 c + r]
	const auto back = [&](double x, double y, double z)
	{
		return Vec3<double>{ R[0] * x + R[1] * y + R[2] * z, R[3] * x + R[4] * y + R[5] * z, R[6] * x + R[7] * y + R[8] * z };
	};
	const Vec3<double> location = back(-pose[3], -pose[4], -pose[5]);
	const Vec3<double> forward = back(0, 0, 1000);
	const std::string name = fmt::format("{}_Photo_{}", prefix, number);
	return fmt::format("// {}\n#declare {}_Location = {};\n#declare {}_Look_At = {};\n#declare {}_Sky = {};\n", BaseName(photo.file),
		name, Vector(location), name, Vector(location + forward), name, Vector(back(0, 1, 0)));
}

/// For the comment of a number.
std::string Unused(const Calibration& c, const std::string& effect)
{
	const auto found = std::find_if(c.effects.begin(), c.effects.end(), [&](const Effect& e) { return e.name == effect; });
	return found == c.effects.end() || found->used ? "" : "; not used: " + found->why;
}

/// The circle through the corners of blades is wider than the disc that was fitted.
std::string ApertureText(const Calibration& c, const Solution& solution, const std::string& prefix)
{
	const double widening = Uses(c, "blades") ? WideningForBlades(c.task.blades) : 1;
	const Estimate& d = solution.aperture_diameter;
	return Declare(prefix, "Aperture_Diameter", { d.value * widening, d.sigma * widening },
		widening > 1 ? fmt::format("mm, of the circle through the blades' corners: blurs edges like a disc of {:.10g} mm", d.value) : "mm");
}

/// Rim, Rim2: in the names of the rims' numbers.
std::string RimName(size_t k) { return k ? fmt::format("Rim{}", k + 1) : "Rim"; }

/// Those of vignetting and chromatic aberration: all that was estimated.
std::string EffectNumbers(const Calibration& c, const std::string& prefix)
{
	std::string out;
	const FalloffAnswer& falloff = RimOf(c);
	if (falloff.rim_seen)
	{
		const std::string unused = Unused(c, "vignetting_optical");
		for (size_t k = 0; k < falloff.rims.size(); ++k)
		{
			const RimEstimate& rim = falloff.rims[k];
			out += Declare(prefix, RimName(k) + "_Radius", rim.radius_mm, "mm, of the rim that vignettes" + unused);
			out += Declare(prefix, RimName(k) + "_Distance", rim.distance_mm, (rim.distance_mm.value < 0 ? "mm before the lens: behind it" : "mm, before the lens") + unused);
		}
	}
	if (!c.chromatic.failure.empty())
		return out;
	const char* const colours[] = { "Red", "Blue" };
	for (size_t k = 0; k < 2; ++k)
		out += Declare(prefix, std::string("Lateral_") + colours[k], c.chromatic.lateral[k], "of chromatic aberration" + Unused(c, "chromatic_lateral"));
	for (size_t k = 0; k < 2; ++k)
		out += Declare(prefix, std::string("Axial_") + colours[k], c.chromatic.axial_per_mm[k], "1/mm, of chromatic aberration" + Unused(c, "chromatic_axial"));
	return out;
}

/// The words of the effects used, by the names of their numbers.
EffectWords WordsOf(const Calibration& c, const std::string& p)
{
	EffectWords words;
	if (Uses(c, "field_curvature"))
		words.field_curvature = p + "_Field_Curvature";
	if (Uses(c, "distortion"))
	{
		words.distortion = fmt::format("{0}_K1, {0}_K2, {0}_P1, {0}_P2, {0}_K3", p);
		words.distortion_only_if = "TiltCal_Distortion";
	}
	words.natural_vignetting = Uses(c, "vignetting_natural");
	if (Uses(c, "vignetting_optical"))
	{
		for (size_t k = 0; k < RimOf(c).rims.size(); ++k)
			words.optical_vignetting += fmt::format("{0}{1}_{2}_Radius, {1}_{2}_Distance", k ? ", " : "", p, RimName(k));
		words.optical_only_if = "TiltCal_Rim";
	}
	if (Uses(c, "chromatic_lateral"))
		words.lateral = fmt::format("{0}_Lateral_Red, {0}_Lateral_Blue", p);
	if (Uses(c, "chromatic_axial"))
		words.axial = fmt::format("{0}_Axial_Red, {0}_Axial_Blue", p);
	if (Uses(c, "blades"))
		words.blades = fmt::format("{} rotation {:.10g} curvature {:.10g}", c.task.blades.count, c.task.blades.rotation_deg, c.task.blades.curvature);
	return words;
}

/// Every number of one camera.
std::string Numbers(const Calibration& c, const Solution& solution, const Geometry& g, size_t s, const std::string& prefix)
{
	const StateLens& lens = solution.states[s];
	const double pitch = c.task.pitch_mm;
	const Point& cp = g.principal_point[s];
	const Point& cs = g.principal_point_sigma[s];
	std::string out;
	out += Declare(prefix, "Image_Distance", solution.w_mm, "mm");
	out += ApertureText(c, solution, prefix);
	out += Declare(prefix, "Focus_Distance", lens.focus_distance, "mm, along the axis");
	out += Declare(prefix, "Focal_Length", lens.focal_length, "mm");
	out += Declare(prefix, "Focal_Plane_Tilt", lens.focal_plane_tilt, "degrees");
	out += Declare(prefix, "Tilt_Direction", lens.tilt_direction, "degrees, 0 = recedes towards picture up, 90 = right");
	out += Declare(prefix, "Lens_Tilt", lens.lens_tilt, "degrees");
	const Point shift = ShiftOfPicture(c.task.width, c.task.height, cp);
	out += Declare(prefix, "Shift_X", { shift[0] * pitch, cs[0] * pitch }, "mm");
	out += Declare(prefix, "Shift_Y", { shift[1] * pitch, cs[1] * pitch }, "mm");
	out += Declare(prefix, "Principal_Point_X", { cp[0], cs[0] }, "px");
	out += Declare(prefix, "Principal_Point_Y", { cp[1], cs[1] }, "px");
	if (solution.model == "curved")
		out += Declare(prefix, "Field_Curvature", solution.field_curvature, "1/mm, of the bowl that the plane of focus touches on the lens axis" + Unused(c, "field_curvature"));
	out += Declare(prefix, "Psf_Floor", solution.psf_floor_px, "px, the lens's own blur, not rendered");
	const char* const names[] = { "K1", "K2", "P1", "P2", "K3" };
	for (size_t k = 0; k < 5 && g.distortion_terms > 0; ++k)
		out += Declare(prefix, names[k], { g.distortion[k], g.distortion_sigma[k] }, k ? "" : "of the distortion" + Unused(c, "distortion"));
	out += EffectNumbers(c, prefix);
	const bool moved = s < g.lens_centre.size();
	out += fmt::format("#declare {}_Lens_Centre = {};   // +- {} mm, seen from the untilted one: right, up, forward\n", prefix,
		Vector(moved ? g.lens_centre[s] : Vec3<double>{ 0, 0, 0 }), Vector(moved ? g.lens_centre_sigma[s] : Vec3<double>{ 0, 0, 0 }, 2));
	out += fmt::format("#declare {}_Photos = {};\n", prefix, c.task.states[s].photos.size());
	const size_t photos = c.task.states[s].photos.size();
	for (size_t p = 0; p < photos; ++p)
		out += PhotoPose(prefix, p + 1, c.task.states[s].photos[p], g.poses[s][p]);
	for (const char* const part : { "Location", "Look_At", "Sky" })
	{
		out += fmt::format("#declare {}_Photo_{} = array[{}] {{", prefix, part, photos);
		for (size_t p = 0; p < photos; ++p)
			out += fmt::format("{} {}_Photo_{}_{}", p ? "," : "", prefix, p + 1, part);
		out += " };\n";
	}
	return out;
}

std::string Macro(const Calibration& c, const std::string& p)
{
	CameraBlock block{ "focal_plane_tilt " + p + "_Focal_Plane_Tilt", p + "_Tilt_Direction", p + "_Focus_Distance", p + "_Image_Distance",
		p + "_Shift_X", p + "_Shift_Y", p + "_Aperture_Diameter", "", "" };
	block.effects = EffectLines(WordsOf(c, p));
	block.place = fmt::format("\tlocation Location\n\tdirection {}_Image_Distance*z\n\tright {:.10g}*x\n\tup {:.10g}*y\n\tsky Sky\n\tlook_at Look_At\n",
		p, c.task.width * c.task.pitch_mm, c.task.height * c.task.pitch_mm);
	return fmt::format(
		"// Location is the lens centre. Look_At lies on the axis, that is, at the principal\n"
		"// point, which the shift puts beside the picture's centre. Sky as for any camera.\n"
		"#macro {0}(Location, Look_At, Sky)\n"
		"{1}"
		"#end\n\n"
		"// The same where the camera's body stands still while the lens tilts about its pivot:\n"
		"// Location and Look_At are those of the untilted state.\n"
		"#macro {0}_Body(Location, Look_At, Sky)\n"
		"\t#local Z = vnormalize(Look_At - Location);\n"
		"\t#local X = vnormalize(vcross(Sky, Z));\n"
		"\t#local Move = {0}_Lens_Centre.x * X + {0}_Lens_Centre.y * vcross(Z, X) + {0}_Lens_Centre.z * Z;\n"
		"\t{0}(Location + Move, Look_At + Move, Sky)\n"
		"#end\n\n"
		"// The camera of this state's photograph N (1, 2, ...), in the board's frame.\n"
		"#macro {0}_Pose(N)\n"
		"\t{0}({0}_Photo_Location[N - 1], {0}_Photo_Look_At[N - 1], {0}_Photo_Sky[N - 1])\n"
		"#end\n", p, CameraBlockText(block));
}

}

std::string CameraInc(const Calibration& c, size_t s)
{
	const std::string& name = c.task.states[s].name;
	const std::string p = "TiltCal_" + name;
	const bool distorted = Uses(c, "distortion");
	std::string out = fmt::format(
		"// camera-{}.inc, written by tiltcal {} (model {}). World unit: 1 mm.\n"
		"// Render at {} x {} pixels or any size of this aspect ratio.\n"
		"// World of the photographs' poses: origin at the board's first inner corner (or circle's centre), x along\n"
		"// the columns, y up the rows, z into the board.\n"
		"// Reprojection: {:.3f} px RMS {}.\n\n{}",
		name, TILTCAL_VERSION, c.solution.model, c.task.width, c.task.height, c.RenderGeometry().rms,
		distorted ? fmt::format("without distortion, {:.3f} px with it", c.MainGeometry().rms) : "without distortion, which this lens does not need", BlurSamplesDefault());
	if (Uses(c, "vignetting_optical"))
	{
		out += RimOf(c).rims.size() > 1
			? "// 1: with the rims beside the aperture, which darken corners as the photographs' are and cut blur discs\n"
			  "// to cat's eyes. 0: without them.\n"
			: "// 1: with the second rim, which darkens corners as the photographs' are and cuts blur discs to cat's\n"
			  "// eyes. A real lens has rims on both sides: where much is cut, the middle of\n"
			  "// a blurred edge moves. 0: without it.\n";
		out += "#ifndef (TiltCal_Rim)\n\t#declare TiltCal_Rim = 1;\n#end\n\n";
	}
	if (distorted)
		out += "// 1: with the lens's distortion, which acts about the tilted lens axis. 0: the best\n"
			"// camera without it, fitted as such.\n"
			"#ifndef (TiltCal_Distortion)\n\t#declare TiltCal_Distortion = 1;\n#end\n\n"
			"#if (TiltCal_Distortion)\n\n" + Numbers(c, c.solution, c.MainGeometry(), s, p) + "\n#else\n\n";
	out += Numbers(c, c.render, c.RenderGeometry(), s, p);
	if (distorted)
		out += "\n#end\n\n";
	return out + Macro(c, p);
}

}
