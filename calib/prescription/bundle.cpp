// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/bundle.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

namespace tiltcal
{

namespace
{

/// Points of the disc that holds the exit pupil: a square lattice.
std::vector<Vec3<double>> PointsOfExitPupil(const Paraxial& p, int across, double reach)
{
	std::vector<Vec3<double>> points;
	const double radius = reach * p.entrance_radius * p.pupil_magnification;
	for (int i = 0; i < across; ++i)
		for (int j = 0; j < across; ++j)
		{
			const double x = (2 * i + 1.0) / across - 1, y = (2 * j + 1.0) / across - 1;
			if (x * x + y * y <= 1)
				points.push_back({ radius * x, radius * y, p.exit_pupil });
		}
	return points;
}

}

std::vector<TracedRay> TraceBundle(const Prescription& lens, const Paraxial& p, const Sensor& sensor, const std::vector<GlassState>& states, const BundleSize& size)
{
	const std::vector<Vec3<double>> points = PointsOfExitPupil(p, size.across, size.reach);
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
				for (const Vec3<double>& point : points)
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
