// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What photographs show before anything is solved: no lens is known here, only where the board was in the picture and how its squares grow.

#ifndef TILTCAL_COVERAGE_H
#define TILTCAL_COVERAGE_H

#include <tiltcal/task.h>

#include <array>
#include <string>
#include <vector>

namespace tiltcal
{

/// Where the board stands in a photograph.
struct Stance
{
	/// The farther side's distance over the nearer one's, by the size of its squares; 1: parallel to the sensor.
	double depth_ratio = 1;
	double recedes_deg = 0;      ///< 0 up, 90 right; of no meaning where depth_ratio is near 1
	double share_of_width = 0;   ///< of the picture, that the board's corners take
	double least_blur = 0, most_blur = 0;   ///< px
};

Stance StanceOf(const Photo& photo);

/// Thirds of the picture, from the top left: whether a corner was found there.
using Thirds = std::array<bool, 9>;
Thirds SeenThirds(const Task& task);
/// "upper left", .. "middle", .. "lower right".
const char* NameOfThird(size_t third);

/// "nearly parallel to the sensor", "its right side 20 % farther away than what is across".
std::string StanceWords(const Stance& stance);

/// A direction on the board: "upper side", "upper right corner", ..; 0 up, 90 right.
const char* SideWords(double recedes_deg);

}

#endif
