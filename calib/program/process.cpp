// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/process.h"

#include "base/unfinished.h"
#include <tiltcal/error.h>
#include "program/temporary_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <thread>
#include <utility>

extern char** environ;

namespace tiltcal
{

namespace
{

volatile std::sig_atomic_t interrupted = 0;
bool catching = false;

bool second_ends = false;
char ending[80] = "";   // what is said at the end

void EndNow(int signal)
{
	if (!RemoveUnfinished(signal))
		return;
	if (write(STDERR_FILENO, ending, std::strlen(ending)) < 0) {}
	std::signal(signal, SIG_DFL);
	raise(signal);   // when the handler is left
}

void NoteInterrupt(int signal)
{
	if (interrupted && second_ends)
		return EndNow(signal);
	interrupted = signal;
}

const int INTERRUPTS[] = { SIGINT, SIGTERM, SIGHUP };

double InSeconds(const timeval& time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); }

typedef std::chrono::steady_clock Clock;

double Since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

void SleepMilliseconds(int time) { std::this_thread::sleep_for(std::chrono::milliseconds(time)); }

/// A nameless file with this text, read from its beginning. A file never blocks whom a pipe would, and has no SIGPIPE.
int NamelessFile(const std::string& text)
{
	std::string name = TemporaryTemplate("process");
	const int file = mkstemp(name.data());
	if (file < 0)
		throw FileError(fmt::format("{}: no temporary file ({}); set TMPDIR to a place that can be written", name, std::strerror(errno)));
	unlink(name.c_str());
	fcntl(file, F_SETFD, FD_CLOEXEC);
	for (size_t at = 0; at < text.size();)
	{
		const ssize_t written = write(file, text.data() + at, text.size() - at);
		if (written < 0 && errno == EINTR)
			continue;
		if (written <= 0)
		{
			const int fault = errno;
			close(file);
			throw FileError(fmt::format("{}: cannot be written ({}); set TMPDIR to a place with room", name, std::strerror(fault)));
		}
		at += static_cast<size_t>(written);
	}
	lseek(file, 0, SEEK_SET);
	return file;
}

std::string Contents(int descriptor)
{
	std::string text;
	lseek(descriptor, 0, SEEK_SET);
	char part[4096];
	for (ssize_t n = 0; (n = read(descriptor, part, sizeof part)) > 0;)
		text.append(part, static_cast<size_t>(n));
	return text;
}

/// This program's environment with `added`, which come first: the first of a name counts.
std::vector<char*> Environment(const std::vector<std::string>& added)
{
	std::vector<char*> all;
	for (const std::string& one : added)
		all.push_back(const_cast<char*>(one.c_str()));
	for (char** one = environ; one && *one; ++one)
	{
		const char* const equals = std::strchr(*one, '=');
		const size_t length = equals ? static_cast<size_t>(equals - *one) + 1 : 0;
		if (std::none_of(added.begin(), added.end(), [&](const std::string& mine) { return length > 0 && mine.compare(0, length, *one, length) == 0; }))
			all.push_back(*one);
	}
	all.push_back(nullptr);
	return all;
}

/// What the child needs, made before it is: other threads may hold locks when it is forked.
struct Prepared
{
	std::vector<char*> words, environment;
	const char* folder;
	const char* log;
	int input, output;     ///< descriptors, -1 for none
};

/// In the child: only calls that are safe between fork and exec.
[[noreturn]] void Become(const Prepared& what)
{
	setpgid(0, 0);
#ifdef __linux__
	prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
	const int out = what.output >= 0 ? what.output : open(what.log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
	const int in = what.input >= 0 ? what.input : open("/dev/null", O_RDONLY);
	if (out < 0 || in < 0 || dup2(in, 0) < 0 || dup2(out, 1) < 0 || dup2(out, 2) < 0 || (*what.folder && chdir(what.folder) != 0))
		_exit(126);
	// One that was 0 already, because this process was started without stdin, is still closed by exec.
	for (const int kept : { 0, 1, 2 })
		fcntl(kept, F_SETFD, 0);
	environ = const_cast<char**>(what.environment.data());
	execvp(what.words[0], what.words.data());
	_exit(127);
}

}

void EndAtInterrupts(const std::string& name)
{
	std::snprintf(ending, sizeof ending, "\n%s: interrupted\n", name.c_str());
	for (const int signal : INTERRUPTS)
		if (std::signal(signal, EndNow) == SIG_IGN)
			std::signal(signal, SIG_IGN);
}

void CatchInterrupts(Second second)
{
	// With a second one to end it, the first is a wish: children go on.
	second_ends = second == Second::ENDS;
	catching = !second_ends;
	for (const int signal : INTERRUPTS)
		// nohup's stays; a script's background jobs ignore Ctrl-C, and are still to be ended by `kill -INT`.
		if (std::signal(signal, NoteInterrupt) == SIG_IGN && signal == SIGHUP)
			std::signal(signal, SIG_IGN);
}

bool WasInterrupted() { return interrupted != 0; }

void CheckInterrupt()
{
	if (interrupted)
		throw Interrupted{interrupted};
}

Process::Process(const ProcessSetup& setup) : timeout(setup.timeout)
{
	Prepared what{{}, Environment(setup.environment), setup.folder.c_str(), setup.log.c_str(), -1, -1};
	for (const std::string& word : setup.command)
		what.words.push_back(const_cast<char*>(word.c_str()));
	what.words.push_back(nullptr);
	if (setup.log.empty())
		what.output = captured = NamelessFile("");
	try
	{
		if (!setup.input.empty())
			what.input = NamelessFile(setup.input);
	}
	catch (...)
	{
		if (captured >= 0)
			close(captured);
		throw;
	}
	start = Clock::now();
	child = fork();
	if (child == 0)
		Become(what);
	const int fault = errno;
	if (what.input >= 0)
		close(what.input);
	if (child < 0)
	{
		if (captured >= 0)
			close(captured);
		throw Refused(fmt::format("cannot start {}: {}", setup.command[0], std::strerror(fault)));
	}
	// Here too: whoever comes first, the group is there before it is killed.
	setpgid(child, child);
}

Process::Process(Process&& other) noexcept
	: child(std::exchange(other.child, -1)), captured(std::exchange(other.captured, -1)), start(other.start), timeout(other.timeout), killed(other.killed)
{
}

Process::~Process()
{
	if (child > 0)
	{
		kill(-child, SIGKILL);
		while (waitpid(child, nullptr, 0) < 0 && errno == EINTR)
			;
	}
	if (captured >= 0)
		close(captured);
}

double Process::Seconds() const { return Since(start); }

/// Without reaping it: until then its group is nobody else's.
bool Process::Ended(bool block)
{
	siginfo_t info{};
	while (waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT | (block ? 0 : WNOHANG)) < 0)
		if (errno != EINTR)
			throw Refused(fmt::format("lost a program: {}", std::strerror(errno)));
	return info.si_pid == child;
}

