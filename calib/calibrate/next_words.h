// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Photographs to take, in words.

#ifndef TILTCAL_NEXT_WORDS_H
#define TILTCAL_NEXT_WORDS_H

#include "calibrate/coverage.h"

#include <tiltcal/calibration.h>

#include <string>
#include <vector>

namespace tiltcal
{

/// What a finished calibration lacks: sigmas above what is wanted, states of fewer than `least` photographs, empty parts of the picture.
std::vector<std::string> WhatIsMissing(const Calibration& calibration, const std::vector<ExpectedSigma>& sigmas, const Thirds& seen, size_t least);

/// How to take a photograph: what to turn by how much, where in the picture, how far away.
std::string HowToTake(const Calibration& calibration, const NextPhotograph& next);

/// "the tilt of plus5", "the image distance": a name of ExpectedSigma for people.
std::string NameForPeople(const std::string& name);

}

#endif
