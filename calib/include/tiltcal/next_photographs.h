// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is still missing, and which photographs would tell it. Frames of frames.h; mm, degrees, px.

#ifndef TILTCAL_NEXT_PHOTOGRAPHS_H
#define TILTCAL_NEXT_PHOTOGRAPHS_H

#include <tiltcal/frames.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tiltcal
{

/// One of the numbers that a calibration is good by.
struct ExpectedSigma
{
	std::string name;        ///< "image_distance", "plus5.lens_tilt", ..
	std::string unit;        ///< "mm", "deg", ..
	double now = 0;          ///< sigma
	double then = 0;         ///< as it is expected to be
	double wanted = 0;       ///< where it is no more than this, nothing is missing
};

/// A photograph that is worth taking.
struct NextPhotograph
{
	std::vector<size_t> states;            ///< take it in each of these, the board left where it is
	Pose pose{};                           ///< camera_from_board
	Point middle_px{};                     ///< of the board
	double distance_mm = 0;                ///< of its middle, along z
	double incline_deg = 0;                ///< from parallel to the sensor
	double recedes_deg = 0;                ///< where it recedes to: 0 up, 90 right
	std::vector<Point> outline_px;         ///< its four corners
	double blur_px[2] = { 0, 0 };          ///< least and most, expected
	std::vector<ExpectedSigma> sigmas;     ///< once it and those before it in the list are there
	std::string text;                      ///< how to take it
};

struct NextPhotographs
{
	bool known = false;                        ///< the calibration could say it
	std::vector<std::string> missing;          ///< in plain words; empty: nothing
	std::vector<ExpectedSigma> sigmas;         ///< now; `then` as after all photographs below
	std::vector<NextPhotograph> photographs;   ///< the best first. Where nothing is missing: the one that would tell most
};

}

#endif
