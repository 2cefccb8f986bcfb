// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/camera_block.h"

#include "camera/camera_macros.h"
#include "camera/real_lens_words.h"
#include "model/names.h"
#include "model/projection.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <cctype>
#include <cmath>

namespace tiltcal
{

namespace
{

using Unit = BlockNumbers::Unit;

std::string Vector(const Vec3<double>& v) { return fmt::format("<{:.12g}, {:.12g}, {:.12g}>", v.x, v.y, v.z); }

std::string PlaceLines(const StateCamera& c, const Place& place, double unit_mm)
{
	const double pixel = c.pitch_mm / unit_mm, w = c.image_distance_mm / unit_mm;
	return fmt::format("\tlocation {}\n\tdirection {}\n\tright {}\n\tup {}\n", Vector(place.location), Vector(w * place.forward),
		Vector(c.width * pixel * place.right), Vector(c.height * pixel * place.up));
}

}

std::string PlainNumbers::Text(const std::string&, double value, Unit unit) const
{
	const double scaled = unit == Unit::LENGTH ? value / unit_mm : unit == Unit::PER_LENGTH ? value * unit_mm : value;
	return fmt::format("{:.10g}", SdlNumber(scaled));
}

std::string DeclaredNumbers::Text(const std::string& name, double, Unit) const { return prefix_ + "_" + name; }

std::string DeclaredDistortion(size_t k)
{
	std::string name = DISTORTION_NAMES[k];
	name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
	return name;
}

std::string RimName(size_t k) { return k ? fmt::format("Rim{}", k + 1) : "Rim"; }

std::string EffectLines(const StateCamera& c, const BlockNumbers& numbers, const BlockLayout& layout)
{
	std::string out;
	const auto add = [&](const std::string& word, const std::string& values, const std::string& only_if = "")
	{
		out += fmt::format(only_if.empty() ? "{0}\t\t{1} {2}\n" : "#if ({0})\n\t\t{1} {2}\n#end\n", only_if, word, values);
	};
	if (c.field_curvature_per_mm != 0)
		add("field_curvature", numbers.Text("Field_Curvature", c.field_curvature_per_mm, Unit::PER_LENGTH));
	if (c.HasDistortion())
	{
		std::string values;
		for (size_t k = 0; k < 5; ++k)
			values += (k ? ", " : "") + numbers.Text(DeclaredDistortion(k), c.distortion[k], Unit::NONE);
		add("distortion", values, layout.distortion_only_if);
	}
	if (c.natural_vignetting)
		add("vignetting", "natural");
	std::string rims;
	for (size_t k = 0; k < c.rims_mm.size(); ++k)
		rims += (k ? ", " : "") + numbers.Text(RimName(k) + "_Radius", c.rims_mm[k][0], Unit::LENGTH) + ", " + numbers.Text(RimName(k) + "_Distance", c.rims_mm[k][1], Unit::LENGTH);
	if (!rims.empty())
		add("vignetting optical", rims, layout.rims_only_if);
	std::string chromatic;
	const auto colours = [&](const char* word, const std::string& name, const std::optional<TwoNumbers>& values, Unit unit)
	{
		if (values)
			chromatic += (chromatic.empty() ? "" : " ") + fmt::format("{} {}, {}", word, numbers.Text(name + "_Red", (*values)[0], unit), numbers.Text(name + "_Blue", (*values)[1], unit));
	};
	colours("lateral", "Lateral", c.lateral, Unit::NONE);
	colours("axial", "Axial", c.axial_per_mm, Unit::PER_LENGTH);
	if (!chromatic.empty())
		add("chromatic", chromatic);
	if (c.blades.count)
		add("blades", fmt::format("{} rotation {:.10g} curvature {:.10g}", c.blades.count, c.blades.rotation_deg + 0., c.blades.curvature + 0.));
	return out;
}

std::string CameraBlockText(const StateCamera& c, const BlockNumbers& numbers, const BlockLayout& layout)
{
	const Point shift = ShiftOfPicture(c.width, c.height, c.principal_point);
	const bool of_lens = layout.tilt == BlockLayout::Tilt::OF_LENS;
	return fmt::format(
		"camera {{\n"
		"\ttilt_lens {{\n"
		"\t\t{} {}\n"
		"\t\ttilt_direction {}\n"
		"\t\tfocal_distance {}\n"
		"\t\timage_distance {}\n"
		"\t\tshift <{}, {}>\n"
		"\t\taperture_diameter {}\n"
		"{}"
		"#ifdef (TiltCal_Denoise)\n"
		"#if (TiltCal_Denoise)\n"
		"\t\tdenoise\n"
		"#end\n"
		"#end\n"
		"\t}}\n"
		"{}"
		"\tblur_samples TiltCal_Blur_Samples\n"
		"\tvariance 0\n"
		"}}\n",
		of_lens ? "lens_tilt" : "focal_plane_tilt", of_lens ? numbers.Text("Lens_Tilt", c.lens_tilt_deg, Unit::NONE) : numbers.Text("Focal_Plane_Tilt", c.focal_plane_tilt_deg, Unit::NONE),
		numbers.Text("Tilt_Direction", c.tilt_direction_deg, Unit::NONE), numbers.Text("Focus_Distance", c.focus_distance_mm, Unit::LENGTH),
		numbers.Text("Image_Distance", c.image_distance_mm, Unit::LENGTH), numbers.Text("Shift_X", shift[0] * c.pitch_mm, Unit::LENGTH),
		numbers.Text("Shift_Y", shift[1] * c.pitch_mm, Unit::LENGTH), numbers.Text("Aperture_Diameter", c.aperture_diameter_mm, Unit::LENGTH),
		layout.lens_words + EffectLines(c, numbers, layout), layout.place);
}

std::string CameraBlockOf(const StateCamera& camera, const Place& place, double unit_mm)
{
	if (!(unit_mm > 0) || !std::isfinite(unit_mm))
		throw UsageError(fmt::format("a unit of the scene must be longer than 0 mm, but is {}", unit_mm));
	BlockLayout layout;
	layout.place = PlaceLines(camera, place, unit_mm);
	if (camera.aberrations)
	{
		const tilt_lens::RealLens<double> lens = RealLensOf(*camera.aberrations, unit_mm);
		layout.lens_words = RealLensWords(lens, TermsOf(lens));
	}
	return CameraBlockText(camera, PlainNumbers(unit_mm), layout);
}

std::string BlurSamplesDefault()
{
	return "#ifndef (TiltCal_Blur_Samples)\n\t#declare TiltCal_Blur_Samples = 128;\n#end\n"
		"// #declare TiltCal_Denoise = 1; takes their grain away, where pixels prove that they share it.\n";
}

}
