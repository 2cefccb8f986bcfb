// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/camera_block.h"
#include "model/projection.h"
#include "camera/pose.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

std::string Number(double x) { return fmt::format("{:.10g}", x + 0.); }   // no "-0"
std::string Vector(const Eigen::Vector3d& v) { return fmt::format("<{:.12g}, {:.12g}, {:.12g}>", v.x(), v.y(), v.z()); }

std::string Sigmas(const Eigen::Vector3d& s, const char* unit)
{
	return std::isfinite(s.sum()) ? fmt::format("+- {:.2g}, {:.2g}, {:.2g} {}", s.x(), s.y(), s.z(), unit) : "sigma unknown: give at least 6 points";
}

std::string Pair(const std::array<double, 2>& values, double factor) { return Number(values[0] * factor) + ", " + Number(values[1] * factor); }

EffectWords WordsOf(const StateCamera& c, double unit_mm)
{
	EffectWords words;
	if (c.field_curvature_per_mm != 0)
		words.field_curvature = Number(c.field_curvature_per_mm * unit_mm);
	if (c.HasDistortion())
		words.distortion = fmt::format("{:.10g}, {:.10g}, {:.10g}, {:.10g}, {:.10g}", c.distortion[0], c.distortion[1], c.distortion[2], c.distortion[3], c.distortion[4]);
	words.natural_vignetting = c.natural_vignetting;
	for (const std::array<double, 2>& rim : c.rims_mm)
		words.optical_vignetting += (words.optical_vignetting.empty() ? "" : ", ") + Pair(rim, 1 / unit_mm);
	if (c.lateral)
		words.lateral = Pair(*c.lateral, 1);
	if (c.axial_per_mm)
		words.axial = Pair(*c.axial_per_mm, unit_mm);
	if (c.blades.count)
		words.blades = fmt::format("{} rotation {} curvature {}", c.blades.count, Number(c.blades.rotation_deg), Number(c.blades.curvature));
	return words;
}

CameraBlock Block(const StateCamera& c, const CameraPose& pose, double unit_mm)
{
	// POV-Ray has no infinity; a focus at 1e30 is one.
	const double focus = std::isfinite(c.focus_distance_mm) ? c.focus_distance_mm / unit_mm : 1e30;
	const double pixel = c.pitch_mm / unit_mm, w = c.image_distance_mm / unit_mm;
	const Point shift = ShiftOfPicture(c.width, c.height, c.principal_point);
	CameraBlock block{ "lens_tilt " + Number(c.lens_tilt_deg), Number(c.tilt_direction_deg), Number(focus), Number(w),
		Number(shift[0] * pixel), Number(shift[1] * pixel), Number(c.aperture_diameter_mm / unit_mm), "", "" };
	block.effects = EffectLines(WordsOf(c, unit_mm));
	const Eigen::Matrix3d world_from_camera = pose.camera_from_world.transpose();
	block.place = fmt::format("\tlocation {}\n\tdirection {}\n\tright {}\n\tup {}\n", Vector(pose.location), Vector(w * world_from_camera.col(2)),
		Vector(c.width * pixel * world_from_camera.col(0)), Vector(c.height * pixel * world_from_camera.col(1)));
	return block;
}

/// The place for TiltCal_<state>_Body of the calibration's .inc files. Look_At is a focus distance away, for the eye.
std::string PlaceText(const StateCamera& c, const CameraPose& pose, double unit_mm)
{
	const Eigen::Vector3d forward = pose.camera_from_world.row(2), up = pose.camera_from_world.row(1);
	const double away = std::isfinite(c.focus_distance_mm) ? c.focus_distance_mm : 1000;
	return fmt::format("// The same place for the other states: TiltCal_<state>_Body(TiltCal_Pose_Location, TiltCal_Pose_Look_At, TiltCal_Pose_Sky).\n"
		"{}#declare TiltCal_Pose_Location = {};\n#declare TiltCal_Pose_Look_At = {};\n#declare TiltCal_Pose_Sky = {};\n",
		c.IsTilted() ? "// Only the untilted state's pose is such a place: this lens centre has moved with the tilt.\n" : "",
		Vector(pose.location), Vector(pose.location + away / unit_mm * forward), Vector(up));
}

}

std::string PoseInc(const StateCamera& c, const CameraPose& pose, double unit_mm)
{
	return fmt::format(
		"// Written by tiltcal {} pose, state '{}'. World unit: {:g} mm. Render at {} x {} pixels or any size of this aspect ratio.\n"
		"// {} points, reprojection {:.3f} px RMS. Location {}; rotation about right, up, forward {}.\n"
		"// The sigmas hold the scatter of the points, not the calibration's own.\n"
		"{}{}{}"
		"// 0: the place alone, without this camera.\n#ifndef (TiltCal_Pose_Camera)\n\t#declare TiltCal_Pose_Camera = 1;\n#end\n"
		"#if (TiltCal_Pose_Camera)\n{}#end\n",
		TILTCAL_VERSION, c.state, unit_mm, c.width, c.height, pose.residuals.size(), pose.rms, Sigmas(pose.location_sigma, "units"), Sigmas(pose.rotation_sigma_deg, "degrees"),
		c.aperture_diameter_mm > 0 ? "" : "// The calibration knows no aperture and no focus: a pinhole camera.\n", PlaceText(c, pose, unit_mm), BlurSamplesDefault(), CameraBlockText(Block(c, pose, unit_mm)));
}

std::string PoseText(const CameraPose& pose, const std::vector<PosePoint>& points)
{
	std::string out = fmt::format("location  {}  {}\nrotation about right, up, forward  {}\n", Vector(pose.location), Sigmas(pose.location_sigma, "scene units"),
		Sigmas(pose.rotation_sigma_deg, "degrees"));
	out += "  line      u_px      v_px      du_px     dv_px   (predicted - measured)\n";
	for (size_t i = 0; i < points.size(); ++i)
		out += fmt::format("{:6d} {:9.2f} {:9.2f}  {:9.3f} {:9.3f}{}{}\n", points[i].line, points[i].u, points[i].v, pose.residuals[i].x(), pose.residuals[i].y(),
			points[i].placed == Placed::MEASURED ? "   measured" : points[i].placed == Placed::FOUND ? "   found" : "", i == pose.worst ? "   worst" : "");
	return out + fmt::format("reprojection {:.3f} px RMS over {} points, worst {:.3f} px in line {}\n", pose.rms, points.size(), pose.residuals[pose.worst].norm(),
		points[pose.worst].line);
}

}
