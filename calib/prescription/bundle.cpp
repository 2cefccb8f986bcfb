// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/bundle.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

#include <cmath>

namespace tiltcal
{

namespace
{

/// Points of the disc that holds the exit pupil: a square lattice, which lies elsewhere for each pixel, so that what its edges leave out
/// averages away.
std::vector<Vec3<double>> PointsOfExitPupil(const Paraxial& p, int across, double reach, int pixel)
{
	const auto part = [](double x) { return x - std::floor(x); };
	const double shift_x = 2 * part(0.25 + pixel * 0.7548776662), shift_y = 2 * part(0.75 + pixel * 0.5698402910);
	std::vector<Vec3<double>> points;
	const double radius = reach * p.entrance_radius * p.pupil_magnification;
	for (int i = 0; i <= across; ++i)
		for (int j = 0; j <= across; ++j)
		{
			const double x = (2 * i - shift_x) / across - 1, y = (2 * j - shift_y) / across - 1;
			if (x * x + y * y <= 1)
				points.push_back({ radius * x, radius * y, p.exit_pupil });
		}
	return points;
}

}

std::vector<TracedRay> TraceBundle(const Prescription& lens, const Paraxial& p, const Sensor& sensor, const std::vector<GlassState>& states, const BundleSize& size)
{
	std::vector<TracedRay> rays;
	for (size_t s = 0; s < states.size(); ++s)
	{
		const GlassFrame frame(lens, states[s]);
		const size_t before = rays.size();
		for (int i = 0; i < size.columns; ++i)
			for (int j = 0; j < size.rows; ++j)
			{
				TracedRay traced{ s, { sensor.width * (i + 0.5) / size.columns - 0.5, sensor.height * (j + 0.5) / size.rows - 0.5 }, {}, {}, {} };
				traced.sensor_point = SensorPoint(sensor, traced.pixel[0], traced.pixel[1]);
				const Vec3<double> from = frame.ToGlass(traced.sensor_point);
				for (const Vec3<double>& point : PointsOfExitPupil(p, size.across, size.reach, i * size.rows + j))
				{
					traced.image = { from, Normalized(point - from) };
					traced.object = traced.image;
					if (TraceToScene(lens, traced.object, size.rims) == Fate::PASSED)
						rays.push_back(traced);
				}
			}
		if (rays.size() == before)
			throw Refused(fmt::format("state {}: no ray of any pixel comes through the glass of {}; is the sensor {:.4g} mm behind its last surface meant?", states[s].name,
				lens.file, states[s].back_distance));
	}
	return rays;
}

}
