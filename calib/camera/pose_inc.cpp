// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/plain_text.h"
#include "camera/camera_block.h"
#include "model/projection.h"
#include "camera/pose.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

std::string Vector(const Eigen::Vector3d& v) { return fmt::format("<{:.12g}, {:.12g}, {:.12g}>", v.x(), v.y(), v.z()); }

std::string Sigmas(const Eigen::Vector3d& s, const char* unit)
{
	return std::isfinite(s.sum()) ? fmt::format("+- {:.2g}, {:.2g}, {:.2g} {}", s.x(), s.y(), s.z(), unit) : "sigma unknown: give at least 6 points";
}

Place PlaceOf(const CameraPose& pose)
{
	const auto row = [&](int r) { return Vec3<double>{ pose.camera_from_world(r, 0), pose.camera_from_world(r, 1), pose.camera_from_world(r, 2) }; };
	return { { pose.location.x(), pose.location.y(), pose.location.z() }, row(0), row(1), row(2) };
}

/// The place for TiltCal_<state>_Body of the calibration's .inc files. Look_At is a focus distance away, for the eye; a focus at infinity or beyond has none.
std::string PlaceText(const StateCamera& c, const CameraPose& pose, double unit_mm)
{
	const Eigen::Vector3d forward = pose.camera_from_world.row(2), up = pose.camera_from_world.row(1);
	const double away = c.focus_distance_mm > 0 && c.focus_distance_mm < 1e6 ? c.focus_distance_mm : 1000;
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
		TILTCAL_VERSION, OneLine(c.state), unit_mm, c.width, c.height, pose.residuals.size(), pose.rms, Sigmas(pose.location_sigma, "units"), Sigmas(pose.rotation_sigma_deg, "degrees"),
		c.aperture_diameter_mm > 0 ? "" : "// The calibration knows no aperture and no focus: a pinhole camera.\n", PlaceText(c, pose, unit_mm), BlurSamplesDefault(), CameraBlockOf(c, PlaceOf(pose), unit_mm));
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
