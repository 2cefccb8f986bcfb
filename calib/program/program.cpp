// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/program.h"

#include "base/files.h"
#include "program/process.h"
#include "program/progress.h"
#include "program/spelling.h"

#include <fmt/format.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <tiltcal/error.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <locale>
#include <memory>
#include <mutex>
#include <sys/stat.h>
#include <unistd.h>

namespace tiltcal
{

namespace
{

/// Nothing in a file name moves the terminal's cursor. (Bytes of other encodings stay: the terminal may show them.)
std::string Harmless(std::string text)
{
	for (char& c : text)
		if ((static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F)
			c = '?';
	return text;
}

const char NOT_WRITTEN[] = "the results could not be written to stdout";

int Fail(const std::string& name, ExitCode code, const std::string& message)
{
	fmt::print(stderr, "{}: error: {}\n", name, Harmless(SpelledAsOptions(message)));
	return code;
}

/// To stderr, above the line of progress.
class MessageSink : public spdlog::sinks::base_sink<std::mutex>
{
protected:
	void sink_it_(const spdlog::details::log_msg& message) override
	{
		spdlog::memory_buf_t text;
		formatter_->format(message, text);
		WriteAbove(text.data(), text.size());
	}
	void flush_() override {}
};

std::string Quoted(const std::string& word)
{
	const std::string plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
	if (!word.empty() && word.find_first_not_of(plain) == std::string::npos)
		return word;
	std::string out = "'";
	for (const char c : word)
		out += c == '\'' ? std::string("'\\''") : std::string(1, c);
	return out + "'";
}

}

int RunProgram(const std::string& name, const std::function<int()>& run)
{
	spdlog::set_default_logger(std::make_shared<spdlog::logger>(name, std::make_shared<MessageSink>()));
	spdlog::set_pattern(name + ": %v");
	// Options are numbers with points, whatever a preloaded library made of LC_ALL.
	std::setlocale(LC_ALL, "C");
	std::locale::global(std::locale::classic());
	// Over `ulimit -f` is an error of the write, as a full disk is.
	std::signal(SIGXFSZ, SIG_IGN);
	EndAtInterrupts(name);
	try
	{
		const int code = run();
		// A full disk or a closed pipe must not look like success.
		if (code == EXIT_DONE && (std::fflush(stdout) != 0 || std::ferror(stdout)))
			return Fail(name, EXIT_FILE, NOT_WRITTEN);
		return code;
	}
	catch (const Error& e)
	{
		return Fail(name, e.Code(), e.what());
	}
	catch (const Interrupted& e)
	{
		fmt::print(stderr, "\n{}: interrupted\n", name);
		return 128 + e.signal;
	}
	catch (const std::exception& e)
	{
		// Longer texts are found out while they are printed.
		return std::ferror(stdout) ? Fail(name, EXIT_FILE, NOT_WRITTEN) : Fail(name, EXIT_REFUSED, fmt::format("unexpected: {}", e.what()));
	}
}

Log ProgramLog()
{
	return Log([](Severity severity, const std::string& message)
	{
		spdlog::log(severity == Severity::WARNING ? spdlog::level::warn : spdlog::level::info, "{}", Harmless(SpelledAsOptions(message)));
	});
}

std::FILE* ReportBeside(const std::vector<std::string>& outputs)
{
	struct stat out, nothing, its;
	const bool seen = fstat(STDOUT_FILENO, &out) == 0 && !(stat("/dev/null", &nothing) == 0 && nothing.st_rdev == out.st_rdev && S_ISCHR(out.st_mode));
	for (const std::string& output : outputs)
		if (seen && stat(output.c_str(), &its) == 0 && its.st_dev == out.st_dev && its.st_ino == out.st_ino)
			return stderr;
	return stdout;
}

std::string CommandLine(int argc, const char* const* argv)
{
	std::string out = argc > 0 ? Quoted(BaseName(argv[0])) : "";
	for (int k = 1; k < argc; ++k)
		out += " " + Quoted(argv[k]);
	return out;
}

}
