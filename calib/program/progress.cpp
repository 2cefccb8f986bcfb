// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace tiltcal
{

namespace
{

std::mutex terminal;
std::string shown;   // what the line says; empty: there is none

const char* const CLEAR = "\r\033[K";

void Show(const std::string& line)
{
	const std::lock_guard<std::mutex> lock(terminal);
	if (line.empty() && shown.empty())
		return;
	shown = line;
	std::fputs(CLEAR, stderr);
	std::fputs(shown.c_str(), stderr);
	std::fflush(stderr);
}

/// A line that wraps could not be cleared.
std::string Short(const std::string& line)
{
	const size_t most = 78;
	return line.size() <= most ? line : line.substr(0, most - 2) + "..";
}

}

std::string TimeText(double seconds)
{
	const long s = std::lround(seconds);
	return s < 100 ? fmt::format("{} s", s) : s < 5940 ? fmt::format("{} min {} s", s / 60, s % 60) : fmt::format("{} h {} min", s / 3600, s % 3600 / 60);
}

std::string ProgressText(const std::string& what, size_t done, size_t total, double elapsed, double seconds)
{
	const double all = total > 0 && done > 0 ? elapsed * double(total) / double(done) : seconds;
	std::string text = what + ": ";
	if (total > 0)
		text += fmt::format("{} of {}, ", done, total);
	text += TimeText(elapsed);
	if (all > elapsed)
		text += ", some " + TimeText(all - elapsed) + " to go";
	return text;
}

Progress::Progress(const std::string& title, size_t count, double expected_seconds)
	: start(std::chrono::steady_clock::now()), what(title), total(count), expected(expected_seconds)
{
	if (isatty(STDERR_FILENO))
		ticker = std::thread([this] { Tick(); });
}

Progress::~Progress()
{
	if (!ticker.joinable())
		return;
	{
		const std::lock_guard<std::mutex> lock(mutex);
		over = true;
	}
	end.notify_all();
	ticker.join();
	Show("");
}

void Progress::Done(size_t count)
{
	const std::lock_guard<std::mutex> lock(mutex);
	done = count;
}

void Progress::Say(const std::string& title)
{
	const std::lock_guard<std::mutex> lock(mutex);
	what = title;
}

void Progress::Tick()
{
	std::unique_lock<std::mutex> lock(mutex);
	while (!over)
	{
		// What takes less than the first pause is not worth a line.
		end.wait_for(lock, std::chrono::milliseconds(400));
		if (!over)
			Show(Short(ProgressText(what, done, total, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), expected)));
	}
}

void WriteAbove(const char* text, size_t size)
{
	const std::lock_guard<std::mutex> lock(terminal);
	if (!shown.empty())
		std::fputs(CLEAR, stderr);
	std::fwrite(text, 1, size, stderr);
	if (!shown.empty())
		std::fputs(shown.c_str(), stderr);
	std::fflush(stderr);
}

}
