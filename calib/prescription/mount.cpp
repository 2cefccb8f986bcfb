// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/mount.h"

#include "lens/angles.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

#include <cmath>

namespace tiltcal
{

GlassFrame::GlassFrame(const Prescription& lens, const GlassState& state)
{
	const double radians = tilt_lens::Pi / 180;
	axis = tilt_lens::LensNormalFromTilt(state.tilt_deg * radians, state.direction_deg * radians);
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(axis);
	x = basis.a;
	y = basis.b;
	const double pivot_above_sensor = state.back_distance + lens.Length() + state.pivot;
	vertex = Vec3<double>{ 0, 0, pivot_above_sensor } - state.pivot * axis;
}

Vec3<double> SensorPoint(const Sensor& s, double u, double v)
{
	return { -(u - 0.5 * (s.width - 1)) * s.pitch_mm, (v - 0.5 * (s.height - 1)) * s.pitch_mm, 0 };
}

std::array<double, 2> PixelOfSensorPoint(const Sensor& s, const Vec3<double>& point)
{
	return { 0.5 * (s.width - 1) - point.x / s.pitch_mm, 0.5 * (s.height - 1) + point.y / s.pitch_mm };
}

double FocusedBackDistance(const Prescription& lens, const Paraxial& p, double distance)
{
	// Rays from the axial point through rings of equal area of the entrance pupil. Behind the last vertex a ray is h + s k from the axis,
	// s towards the sensor: the mean of its square is least at s = -sum(h k) / sum(k k).
	const int rings = 200;
	double hk = 0, kk = 0;
	for (int ring = 0; ring < rings; ++ring)
	{
		const double y = std::abs(p.entrance_radius) * std::sqrt((ring + 0.5) / rings);
		const double from = std::isfinite(distance) ? distance : 1e9;
		Vec3<double> direction{ std::isfinite(distance) ? y / from : 0, 0, -1 };
		// Begins in the entrance pupil, which may lie within the glass: MeetSurface goes back to the first surface.
		Ray<double> ray{ { y, 0, p.entrance_pupil }, Normalized(direction) };
		if (TraceToSensor(lens, ray) != Fate::PASSED)
			continue;
		const double k = ray.direction.x / -ray.direction.z, h = ray.point.x + (ray.point.z - p.last_vertex) * k;
		hk += h * k;
		kk += k * k;
	}
	if (!(kk > 0))
		throw Refused(fmt::format("{}: no ray from {:g} mm on the axis comes through the glass", lens.file, distance));
	const double back = -hk / kk;
	if (!(back > 0))
		throw Refused(fmt::format("{}: has no image behind its last surface of what is {:g} mm before its entrance pupil", lens.file, distance));
	return back;
}

}
