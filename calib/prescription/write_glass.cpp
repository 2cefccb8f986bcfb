// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/glass_camera.h"

#include "base/files.h"
#include "base/plain_text.h"
#include "camera/camera_block.h"
#include "camera/camera_macros.h"
#include "camera/real_lens_words.h"
#include "lens/words.h"
#include "model/projection.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

using tilt_lens::AberrationTerms;
using tilt_lens::ThirdOrderTerms;

const double PER_MILLE = 1000;

std::string Declare(const std::string& prefix, const char* name, double value, const char* unit)
{
	return fmt::format("#declare {}_{} = {:.10g};   // {}\n", prefix, name, SdlNumber(value), unit);
}

std::string Declares(const StateCamera& c, const std::string& prefix)
{
	std::string out;
	const auto declare = [&](const char* name, double value, const char* unit) { out += Declare(prefix, name, value, unit); };
	declare("Lens_Tilt", c.lens_tilt_deg, "degrees");
	declare("Tilt_Direction", c.tilt_direction_deg, "degrees: 0 up, 90 right");
	declare("Focus_Distance", c.focus_distance_mm, "mm, on the axis of the camera, of the plane that the lens is focused on near its own axis");
	declare("Image_Distance", c.image_distance_mm, "mm");
	const Point shift = ShiftOfPicture(c.width, c.height, c.principal_point);
	declare("Shift_X", shift[0] * c.pitch_mm, "mm");
	declare("Shift_Y", shift[1] * c.pitch_mm, "mm");
	declare("Aperture_Diameter", c.aperture_diameter_mm, "mm, of the disc that the real pupil fills best");
	for (size_t k = 0; k < c.rims_mm.size(); ++k)
	{
		declare((RimName(k) + "_Radius").c_str(), c.rims_mm[k][0], "mm");
		declare((RimName(k) + "_Distance").c_str(), c.rims_mm[k][1], "mm before the entrance pupil; below 0: behind the exit pupil");
	}
	out += fmt::format("#declare {}_Lens_Centre = <{:.9g}, {:.9g}, {:.9g}>;   // mm, seen from the untilted entrance pupil: right, up, forward\n", prefix,
		c.lens_centre_mm.x + 0., c.lens_centre_mm.y + 0., c.lens_centre_mm.z + 0.);
	return out;
}

/// "0.11 px (2.2 um)"
std::string Miss(const GlassCameras& made, double mm) { return fmt::format("{:7.3f} px ({:.2f} um)", mm / made.task.sensor.pitch_mm, mm * 1000); }

std::string TermsText(const FittedLens& fit, int terms)
{
	std::string out;
	const double f = 1 / fit.lens.power;
	for (int k = 0; k < terms && k < ThirdOrderTerms; ++k)
		out += fmt::format("  {:<12}{:12.4f}\n", tilt_lens::AberrationWords[k], PER_MILLE * fit.lens.aberrations.c[k] / f + 0.);
	if (terms > ThirdOrderTerms)
		out += "  fifth order ";
	for (int k = ThirdOrderTerms; k < terms; ++k)
		out += fmt::format(" {:.4f}", PER_MILLE * fit.lens.aberrations.c[k] / f + 0.);
	return out + (terms > ThirdOrderTerms ? "\n" : "");
}

std::string StatesText(const GlassCameras& made)
{
	std::string out;
	for (size_t s = 0; s < made.task.states.size(); ++s)
	{
		const GlassState& state = made.task.states[s];
		const StateCamera c = CameraOfGlass(made, s);
		out += fmt::format("  {:<14} tilt {:g} degrees towards {:g}, sensor {:.4f} mm behind the last vertex, focus on the axis {:.5g} mm before the pupil; {}\n", state.name,
			state.tilt_deg, state.direction_deg, state.back_distance, c.focus_distance_mm, Miss(made, made.Lens().state_rms_mm[s]));
	}
	return out;
}

}

