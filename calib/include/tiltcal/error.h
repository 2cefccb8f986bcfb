// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The one exception of tiltcal: a message for the user, and what kind of fault it is (tiltcal's exit code).
// Inputs stand in backquotes, as in log.h.

#ifndef TILTCAL_ERROR_H
#define TILTCAL_ERROR_H

#include <tiltcal/api.h>

#include <stdexcept>
#include <string>

namespace tiltcal
{

enum ExitCode
{
	EXIT_DONE = 0,
	EXIT_REFUSED = 1,   ///< the input does not determine the answer, or no convergence
	EXIT_USAGE = 2,     ///< wrong options
	EXIT_FILE = 3       ///< unreadable or unwritable file
};

/// The message names the file or option at fault and says what to do.
class TILTCAL_API Error : public std::runtime_error
{
public:
	Error(ExitCode exit_code, const std::string& message);
	ExitCode Code() const { return code; }

private:
	ExitCode code;
};

TILTCAL_API Error Refused(const std::string& message);
TILTCAL_API Error UsageError(const std::string& message);
TILTCAL_API Error FileError(const std::string& message);

}

#endif
