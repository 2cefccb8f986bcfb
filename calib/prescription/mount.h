// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Glass before a sensor: a state of the lens, pixel to ray. Sensor frame: origin in the sensor's middle, x right, y up, z towards the
// scene, as the picture is seen (the image on the sensor is turned by 180 degrees).

#ifndef TILTCAL_MOUNT_H
#define TILTCAL_MOUNT_H

#include "lens/optics.h"
#include "prescription/paraxial.h"
#include "prescription/trace.h"

#include <array>
#include <string>

namespace tiltcal
{

struct Sensor
{
	int width = 1800, height = 1200;
	double pitch_mm = 0.02;
};

/// How the lens stands.
struct GlassState
{
	std::string name = "untilted";
	double tilt_deg = 0, direction_deg = 0;   ///< as everywhere: the plane of focus recedes towards the direction
	double back_distance = 0;                 ///< from the sensor to the last vertex while untilted, mm
	double pivot = 0;                         ///< the height Z (trace.h) on the axis about which it tilts
};

/// The frame of the glass in that of the sensor.
struct GlassFrame
{
	Vec3<double> vertex, x, y, axis;          ///< the first vertex; unit vectors

	GlassFrame(const Prescription& lens, const GlassState& state);

	Vec3<double> DirectionToGlass(const Vec3<double>& v) const { return { Dot(x, v), Dot(y, v), Dot(axis, v) }; }
	Vec3<double> ToGlass(const Vec3<double>& point) const { return DirectionToGlass(point - vertex); }
	Vec3<double> DirectionToSensor(const Vec3<double>& v) const { return v.x * x + v.y * y + v.z * axis; }
	Vec3<double> ToSensor(const Vec3<double>& point) const { return vertex + DirectionToSensor(point); }
	/// The point of the axis at the height Z.
	Vec3<double> OnAxis(double z) const { return vertex + z * axis; }
};

/// The point of the sensor on which the pixel (fractions allowed) lies.
Vec3<double> SensorPoint(const Sensor& sensor, double u, double v);
/// The pixel of a point of the sensor.
std::array<double, 2> PixelOfSensorPoint(const Sensor& sensor, const Vec3<double>& point);

/// From the sensor to the last vertex, untilted, so that what is `distance` mm before the entrance pupil (infinite: at infinity) has the
/// least RMS blur on the axis at full opening, as a photographer focuses. Throws Error (EXIT_REFUSED) where no ray comes through or there
/// is no image behind the lens.
double FocusedBackDistance(const Prescription& lens, const Paraxial& paraxial, double distance);

}

#endif
