// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How far a calibration can be trusted, in words.

#ifndef TILTCAL_VERDICT_H
#define TILTCAL_VERDICT_H

#include <tiltcal/calibration.h>

#include <string>
#include <vector>

namespace tiltcal
{

enum class Grade
{
	GOOD,   ///< nothing speaks against it
	FAIR,   ///< the numbers hold within what the remarks say
	POOR    ///< photograph more before relying on it
};

struct Remark
{
	Grade grade;
	std::string text;   ///< what, and what to photograph to mend it
};

struct Verdict
{
	Grade grade = Grade::GOOD;   ///< the worst of the remarks
	std::vector<Remark> remarks;
};

/// Judges: sigmas of w and of every tilt; how much one photograph decides; whether both sides of the plane of focus are
/// seen; correlations; what blur and geometry say apart; whether noise or the lens's aberrations limit the result.
Verdict Judge(const Calibration& calibration);

const char* Name(Grade grade);

}

#endif