ProcessResult Process::Reap()
{
	ProcessResult result;
	int status = 0;
	rusage usage{};
	while (wait4(child, &status, 0, &usage) < 0)
		if (errno != EINTR)
			throw Refused(fmt::format("lost a program: {}", std::strerror(errno)));
	child = -1;
	result.wall = Since(start);
	result.cpu = InSeconds(usage.ru_utime) + InSeconds(usage.ru_stime);
	result.most_memory = double(usage.ru_maxrss) / 1024;
	result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
	result.late = killed && WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
	if (captured >= 0)
		result.said = Contents(captured);
	return result;
}

std::optional<ProcessResult> Process::Poll()
{
	if (Ended(false))
		return Reap();
	if (timeout > 0 && !killed && Seconds() > timeout)
	{
		kill(-child, SIGKILL);
		killed = true;
	}
	return std::nullopt;
}

ProcessResult Process::Wait()
{
	Ended(true);
	return Reap();
}

void Process::End()
{
	kill(-child, SIGTERM);
	const auto asked = Clock::now();
	while (!Ended(false))
	{
		if (Since(asked) > 2)
			kill(-child, SIGKILL);
		SleepMilliseconds(20);
	}
	// What its leader has left behind.
	kill(-child, SIGKILL);
}

ProcessResult RunProcess(const ProcessSetup& setup, const std::function<bool(double seconds)>& watch)
{
	Process process(setup);
	// Where nothing is to be watched its time is exact.
	if (!watch && setup.timeout <= 0 && !catching)
		return process.Wait();
	double watched = 0;
	for (;;)
	{
		if (const std::optional<ProcessResult> result = process.Poll())
			return *result;
		if (catching && interrupted)
		{
			process.End();
			CheckInterrupt();
		}
		SleepMilliseconds(5);
		if (!watch || process.Seconds() < watched + 0.1)
			continue;
		watched = process.Seconds();
		if (!watch(watched))
		{
			process.End();
			ProcessResult result = process.Wait();
			result.stopped = true;
			return result;
		}
	}
}

}