std::string GlassInc(const GlassCameras& made, size_t s)
{
	const StateCamera c = CameraOfGlass(made, s);
	const std::string p = "TiltCal_" + c.state;
	BlockLayout layout;
	layout.lens_words = RealLensWords(made.Lens().lens, made.task.terms);
	layout.rims_only_if = c.rims_mm.empty() ? "" : "TiltCal_Rim";
	layout.place = MacroPlace(p, c.width * c.pitch_mm, c.height * c.pitch_mm);
	std::string out = fmt::format(
		"// camera-{}.inc, written by tiltcal {} from the prescription {}. World unit: 1 mm.\n"
		"// Render at {} x {} pixels or any size of this aspect ratio.\n"
		"// Focal length {:.6g} mm, f/{:.4g}. Rays land within {:.3f} px RMS of where the glass sends them.\n\n{}",
		c.state, TILTCAL_VERSION, OneLine(BaseName(made.task.glass.file)), c.width, c.height, made.paraxial.focal_length, made.paraxial.FNumber(),
		made.Lens().state_rms_mm[s] / c.pitch_mm, BlurSamplesDefault());
	if (!c.rims_mm.empty())
		out += "// 1: with the rims of the glass, which darken the corners and cut blur discs to cat's eyes. 0: without them.\n"
			"#ifndef (TiltCal_Rim)\n\t#declare TiltCal_Rim = 1;\n#end\n";
	out += "\n" + Declares(c, p);
	return out + fmt::format(
		"\n// Location is the entrance pupil's centre. Look_At lies on the axis of the sensor through it.\n"
		"#macro {0}(Location, Look_At, Sky)\n{1}#end\n\n"
		"// The same where the camera's body stands still while the lens tilts about its pivot: Location and Look_At are those of the\n"
		"// untilted lens, Location its entrance pupil near the axis.\n"
		"{2}", p, CameraBlockText(c, DeclaredNumbers(p), layout), BodyMacro(p));
}

std::string GlassReport(const GlassCameras& made)
{
	const Paraxial& p = made.paraxial;
	std::string out = fmt::format(
		"{}: {} surfaces, mm\n\n"
		"near the axis\n"
		"  focal length {:.4f}, f/{:.4g}, back focal distance {:.4f}\n"
		"  behind the first vertex: principal planes {:.4f} and {:.4f}, entrance pupil {:.4f}, exit pupil {:.4f}, last vertex {:.4f}\n"
		"  entrance pupil's diameter {:.4f}, pupil magnification {:.5f}\n\n",
		OneLine(BaseName(made.task.glass.file)), made.task.glass.surfaces.size(), p.focal_length, p.FNumber(), p.back_focus, -p.front_principal, -p.rear_principal,
		-p.entrance_pupil, -p.exit_pupil, -p.last_vertex, 2 * p.entrance_radius, p.pupil_magnification);
	out += fmt::format("how far rays land from where the glass sends them, RMS over the picture and the opening\n"
		"  no aberrations    {}\n  six numbers       {}\n  sixteen numbers   {}\n\n", Miss(made, made.none.rms_mm), Miss(made, made.six.rms_mm), Miss(made, made.sixteen.rms_mm));
	out += fmt::format("aberrations, thousandths of the focal length {:.4f}, at f/{:.4g}\n{}\n", 1 / made.Lens().lens.power, 1 / (2 * made.Lens().lens.power * p.entrance_radius),
		TermsText(made.Lens(), made.task.terms));
	out += fmt::format("opening\n  diameter of the disc that the real pupil fills, as the entrance pupil's: {:.4f}\n", 2 * made.rims.opening_radius);
	for (const GlassRim& rim : made.rims.rims)
		out += fmt::format("  rim of surface {}: radius {:.4f}, {:.4f} {}, cuts {:.2f} % of the light\n", rim.surface + 1, rim.rim.radius, std::abs(rim.rim.distance),
			rim.rim.distance > 0 ? "before the entrance pupil" : "behind the exit pupil", 100 * rim.cuts);
	if (made.rims.left_out > 0)
		out += fmt::format("  further rims, which the camera has no room for, would cut {:.2f} %\n", 100 * made.rims.left_out);
	out += fmt::format("  light against the glass's: {:.2f} % RMS, at most {:+.2f} % at pixel {:.0f}, {:.0f} of {}\n\n", 100 * made.rims.rms_light, 100 * made.rims.worst_light,
		made.rims.worst_pixel[0], made.rims.worst_pixel[1], made.task.states[made.rims.worst_state].name);
	out += "states\n" + StatesText(made);
	if (made.Lens().rms_mm > made.task.sensor.pitch_mm)
		out += fmt::format("\nThe camera's rays are more than a pixel off: what it lacks are aberrations of higher order.{}\n",
			made.task.terms < AberrationTerms ? " Sixteen numbers leave less." : " A smaller opening or a narrower picture has less of them.");
	return out +
		"\nNot in it: dispersion, diffraction, reflections, and how far a built lens is from its table.\n";
}

}
