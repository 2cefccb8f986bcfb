// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/write_inc.h"

#include "model/focus_words.h"
#include "model/projection.h"
#include "model/state_names.h"
#include <tiltcal/calibrate.h>
#include "camera/camera_block.h"
#include "camera/camera_macros.h"
#include "camera/write_lens_inc.h"
#include "effects/effects.h"
#include "base/files.h"
#include "base/plain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tiltcal
{

namespace
{

/// POV-Ray has no infinity; a focus at 1e30 mm is one.
double NotInfinite(double x) { return std::isfinite(x) ? x : 1e30; }

std::string Declare(const std::string& prefix, const std::string& name, const Estimate& e, const std::string& comment)
{
	return fmt::format("#declare {}_{} = {:.10g};   // +- {:.2g} {}\n", prefix, name, NotInfinite(e.value), e.sigma, comment);
}

/// For the comment of a number.
std::string Unused(const Calibration& c, EffectId effect)
{
	const auto found = std::find_if(c.effects.begin(), c.effects.end(), [&](const Effect& e) { return e.id == effect; });
	return found == c.effects.end() || found->used ? "" : "; not used: " + found->why;
}

/// The circle through the corners of blades is wider than the disc that was fitted.
std::string ApertureText(const StateCamera& camera, double fitted_mm, const std::string& prefix)
{
	return Declare(prefix, "Aperture_Diameter", { camera.aperture_diameter_mm, camera.sigma.aperture_diameter_mm },
		camera.blades.count ? fmt::format("mm, of the circle through the blades' corners: blurs edges like a disc of {:.10g} mm", fitted_mm) : "mm");
}

/// Where its sigma says nothing, what does.
std::string FocusText(const StateCamera& camera, const StateLens& lens, const std::string& prefix)
{
	const std::optional<std::string> words = FocusWords(InverseFocus(lens));
	if (!words)
		return Declare(prefix, "Focus_Distance", { camera.focus_distance_mm, camera.sigma.focus_distance_mm }, "mm, along the axis");
	return fmt::format("#declare {}_Focus_Distance = {:.10g};   // mm, along the axis; {}\n", prefix, NotInfinite(camera.focus_distance_mm), *words);
}

/// Those of vignetting and chromatic aberration: all that was estimated.
std::string EffectNumbers(const Calibration& c, const std::string& prefix)
{
	std::string out;
	const FalloffAnswer& falloff = RimOf(c);
	if (falloff.rim_seen)
	{
		const std::string unused = Unused(c, EffectId::VIGNETTING_OPTICAL);
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
		out += Declare(prefix, std::string("Lateral_") + colours[k], c.chromatic.lateral[k], "of chromatic aberration" + Unused(c, EffectId::CHROMATIC_LATERAL));
	for (size_t k = 0; k < 2; ++k)
		out += Declare(prefix, std::string("Axial_") + colours[k], c.chromatic.axial_per_mm[k], "1/mm, of chromatic aberration" + Unused(c, EffectId::CHROMATIC_AXIAL));
	return out;
}

/// Every number of one camera.
std::string Numbers(const Calibration& c, size_t s, Distorted distorted, const std::string& prefix)
{
	const StateCamera camera = CameraOfState(c, s, distorted);
	const StateCameraSigma& sigma = camera.sigma;
	const bool bare = distorted == Distorted::NO;
	const Geometry& g = bare ? c.RenderGeometry() : c.MainGeometry();
	const double pitch = camera.pitch_mm;
	std::string out;
	const auto declare = [&](const std::string& name, double value, double its_sigma, const std::string& comment) { out += Declare(prefix, name, { value, its_sigma }, comment); };
	declare("Image_Distance", camera.image_distance_mm, sigma.image_distance_mm, "mm");
	out += ApertureText(camera, (bare ? c.render : c.solution).aperture_diameter.value, prefix);
	out += StopDeclares(prefix, c.task.stops, (bare ? c.render : c.solution).stop_ratios, camera.aperture_diameter_mm);
	out += FocusText(camera, (bare ? c.render : c.solution).states[s], prefix);
	declare("Focal_Length", camera.focal_length_mm, sigma.focal_length_mm, "mm");
	declare("Focal_Plane_Tilt", camera.focal_plane_tilt_deg, sigma.focal_plane_tilt_deg, "degrees");
	declare("Tilt_Direction", camera.tilt_direction_deg, sigma.tilt_direction_deg, "degrees, 0 = recedes towards picture up, 90 = right");
	declare("Lens_Tilt", camera.lens_tilt_deg, sigma.lens_tilt_deg, "degrees");
	const Point shift = ShiftOfPicture(camera.width, camera.height, camera.principal_point);
	declare("Shift_X", shift[0] * pitch, sigma.principal_point[0] * pitch, "mm");
	declare("Shift_Y", shift[1] * pitch, sigma.principal_point[1] * pitch, "mm");
	declare("Principal_Point_X", camera.principal_point[0], sigma.principal_point[0], "px");
	declare("Principal_Point_Y", camera.principal_point[1], sigma.principal_point[1], "px");
	if (c.solution.model == Model::CURVED)
		declare("Field_Curvature", camera.field_curvature_per_mm, sigma.field_curvature_per_mm,
			"1/mm, of the bowl that the plane of focus touches on the lens axis" + Unused(c, EffectId::FIELD_CURVATURE));
	declare("Psf_Floor", camera.psf_floor_px, sigma.psf_floor_px, "px, the lens's own blur, not rendered");
	for (size_t k = 0; k < 5 && g.distortion_terms > 0; ++k)
		declare(DeclaredDistortion(k), camera.distortion[k], sigma.distortion[k], k ? "" : "of the distortion" + Unused(c, EffectId::DISTORTION));
	out += EffectNumbers(c, prefix);
	out += fmt::format("#declare {}_Lens_Centre = {};   // +- {} mm, seen from the untilted one: right, up, forward\n", prefix,
		SdlVector(camera.lens_centre_mm), SdlVector(sigma.lens_centre_mm, 2));
	return out + PhotoPoses(prefix, c.task.states[s].photos, g.states[s].poses);
}

/// A plane of focus parallel to the axis, or nearly so, has no focal_plane_tilt that could be written.
BlockLayout::Tilt TiltOf(const StateLens& lens)
{
	const bool ahead = FocusPlaceOf(InverseFocus(lens)) == FocusPlace::BEFORE_THE_LENS;
	return ahead && std::abs(lens.focal_plane_tilt.value) < 89 ? BlockLayout::Tilt::OF_FOCAL_PLANE : BlockLayout::Tilt::OF_LENS;
}

std::string Macro(const Calibration& c, size_t s, const std::string& p)
{
	BlockLayout layout;
	layout.tilt = TiltOf(c.solution.states[s]);
	layout.distortion_only_if = "TiltCal_Distortion";
	layout.rims_only_if = "TiltCal_Rim";
	layout.place = MacroPlace(p, c.task.width * c.task.pitch_mm, c.task.height * c.task.pitch_mm);
	return CameraMacros(p, "the lens centre", CameraBlockText(CameraOfState(c, s), DeclaredNumbers(p), layout));
}

/// With and without distortion, and the macros.
std::string ThinLensPart(const Calibration& c, size_t s, const std::string& p)
{
	std::string out;
	const bool distorted = Uses(c, EffectId::DISTORTION);
	if (distorted)
		out += "// 1: with the lens's distortion, which acts about the tilted lens axis. 0: the best\n"
			"// camera without it, fitted as such.\n"
			"#ifndef (TiltCal_Distortion)\n\t#declare TiltCal_Distortion = 1;\n#end\n\n"
			"#if (TiltCal_Distortion)\n\n" + Numbers(c, s, Distorted::YES, p) + "\n#else\n\n";
	out += Numbers(c, s, Distorted::NO, p);
	if (distorted)
		out += "\n#end\n\n";
	return out + Macro(c, s, p);
}

}

std::string CameraInc(const Calibration& c, size_t s)
{
	const std::string& name = c.task.states[s].name;
	CheckStateName(name);
	const std::string p = "TiltCal_" + name;
	const bool distorted = Uses(c, EffectId::DISTORTION);
	std::string out = fmt::format(
		"// camera-{}.inc, written by tiltcal {} (model {}). World unit: 1 mm.\n"
		"// Render at {} x {} pixels or any size of this aspect ratio.\n"
		"// World of the photographs' poses: origin at the board's first inner corner (or circle's centre), x along\n"
		"// the columns, y up the rows, z into the board.\n"
		"// Reprojection: {:.3f} px RMS {}.\n\n{}",
		name, TILTCAL_VERSION, NameOf(c.Answer()), c.task.width, c.task.height, c.RenderGeometry().rms,
		distorted ? fmt::format("without distortion, {:.3f} px with it", c.MainGeometry().rms) : "without distortion, which this lens does not need", BlurSamplesDefault());
	if (Uses(c, EffectId::VIGNETTING_OPTICAL))
	{
		out += RimOf(c).rims.size() > 1
			? "// 1: with the rims beside the aperture, which darken corners as the photographs' are and cut blur discs\n"
			  "// to cat's eyes. 0: without them.\n"
			: "// 1: with the second rim, which darkens corners as the photographs' are and cuts blur discs to cat's\n"
			  "// eyes. A real lens has rims on both sides: where much is cut, the middle of\n"
			  "// a blurred edge moves. 0: without it.\n";
		out += "#ifndef (TiltCal_Rim)\n\t#declare TiltCal_Rim = 1;\n#end\n\n";
	}
	const std::string thin = ThinLensPart(c, s, p);
	if (!c.RealLensIsUsed())
		return out + thin;
	// Six numbers that serve the boards say less than a thin lens at distances where no board stood; the fifth order says more.
	const std::string lenses = c.SceneLensIsUsed()
		? "// 1: the real lens, of fifth order, which predicts photographs of the board best; place it by what `tiltcal pose` finds through\n"
		  "// the real lens. Its tilt is its own, not quite the one that the calibration says. 0: the thin lens that comes nearest to it.\n"
		: "// 1: the real lens, which has the tilts that the calibration says and predicts photographs of the board best.\n"
		  "// 0: the thin lens that comes nearest to it, which is better at distances where no board stood.\n";
	return out + lenses + fmt::format("#ifndef (TiltCal_Real_Lens)\n\t#declare TiltCal_Real_Lens = {:d};\n#end\n\n#if (TiltCal_Real_Lens = 0)\n\n", c.SceneLensIsUsed()) + thin +
		"\n#else\n\n" + RealLensPart(c, s) + "\n#end\n";
}

}
