// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is still missing. After a calibration: sigmas, and the photographs that would lower them most. Information adds up (solve/joint_fit.h), so what
// a photograph would say is known before it is taken: optimal design (Fedorov, "Theory of Optimal Experiments", 1972), of one
// photograph after the other. Before: what the photographs lack, by what is seen in them.

#ifndef TILTCAL_FIND_NEXT_PHOTOGRAPHS_H
#define TILTCAL_FIND_NEXT_PHOTOGRAPHS_H

#include <tiltcal/calibration.h>

#include <cstddef>
#include <string>
#include <vector>

namespace tiltcal
{

/// Photographs of a state, so that they can be held against each other (by_photographs.h).
constexpr size_t LEAST_PHOTOGRAPHS = 3;

/// Of a finished calibration of an exact model.
NextPhotographs FindNextPhotographs(const Calibration& calibration);

/// What photographs lack that do not make a calibration, and what to take next, a line each; empty: nothing that is seen without one.
std::vector<std::string> WhatPhotographsLack(const Task& task);

/// The sigmas that are to be expected once these were taken too, each in all of its states.
std::vector<ExpectedSigma> ExpectSigmas(const Calibration& calibration, const std::vector<NextPhotograph>& photographs);

/// A photograph of the board in a pose, for ExpectSigmas. No outline: it does not fit the picture.
NextPhotograph PhotographOfPose(const Calibration& calibration, const std::vector<size_t>& states, const Pose& pose);

}

#endif
