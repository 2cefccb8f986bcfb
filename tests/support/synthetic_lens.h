// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Photographs of a board through an ideal thin lens, by construction of rays in long
// double: Gauss's lens equation in the lens's own axes and straight lines to the sensor; with field
// curvature, focus points on the bowl and straight lines from the lens's rim through them.
// None of it uses the formulas of optics.h that the calibrator fits with.

#ifndef TILTCAL_SYNTHETIC_LENS_H
#define TILTCAL_SYNTHETIC_LENS_H

#include <tiltcal/calibration.h>

namespace synthetic
{

struct Lens
{
	double w = 48, f = 44.6, d = 16;       // mm
	double tilt = 0, direction = 0;        // degrees; as reported by tiltcal
	double cx = 899.5, cy = 599.5;         // principal point, px
	double floor = 0;                      // the lens's own blur, px
	double k1 = 0;                         // of places, about the lens axis; blur is not distorted
	double curvature = 0;                  // C of the field about the lens axis, 1/mm (povray-patch/lens/MODEL.md, Field curvature)

	/// Distance along the axis at which this lens is in focus on the sensor, mm.
	double FocusDistance() const;
};

/// The same lens, tilted.
Lens Tilted(double tilt, double direction = 0);

struct Noise
{
	double corner = 0, blur = 0;           // px
	unsigned seed = 1;
};

/// What a board is otherwise than told.
struct Shape
{
	double widening = 0;                   // of its columns, relative
	double bend = 0;                       // height of the arc along the columns, from the first to the last corner, mm
	double bend_along_rows = 0, twist = 0; // the same along the rows, and height of the corners, by turns up and down, mm
};

const double PITCH = 0.02;

/// A state of boards (12x9 squares of 25 mm, 1800x1200 px) in six inclined poses, or the
/// first `photos` of them, moved along the axis by `shift` mm.
tiltcal::State Photograph(const std::string& name, const Lens& lens, const Noise& noise, int photos = 6, double shift = 0, const Shape& shape = {});

/// Where the first `photos` boards of Photograph stand.
std::vector<tiltcal::Pose> PosesOfPhotographs(int photos, double shift = 0);

/// A task of the given states; the first is the untilted one.
tiltcal::Task MakeTask(std::vector<tiltcal::State> states);

/// The states untilted and tilted, of six photographs each.
tiltcal::Task TwoStates(const Lens& untilted, const Lens& tilted, const Noise& noise = {});
tiltcal::Task TwoStates(const Lens& untilted, const Lens& tilted, const Noise& noise, const Noise& noise_tilted);

/// Length of the difference of the tilts as vectors, degrees: 2 at 90 is -2 at -90.
double TiltError(const tiltcal::StateLens& found, const Lens& lens);

/// A board parallel to the sensor at `distance` mm.
tiltcal::State PhotographParallel(const std::string& name, const Lens& lens, double distance);

}

#endif
