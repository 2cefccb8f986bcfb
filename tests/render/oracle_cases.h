// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The cameras of the oracle tests, as numbers: what the scene language says and what the oracle computes from.
#pragma once
#include <array>
#include <string>
#include <vector>

using Vector = std::array<double, 3>;

struct Camera
{
	std::string name;
	// tilt_lens block. tilt in degrees: of the lens, or of the plane of focus.
	bool tilts_lens = false;
	double tilt = 0, tilt_direction = 0;
	double focal_distance = 8;
	double aperture_diameter = 0.4; // at 8 units of distance: blur up to 20 of the picture's 240 pixels
	// Outside the block. Without an angle the sensor is the window right x up at image_distance.
	double image_distance = 1.5;
	double angle = 0; // degrees across; 0: none given
	Vector location{0, 2.6, -3.5}, look_at{0, 1.2, 6};
	std::string moves; // transformations, as SDL
};

// No other knob of the cameras may enter: these are all the cases.
inline std::vector<Camera> OracleCameras()
{
	std::vector<Camera> cameras(7);
	cameras[0].name = "zero";

	cameras[1].name = "up";
	cameras[1].tilt = 60;

	cameras[2].name = "sideways";
	cameras[2].tilt = 50;
	cameras[2].tilt_direction = 60;

	// q_x = -tan(80)/8: the inverse focus distance changes sign at 0.18 right of the axis, the window ends at 0.44.
	cameras[3].name = "behind";
	cameras[3].tilt = 80;
	cameras[3].tilt_direction = 90;

	cameras[4].name = "lens";
	cameras[4].tilts_lens = true;
	cameras[4].tilt = 6;
	cameras[4].tilt_direction = 135;
	cameras[4].image_distance = 2;
	cameras[4].location = {0, 2.6, -5.5};
	cameras[4].focal_distance = 9;

	cameras[5].name = "angle";
	cameras[5].tilt = -55;
	cameras[5].tilt_direction = 20;
	cameras[5].angle = 50;
	cameras[5].image_distance = 0.8;

	// Placed by transformations alone, with a tilt on top: the block's lengths and angles must not be moved twice.
	cameras[6].name = "transformed";
	cameras[6].tilt = 55;
	cameras[6].tilt_direction = 200;
	cameras[6].location = {0, 0, 0};
	cameras[6].look_at = {0, 0, 1};
	cameras[6].moves = "rotate <12, 0, 15> rotate y * -20 translate <2.5, 3, -3>";
	return cameras;
}
