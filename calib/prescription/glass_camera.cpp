// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/glass_camera.h"

#include "model/thin_lens_of_real.h"

namespace tiltcal
{

namespace
{

std::vector<GlassFrame> FramesOf(const GlassTask& task)
{
	std::vector<GlassFrame> frames;
	for (const GlassState& state : task.states)
		frames.emplace_back(task.glass, state);
	return frames;
}

}

GlassCameras MakeGlassCameras(const GlassTask& task)
{
	GlassCameras made;
	made.task = task;
	made.paraxial = ParaxialOf(task.glass);
	const std::vector<TracedRay> rays = TraceBundle(task.glass, made.paraxial, task.sensor, task.states);
	const std::vector<GlassFrame> frames = FramesOf(task);
	// Few numbers do better where the linear part gives way; sixteen need none of that, and theirs are those near the axis.
	made.none = FitLens(rays, frames, made.paraxial, 0, LinearPart::FITTED);
	made.six = FitLens(rays, frames, made.paraxial, tilt_lens::ThirdOrderTerms, LinearPart::FITTED);
	made.sixteen = FitLens(rays, frames, made.paraxial, tilt_lens::AberrationTerms, LinearPart::PARAXIAL);
	made.rims = FitRims(task.glass, made.paraxial, made.Lens(), task.sensor, task.states);
	return made;
}

StateCamera CameraOfGlass(const GlassCameras& made, size_t s)
{
	const GlassState& state = made.task.states[s];
	const FittedLens& fit = made.Lens();
	const GlassFrame frame(made.task.glass, state);
	const Vec3<double> exit = frame.OnAxis(fit.exit_pupil), entrance = frame.OnAxis(fit.entrance_pupil);
	const double m = fit.lens.pupil_magnification;
	GlassState untilted = state;
	untilted.tilt_deg = 0;
	StateCamera c;
	c.state = state.name;
	c.model = "prescription";
	c.width = made.task.sensor.width;
	c.height = made.task.sensor.height;
	c.pitch_mm = made.task.sensor.pitch_mm;
	// The exit pupil stands m w before the sensor (lens/pupil_magnification.h), over the principal point.
	c.image_distance_mm = exit.z / m;
	c.principal_point = PixelOfSensorPoint(made.task.sensor, exit);
	c.lens_tilt_deg = state.tilt_deg;
	c.tilt_direction_deg = state.direction_deg;
	c.aperture_diameter_mm = 2 * made.rims.opening_radius;
	c.natural_vignetting = true;
	for (const GlassRim& rim : made.rims.rims)
		c.rims_mm.push_back({ rim.rim.radius, rim.rim.distance });
	const double power = PowerOfThinLens(m, fit.lens.power, frame.axis.z, c.image_distance_mm);
	c.focal_length_mm = 1 / power;
	c.focus_distance_mm = FocusOfThinLens(power, frame.axis.z, c.image_distance_mm);
	c.lens_centre_mm = entrance - GlassFrame(made.task.glass, untilted).OnAxis(made.paraxial.entrance_pupil);
	return c;
}

}
