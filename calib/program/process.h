// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Child processes, without a shell: the one place of the repository that starts programs. Each is the leader of a process
// group of its own, which ends with it when it is ended, and does not outlive this program.

#ifndef TILTCAL_PROCESS_H
#define TILTCAL_PROCESS_H

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// Thrown out of RunProcess after an interrupt; the child and what it started are gone by then.
struct Interrupted
{
	int signal;
};

/// From now on interrupts (SIGINT, SIGTERM, SIGHUP) take the files away that are being written (base/unfinished.h), say that the program
/// `name` was interrupted, and end it by the signal: 130 for a shell after Ctrl-C. Those that are ignored, as by nohup, stay so.
void EndAtInterrupts(const std::string& name);

/// What another interrupt does.
enum class Second { NOTHING_MORE, ENDS };

/// From now on interrupts are noticed by RunProcess and CheckInterrupt instead of ending the program; where a second one ends it, by
/// CheckInterrupt and WasInterrupted alone. SIGHUP stays ignored where it was, as by nohup.
void CatchInterrupts(Second second = Second::NOTHING_MORE);

/// Whether there was one.
bool WasInterrupted();

/// Throws Interrupted when there was an interrupt.
void CheckInterrupt();

struct ProcessSetup
{
	std::vector<std::string> command;       ///< the program, looked up in PATH when it has no slash, and its arguments
	std::string folder = "";                ///< where it runs; empty: where this program does
	std::vector<std::string> environment = {};   ///< "NAME=value", added to this program's
	std::string input = "";                 ///< what it reads as its standard input
	std::string log = "";                   ///< file that receives all it says; empty: ProcessResult::said
	double timeout = 0;                     ///< seconds after which its group is killed; 0: never
};

struct ProcessResult
{
	int exit_code = 0;               ///< 128 + signal where a signal ended it; 127: could not be started, 126: not with these files
	double cpu = 0, wall = 0;        ///< seconds; cpu: user and system, its own children's too
	double most_memory = 0;          ///< MiB
	bool stopped = false;            ///< by `watch`
	bool late = false;               ///< killed after the timeout
	std::string said;                ///< output and errors, where there is no log
};

/// A child that runs beside this program. Throws Refused when no process can be made.
class Process
{
public:
	explicit Process(const ProcessSetup& setup);
	/// Kills the group when it has not ended.
	~Process();
	Process(Process&& other) noexcept;
	Process(const Process&) = delete;
	Process& operator=(const Process&) = delete;

	/// The result, once there is one; the timeout is looked at here.
	std::optional<ProcessResult> Poll();
	/// Sleeps until it ends, without regard to timeout and interrupts.
	ProcessResult Wait();
	/// Asks the group to end, and insists after two seconds.
	void End();
	double Seconds() const;

private:
	bool Ended(bool block);
	ProcessResult Reap();

	pid_t child = -1;
	int captured = -1;                                ///< file descriptor
	std::chrono::steady_clock::time_point start;
	double timeout = 0;
	bool killed = false;
};

/// Runs it to its end. `watch`, when given, is called some ten times a second with the seconds so far; false ends the child.
ProcessResult RunProcess(const ProcessSetup& setup, const std::function<bool(double seconds)>& watch = nullptr);

}

#endif
