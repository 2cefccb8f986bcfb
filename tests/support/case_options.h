// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The command line of a test program with cases: PROGRAM CASE --name value ...
#pragma once
#include <map>
#include <string>

// Values by "--name". Throws std::runtime_error, which says how it is used (`names`: "--name WHAT ..."), when there is no case
// or a name without a value.
std::map<std::string, std::string> ReadCaseOptions(int argc, char** argv, const std::string& names);
