// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the photographer knows of the lens beforehand: what is exact and what is known about.

#ifndef TILTCAL_PRIORS_H
#define TILTCAL_PRIORS_H

#include <tiltcal/task.h>

#include <string>

namespace tiltcal
{

/// "focal_length=45" for what is exact, "f_number=2.8:0.1" for what is known about. Throws UsageError.
Prior ParseFix(const std::string& text);
Prior ParsePrior(const std::string& text);

}

#endif
