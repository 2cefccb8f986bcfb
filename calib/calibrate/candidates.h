// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Photographs that could be taken: where a board fits the picture and its blur can be measured, and what they would show.

#ifndef TILTCAL_CANDIDATES_H
#define TILTCAL_CANDIDATES_H

#include <tiltcal/calibration.h>

#include <vector>

namespace tiltcal
{

/// A photograph of one state that nobody took.
struct Candidate
{
	NextPhotograph look;   ///< all but states, sigmas and text
	Photo photo;           ///< some of its edges, their places, blur and sigmas as expected
};

/// The pose in which the board's middle is seen at `middle` (px) by the pinhole camera of state s, `distance` mm away, inclined by
/// `incline` degrees from parallel to the sensor so that it recedes towards `recedes`, 0 up, 90 right.
Pose PoseOfBoard(const Calibration& calibration, size_t s, const Point& middle, double distance, double incline, double recedes);

/// What photographing the board in a pose in state s would show; outside the picture, too blurred: no edges.
Candidate Expect(const Calibration& calibration, size_t s, const Pose& pose);

/// Poses of state s worth comparing: over the picture, about the distances of the boards photographed, upright and inclined to all sides.
std::vector<Candidate> CandidatesOf(const Calibration& calibration, size_t s);

}

#endif
