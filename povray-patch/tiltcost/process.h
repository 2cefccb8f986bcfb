// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A child process that is measured and watched, and a temporary folder. An interrupt
// (SIGINT, SIGTERM, SIGHUP) ends the child and removes the folder.

#ifndef TILTCOST_PROCESS_H
#define TILTCOST_PROCESS_H

#include <functional>
#include <string>
#include <vector>

namespace tiltcost
{

/// Thrown out of RunProcess after an interrupt; the child is gone by then.
struct Interrupted
{
	int signal;
};

/// From now on interrupts are noticed by RunProcess and CheckInterrupt instead of ending the program.
void CatchInterrupts();

/// Throws Interrupted when there was an interrupt.
void CheckInterrupt();

/// A folder of its own, removed with what is in it.
class TemporaryFolder
{
public:
	/// Below $TMPDIR or /tmp. Throws tiltcal::Error.
	TemporaryFolder();
	~TemporaryFolder();
	TemporaryFolder(const TemporaryFolder&) = delete;
	TemporaryFolder& operator=(const TemporaryFolder&) = delete;

	std::string File(const std::string& name) const { return path + "/" + name; }

private:
	std::string path;
};

struct ProcessResult
{
	int exit_code = 0;          ///< 128 + signal where a signal ended it; 127 where it could not be started
	double cpu = 0, wall = 0;   ///< seconds, user and system
	bool stopped = false;       ///< by `watch`
};

/// Runs command[0] (looked up in PATH when it has no slash) with its output going to the file
/// `log` and `environment` ("NAME=value") added. `watch` is called some ten times a second with
/// the seconds so far; false ends the child.
ProcessResult RunProcess(const std::vector<std::string>& command, const std::string& environment, const std::string& log,
	const std::function<bool(double seconds)>& watch);

}

#endif
