// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The cameras of the oracle tests, as numbers: what the scene language says and what the oracle computes from.
#pragma once
#include "vector.h"

#include <string>
#include <vector>

struct Camera
{
	std::string name;

	// The plane of focus: a tilt in degrees, of the lens or of the plane, or a plane in the world.
	bool tilts_lens = false;
	double tilt = 0, tilt_direction = 0;
	double focal_distance = 8;
	bool in_world = false;
	Vector point{0, 0, 0}, normal{0, 1, 0};

	double aperture_diameter = 0.4; // at 8 units of distance: blur up to 13 of the picture's 160 pixels
	// Outside the block. Without an angle the sensor is the window right x up at image_distance.
	double image_distance = 1.5;
	double angle = 0; // degrees across; 0: none given
	Vector location{0, 2.6, -3.5}, look_at{0, 1.2, 6};
	// up's and the window's centre's offsets, as a sheared camera has them.
	double up_x = 0, centre_x = 0, centre_y = 0;
	std::string moves; // transformations, as SDL

	// Effects. Blades have straight edges; the tilt is then about the x axis, so that the lens's own axes are plain.
	int blades = 0;
	double blade_rotation = 0; // degrees
	double rim_radius = 0, rim_distance = 0; // a second rim before the lens; 0: none
	double rear_radius = 0, rear_distance = 0; // a rim so far behind it; 0: none
	double lateral[3] = {0, 0, 0}, axial[3] = {0, 0, 0}; // red, green, blue
	bool Splits() const { return lateral[0] != 0 || axial[0] != 0; }
	std::string effects; // the same in words

	// More than one way to say it. `words`: the whole block, and `outside`: camera words, instead of those that follow
	// from the numbers above. `scene`: the scene's placement. The picture to compare with is then that of another case,
	// which is the same plane, or its mirror image.
	std::string words, outside, scene;
	std::string truth_of;
	bool mirrored = false;

	// What the project promises is shown with 1024 samples and frames; the rest with what shows a mistake.
	int samples = 1024;

	const std::string& Truth() const { return truth_of.empty() ? name : truth_of; }
	// Of 160 x 120 pixels; about as many frames of its own as the samples need.
	double cell_limit = 0.001; // oracle.cpp
	int frames = 0; // 0: as below
	int Frames() const { return frames > 0 ? frames : samples >= 1024 ? 1024 : 512; }
};

// All the cases; throws std::runtime_error for an unknown name.
std::vector<Camera> OracleCameras();
Camera OracleCamera(const std::string& name);
