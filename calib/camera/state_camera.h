// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_STATE_CAMERA_H
#define TILTCAL_STATE_CAMERA_H

#include <tiltcal/calibration.h>
#include "model/projection.h"

#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// One state's camera as calibration.json holds it: what a picture needs, without poses and
/// sigmas. Frame of camera.h; lengths mm, angles degrees, pictures pixels.
struct StateCamera
{
	std::string state;                 ///< the state's name
	std::string model;                 ///< "plane", .., "opencv" when imported
	int width = 0, height = 0;
	double pitch_mm = 0, image_distance_mm = 0;
	Point principal_point{};
	Distortion distortion{};           ///< about the lens axis
	/// As reported: folded into (-90, 90], the tilt carries the sign (tilt_angles.h).
	double lens_tilt_deg = 0, tilt_direction_deg = 0;
	double focus_distance_mm = 0;      ///< on the axis; infinite where it is that, or unknown
	double aperture_diameter_mm = 0;   ///< 0 where it is unknown
	double field_curvature_per_mm = 0;
	// Effects that the calibration writes; empty or false: not.
	bool natural_vignetting = false;
	std::vector<std::array<double, 2>> rims_mm;             ///< R, Z of each
	std::optional<std::array<double, 2>> lateral, axial_per_mm;   ///< red, blue
	FixedBlades blades;                ///< the aperture's diameter is that of the circle through their corners

	double ImageDistancePx() const { return image_distance_mm / pitch_mm; }
	Vec3<double> LensNormal() const;
	bool IsTilted() const { return lens_tilt_deg != 0; }
	bool HasDistortion() const { return distortion != Distortion{}; }
};

/// The camera of one state of calibration.json; `state` empty: the first, which is the
/// untilted one. Throws FileError: unreadable, not JSON, a key missing or of the wrong kind
/// (file and key are named). Throws UsageError: no such state (those there are listed).
StateCamera ReadStateCamera(const std::string& file, const std::string& state);

/// A calibration.json with this one state, for ReadStateCamera. An unknown focus and an unknown aperture are null.
std::string StateCameraJson(const StateCamera& camera, const std::string& source);

}

#endif
