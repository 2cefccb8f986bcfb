// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/write_lens_inc.h"

#include "camera/camera_block.h"
#include "camera/camera_macros.h"
#include "camera/real_lens_words.h"
#include "effects/fixed_blades.h"
#include "model/projection.h"
#include <tiltcal/camera.h>

#include <fmt/format.h>

namespace tiltcal
{

namespace
{

/// The thin lens's camera with the numbers of the real one; what the aberrations say is taken out.
StateCamera CameraOfLens(const Calibration& c, size_t s)
{
	const RealLens& lens = c.LensOfScenes();
	const RealLensState& state = lens.states[s];
	StateCamera camera = CameraOfState(c, s);
	camera.model = "lens";
	// The exit pupil stands m w before the sensor (lens/pupil_magnification.h).
	const double m = lens.pupil_magnification.value;
	camera.image_distance_mm = state.image_distance_mm.value / m;
	camera.sigma.image_distance_mm = state.image_distance_mm.sigma / m;
	camera.principal_point = state.principal_point;
	camera.sigma.principal_point = state.principal_point_sigma;
	camera.distortion = {};
	camera.field_curvature_per_mm = 0;
	const double widening = WideningForBlades(camera.blades);
	camera.aperture_diameter_mm = lens.aperture_diameter_mm.value * widening;
	camera.sigma.aperture_diameter_mm = lens.aperture_diameter_mm.sigma * widening;
	camera.lens_tilt_deg = state.lens.lens_tilt.value;
	camera.sigma.lens_tilt_deg = state.lens.lens_tilt.sigma;
	camera.tilt_direction_deg = state.lens.tilt_direction.value;
	camera.sigma.tilt_direction_deg = state.lens.tilt_direction.sigma;
	camera.focus_distance_mm = state.lens.focus_distance.value;
	camera.sigma.focus_distance_mm = state.lens.focus_distance.sigma;
	camera.lens_centre_mm = state.lens_centre_mm;
	camera.aberrations = { m, lens.focal_length_mm.value, lens.radius_mm, {}, true };
	for (size_t k = 0; k < lens.aberrations_mm.size(); ++k)
		camera.aberrations->mm[k] = lens.aberrations_mm[k].value;
	for (size_t k = 0; k < lens.rims.size() && k < camera.rims_mm.size(); ++k)
		camera.rims_mm[k] = { lens.rims[k].radius_mm.value, lens.rims[k].distance_mm.value };
	camera.focal_plane_tilt_deg = state.lens.focal_plane_tilt.value;
	camera.sigma.focal_plane_tilt_deg = state.lens.focal_plane_tilt.sigma;
	camera.focal_length_mm = state.lens.focal_length.value;
	camera.sigma.focal_length_mm = state.lens.focal_length.sigma;
	return camera;
}

std::string Declares(const StateCamera& camera, const std::string& prefix)
{
	std::string out;
	const auto declare = [&](const std::string& name, double value, double sigma, const char* unit)
	{
		out += fmt::format("#declare {}_{} = {:.10g};   // +- {:.2g} {}\n", prefix, name, SdlNumber(value), sigma, unit);
	};
	const StateCameraSigma& sigma = camera.sigma;
	declare("Lens_Tilt", camera.lens_tilt_deg, sigma.lens_tilt_deg, "degrees");
	declare("Tilt_Direction", camera.tilt_direction_deg, sigma.tilt_direction_deg, "degrees, 0 = recedes towards picture up, 90 = right");
	declare("Focus_Distance", camera.focus_distance_mm, sigma.focus_distance_mm, "mm, along the axis, of the plane that the lens is focused on near its own axis");
	declare("Image_Distance", camera.image_distance_mm, sigma.image_distance_mm, "mm; the exit pupil stands pupil_magnification times as far from the sensor");
	declare("Focal_Plane_Tilt", camera.focal_plane_tilt_deg, sigma.focal_plane_tilt_deg, "degrees, of that plane");
	declare("Focal_Length", camera.focal_length_mm, sigma.focal_length_mm, "mm, of the thin lens that stands for it near its axis");
	declare("Principal_Point_X", camera.principal_point[0], sigma.principal_point[0], "px");
	declare("Principal_Point_Y", camera.principal_point[1], sigma.principal_point[1], "px");
	const Point shift = ShiftOfPicture(camera.width, camera.height, camera.principal_point);
	declare("Shift_X", shift[0] * camera.pitch_mm, sigma.principal_point[0] * camera.pitch_mm, "mm");
	declare("Shift_Y", shift[1] * camera.pitch_mm, sigma.principal_point[1] * camera.pitch_mm, "mm");
	declare("Aperture_Diameter", camera.aperture_diameter_mm, sigma.aperture_diameter_mm, "mm");
	const auto pair = [&](const char* name, const char* first, const char* second, const TwoNumbers& numbers)
	{
		out += fmt::format("#declare {0}_{1}_{2} = {3:.10g};\n#declare {0}_{1}_{4} = {5:.10g};\n", prefix, name, first, numbers[0], second, numbers[1]);
	};
	for (size_t k = 0; k < camera.rims_mm.size(); ++k)
		pair(RimName(k).c_str(), "Radius", "Distance", camera.rims_mm[k]);
	if (camera.lateral)
		pair("Lateral", "Red", "Blue", *camera.lateral);
	if (camera.axial_per_mm)
		pair("Axial", "Red", "Blue", *camera.axial_per_mm);
	out += fmt::format("#declare {}_Lens_Centre = {};   // mm, seen from the untilted one: right, up, forward\n", prefix, SdlVector(camera.lens_centre_mm));
	return out;
}

}

std::string RealLensPart(const Calibration& c, size_t s)
{
	const RealLens& found = c.LensOfScenes();
	const std::string p = "TiltCal_" + c.task.states[s].name;
	const StateCamera camera = CameraOfLens(c, s);
	BlockLayout layout;
	layout.lens_words = RealLensWords(RealLensOf(*camera.aberrations), found.fifth_order ? tilt_lens::AberrationTerms : tilt_lens::ThirdOrderTerms);
	layout.rims_only_if = camera.rims_mm.empty() ? "" : "TiltCal_Rim";
	layout.place = MacroPlace(p, camera.width * camera.pitch_mm, camera.height * camera.pitch_mm);
	return fmt::format("// One real lens for all states: focal length {:.6g} +- {:.2g} mm; the places of edges fit to {:.3f} px, their blurs to {:.3f} px.\n", found.focal_length_mm.value,
		found.focal_length_mm.sigma, found.rms_place, found.rms_blur) + Declares(camera, p) + StopDeclares(p, c.task.stops, found.stop_ratios, camera.aperture_diameter_mm) + PhotoPoses(p, c.task.states[s].photos, found.states[s].poses) + "\n" +
		CameraMacros(p, "the centre of the entrance pupil", CameraBlockText(camera, DeclaredNumbers(p), layout));
}

}
