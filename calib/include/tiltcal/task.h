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

/// How far the logarithm of the ratio of two openings may well lie from what their engraved f-numbers say: those are rounded (f/11 is 11.3, f/3.5 is 3.56), blades
/// close to some per cent, and wide open is what the rims leave (f/2.83 is sold as f/2.8 or f/2.9).
const double STOP_SIGMA = 0.05;

/// An opening at which photographs were taken. How wide it is beside the reference is found.
struct Stop
{
	double f_number = 0;           ///< as engraved
	double log_sigma = STOP_SIGMA; ///< what is known of the logarithm of its ratio to the reference, about that of the f-numbers; of the reference nothing
};

/// Of a stop's diameter to that of the reference, stop 0, as the engraved f-numbers say.
inline double RatioByFNumbers(const std::vector<Stop>& stops, size_t stop) { return stops[0].f_number / stops[stop].f_number; }

struct Task
{
	Board board;
	double pitch_mm = 0;           ///< distance of pixel centres on the sensor
	bool pitch_from_exif = false;  ///< not told: the verdict says what that leaves open
	int width = 0, height = 0;
	std::vector<State> states;     ///< untilted first
	std::vector<Prior> priors;     ///< what is known beforehand
	bool untilted_free = false;    ///< the untilted state may be tilted a little: by how much is found, not taken to be 0
	std::vector<FlatField> flat_fields;
	FixedBlades blades;            ///< told; nothing measures them
	/// The widest first: the reference, whose diameter is what a calibration calls the aperture's. Empty: one opening for all photographs.
	std::vector<Stop> stops;
};

}

#endif
