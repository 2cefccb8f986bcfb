// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What goes into a calibration. Lengths mm, angles degrees, pictures pixels.

#ifndef TILTCAL_TASK_H
#define TILTCAL_TASK_H

#include <tiltcal/api.h>
#include <tiltcal/board.h>
#include <tiltcal/photo.h>

#include <string>
#include <vector>

namespace tiltcal
{

/// The photographs of one setting of the lens. State 0 is the untilted one.
struct State
{
	std::string name;
	bool tilted = false;
	std::vector<Photo> photos;
};

/// A photograph of an evenly lit plain surface.
struct FlatField
{
	size_t state = 0;
	std::string file;
	std::vector<BrightPatch> patches;
};

/// The opening's blades.
struct FixedBlades
{
	int count = 0;                 ///< 0: not known
	double rotation_deg = 0, curvature = 0;
};

enum class Quantity
{
	FOCAL_LENGTH,        ///< f untilted, mm
	F_NUMBER,            ///< f/d
	IMAGE_DISTANCE,      ///< w, mm
	FOCUS_DISTANCE,      ///< U untilted, mm
	APERTURE_DIAMETER    ///< d, mm
};

/// A quantity is `value` give or take `sigma` (one standard deviation); the same units. A fixed one has a sigma of
/// 1e-6 of itself.
struct Prior
{
	Quantity quantity;
	double value, sigma;

	TILTCAL_API std::string Name() const;   ///< "focal_length"
};

struct Task
{
	Board board;
	double pitch_mm = 0;           ///< distance of pixel centres on the sensor
	int width = 0, height = 0;
	std::vector<State> states;     ///< untilted first
	std::vector<Prior> priors;     ///< what is known beforehand
	bool untilted_free = false;    ///< the untilted state may be tilted a little: by how much is found, not taken to be 0
	std::vector<FlatField> flat_fields;
	FixedBlades blades;            ///< told; nothing measures them
};

}

#endif
