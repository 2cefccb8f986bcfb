// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/process.h"

#include <tiltcal/error.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

namespace tiltcost
{

namespace
{

volatile std::sig_atomic_t interrupted = 0;

void NoteInterrupt(int signal) { interrupted = signal; }

double Seconds(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

typedef std::chrono::steady_clock Clock;

double Since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// In the child: only calls that are safe between fork and exec.
[[noreturn]] void Become(char* const* words, const char* log, char* environment)
{
	// POV-Ray waits for the user's interrupt in its own way; ours ends it.
	setpgid(0, 0);
	prctl(PR_SET_PDEATHSIG, SIGKILL);
	const int out = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
	const int in = open("/dev/null", O_RDONLY);
	if (out < 0 || in < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || putenv(environment) != 0)
		_exit(126);
	execvp(words[0], words);
	_exit(127);
}

/// Asks the child to end, and insists after two seconds.
void End(pid_t child)
{
	kill(child, SIGTERM);
	const auto start = Clock::now();
	int status;
	while (waitpid(child, &status, WNOHANG) == 0)
	{
		if (Since(start) > 2)
			kill(child, SIGKILL);
		std::this_thread::sleep_for(std::chrono::milliseconds(20));
	}
}

}

void CatchInterrupts()
{
	for (const int signal : {SIGINT, SIGTERM, SIGHUP})
		std::signal(signal, NoteInterrupt);
}

void CheckInterrupt()
{
	if (interrupted)
		throw Interrupted{interrupted};
}

TemporaryFolder::TemporaryFolder()
{
	const char* place = std::getenv("TMPDIR");
	std::string name = std::string(place && *place ? place : "/tmp") + "/tiltcost.XXXXXX";
	if (!mkdtemp(name.data()))
		throw tiltcal::FileError(fmt::format("{}: no temporary folder ({}); set TMPDIR to a place that can be written", name, std::strerror(errno)));
	path = std::filesystem::absolute(name).string();
}

TemporaryFolder::~TemporaryFolder()
{
	std::error_code ignored;
	std::filesystem::remove_all(path, ignored);
}

ProcessResult RunProcess(const std::vector<std::string>& command, const std::string& environment, const std::string& log,
	const std::function<bool(double seconds)>& watch)
{
	std::vector<char*> words;
	for (const std::string& word : command)
		words.push_back(const_cast<char*>(word.c_str()));
	words.push_back(nullptr);
	std::string variable = environment;

	const auto start = Clock::now();
	const pid_t child = fork();
	if (child < 0)
		throw tiltcal::Refused(fmt::format("cannot start {}: {}", command[0], std::strerror(errno)));
	if (child == 0)
		Become(words.data(), log.c_str(), variable.data());

	ProcessResult result;
	int status = 0;
	rusage usage{};
	double watched = 0;
	for (pid_t ended = 0; (ended = wait4(child, &status, WNOHANG, &usage)) != child; )
	{
		if (ended < 0 && errno != EINTR)
			throw tiltcal::Refused(fmt::format("lost {}: {}", command[0], std::strerror(errno)));
		if (interrupted)
		{
			End(child);
			CheckInterrupt();
		}
		std::this_thread::sleep_for(std::chrono::milliseconds(5));
		if (Since(start) < watched + 0.1)
			continue;
		watched = Since(start);
		if (!watch(watched))
		{
			End(child);
			result.stopped = true;
			return result;
		}
	}
	result.wall = Since(start);
	result.cpu = Seconds(usage.ru_utime) + Seconds(usage.ru_stime);
	result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
	return result;
}

}
