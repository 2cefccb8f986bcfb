// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a verdict says of photographs, board and untilted state, each from its check.

#ifndef TILTCAL_VERDICT_REMARKS_H
#define TILTCAL_VERDICT_REMARKS_H

#include <tiltcal/calibration.h>

#include <vector>

namespace tiltcal
{

/// Photographs that stand out, and those that are there twice. Named by their files.
std::vector<Remark> JudgePhotographs(const Calibration& calibration);

/// How the corners fit beside their noise, and whether another board would fit better.
std::vector<Remark> JudgeBoard(const Calibration& calibration);

/// Blur so wide that an edge's discs reach into the next one's.
std::vector<Remark> JudgeWidths(const Calibration& calibration);

/// A tilt that blur sees in the untilted state.
std::vector<Remark> JudgeUntilted(const Calibration& calibration);

}

#endif
