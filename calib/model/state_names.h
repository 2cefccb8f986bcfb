// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A state's name becomes part of POV-Ray identifiers (TiltCal_NAME, TiltCal_NAME_Pose, ..) and of file names.

#ifndef TILTCAL_STATE_NAMES_H
#define TILTCAL_STATE_NAMES_H

#include <string>
#include <vector>

namespace tiltcal
{

/// `name` with _ for each - . and blank, as people write names, where that is an identifier: tilt37-az030 is tilt37_az030.
std::string WithUnderscores(const std::string& name);

/// Throws UsageError, which offers another, where `name` is not letters, digits and _, or begins with a digit, or is what the .inc files
/// call something else by (Rim, Distortion, ..).
void CheckStateName(const std::string& name);

/// CheckStateName for each, and no two of them alike or with an identifier in common (a state `up` declares TiltCal_up_Pose, and so
/// would a state `up_Pose`).
void CheckStateNames(const std::vector<std::string>& names);

}

#endif
