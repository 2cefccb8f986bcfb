// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/camera_block.h"

#include <fmt/format.h>

namespace tiltcal
{

std::string EffectLines(const EffectWords& w)
{
	std::string out;
	const auto add = [&](const char* word, const std::string& values, const std::string& only_if = "")
	{
		if (!values.empty())
			out += fmt::format(only_if.empty() ? "{0}\t\t{1} {2}\n" : "#if ({0})\n\t\t{1} {2}\n#end\n", only_if, word, values);
	};
	add("field_curvature", w.field_curvature);
	add("distortion", w.distortion, w.distortion_only_if);
	add("vignetting", w.natural_vignetting ? "natural" : "");
	add("vignetting optical", w.optical_vignetting, w.optical_only_if);
	add("chromatic", (w.lateral.empty() ? "" : "lateral " + w.lateral) + (w.lateral.empty() || w.axial.empty() ? "" : " ") + (w.axial.empty() ? "" : "axial " + w.axial));
	add("blades", w.blades);
	return out;
}

std::string CameraBlockText(const CameraBlock& b)
{
	return fmt::format(
		"camera {{\n"
		"\ttilt_lens {{\n"
		"\t\t{}\n"
		"\t\ttilt_direction {}\n"
		"\t\tfocal_distance {}\n"
		"\t\timage_distance {}\n"
		"\t\tshift <{}, {}>\n"
		"\t\taperture_diameter {}\n"
		"{}"
		"\t}}\n"
		"{}"
		"\tblur_samples TiltCal_Blur_Samples\n"
		"\tvariance 0\n"
		"}}\n", b.tilt, b.tilt_direction, b.focal_distance, b.image_distance, b.shift_x, b.shift_y, b.aperture_diameter, b.effects, b.place);
}

std::string BlurSamplesDefault() { return "#ifndef (TiltCal_Blur_Samples)\n\t#declare TiltCal_Blur_Samples = 128;\n#end\n"; }

}
