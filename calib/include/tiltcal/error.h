// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The one exception of tiltcal: a message for the user and the exit code it means.

#ifndef TILTCAL_ERROR_H
#define TILTCAL_ERROR_H

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
class Error : public std::runtime_error
{
public:
	Error(ExitCode exit_code, const std::string& message);
	ExitCode Code() const { return code; }

private:
	ExitCode code;
};

Error Refused(const std::string& message);
Error UsageError(const std::string& message);
Error FileError(const std::string& message);

}

#endif
