// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/camera_macros.h"

#include "base/files.h"
#include "base/plain_text.h"

#include <ceres/rotation.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

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
	return fmt::format("// {}\n#declare {}_Location = {};\n#declare {}_Look_At = {};\n#declare {}_Sky = {};\n", OneLine(BaseName(photo.file)),
		name, SdlVector(location), name, SdlVector(location + forward), name, SdlVector(back(0, 1, 0)));
}

/// "f5_6"
std::string FNumberName(const Stop& stop)
{
	std::string name = fmt::format("f{:g}", stop.f_number);
	std::replace(name.begin(), name.end(), '.', '_');
	return name;
}

}

std::string SdlVector(const Vec3<double>& v, int digits)
{
	return fmt::format("<{0:.{3}g}, {1:.{3}g}, {2:.{3}g}>", v.x, v.y, v.z, digits);
}

std::string PhotoPoses(const std::string& prefix, const std::vector<Photo>& photos, const std::vector<Pose>& poses)
{
	std::string out = fmt::format("#declare {}_Photos = {};\n", prefix, photos.size());
	for (size_t p = 0; p < photos.size(); ++p)
		out += PhotoPose(prefix, p + 1, photos[p], poses[p]);
	for (const char* const part : { "Location", "Look_At", "Sky" })
	{
		out += fmt::format("#declare {}_Photo_{} = array[{}] {{", prefix, part, photos.size());
		for (size_t p = 0; p < photos.size(); ++p)
			out += fmt::format("{} {}_Photo_{}_{}", p ? "," : "", prefix, p + 1, part);
		out += " };\n";
	}
	return out;
}

std::string StopDeclares(const std::string& prefix, const std::vector<Stop>& stops, const std::vector<Estimate>& ratios, double aperture_mm)
{
	if (ratios.empty())
		return "";
	std::string out = fmt::format("// The photographs' stops. Stopped down: #declare {0}_Aperture_Diameter = {0}_Aperture_Diameter_{1}; before the camera.\n", prefix, FNumberName(stops.back()));
	for (size_t k = 0; k < ratios.size(); ++k)
		out += fmt::format("#declare {}_Aperture_Diameter_{} = {:.10g};   // mm, of f/{:g}{}\n", prefix, FNumberName(stops[k]), aperture_mm * ratios[k].value, stops[k].f_number,
			k ? fmt::format(": {:.4g} +- {:.2g} of the widest", ratios[k].value, ratios[k].sigma) : "");
	return out;
}

std::string MacroPlace(const std::string& prefix, double width_mm, double height_mm)
{
	return fmt::format("\tlocation Location\n\tdirection {}_Image_Distance*z\n\tright {:.10g}*x\n\tup {:.10g}*y\n\tsky Sky\n\tlook_at Look_At\n", prefix, width_mm, height_mm);
}

double SdlNumber(double value) { return std::isfinite(value) ? value + 0. : 1e30; }

std::string BodyMacro(const std::string& prefix)
{
	return fmt::format(
		"#macro {0}_Body(Location, Look_At, Sky)\n"
		"\t#local Z = vnormalize(Look_At - Location);\n"
		"\t#local X = vnormalize(vcross(Sky, Z));\n"
		"\t#local Move = {0}_Lens_Centre.x * X + {0}_Lens_Centre.y * vcross(Z, X) + {0}_Lens_Centre.z * Z;\n"
		"\t{0}(Location + Move, Look_At + Move, Sky)\n"
		"#end\n", prefix);
}

std::string CameraMacros(const std::string& prefix, const std::string& centre, const std::string& block)
{
	return fmt::format(
		"// Location is {2}. Look_At lies on the axis, that is, at the principal\n"
		"// point, which the shift puts beside the picture's centre. Sky as for any camera.\n"
		"#macro {0}(Location, Look_At, Sky)\n"
		"{1}"
		"#end\n\n"
		"// The same where the camera's body stands still while the lens tilts about its pivot:\n"
		"// Location and Look_At are those of the untilted state.\n"
		"{3}\n"
		"// The camera of this state's photograph N (1, 2, ...), in the board's frame.\n"
		"#macro {0}_Pose(N)\n"
		"\t{0}({0}_Photo_Location[N - 1], {0}_Photo_Look_At[N - 1], {0}_Photo_Sky[N - 1])\n"
		"#end\n", prefix, block, centre, BodyMacro(prefix));
}

}
