// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/error.h>

namespace tiltcal
{

Error::Error(ExitCode exit_code, const std::string& message)
	: std::runtime_error(message), code(exit_code)
{
}

Error Refused(const std::string& message) { return Error(EXIT_REFUSED, message); }
Error UsageError(const std::string& message) { return Error(EXIT_USAGE, message); }
Error FileError(const std::string& message) { return Error(EXIT_FILE, message); }

}
