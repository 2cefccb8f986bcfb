// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How far a long piece of work is, in a line at the bottom of the terminal that is written over; nowhere else: not into files or logs.

#ifndef TILTCAL_PROGRESS_H
#define TILTCAL_PROGRESS_H

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>
#include <thread>

namespace tiltcal
{

/// "12 s", "3 min 20 s", "1 h 5 min".
std::string TimeText(double seconds);

/// "measuring: 5 of 18, 12 s, some 31 s to go". `seconds`: expected of all, 0: not known; told by what is done where `total` > 0.
std::string ProgressText(const std::string& what, size_t done, size_t total, double elapsed, double seconds);

/// While one lives; one at a time. Messages (RunProgram's) go above the line.
class Progress
{
public:
	/// `total` 0: not counted.
	explicit Progress(const std::string& what, size_t total = 0, double expected_seconds = 0);
	~Progress();
	Progress(const Progress&) = delete;
	Progress& operator=(const Progress&) = delete;

	/// So many are done. From any thread.
	void Done(size_t count);
	/// What is being done now.
	void Say(const std::string& what);

private:
	void Tick();

	const std::chrono::steady_clock::time_point start;
	std::mutex mutex;
	std::condition_variable end;
	std::string what;
	size_t done = 0;
	const size_t total;
	const double expected;
	bool over = false;
	std::thread ticker;
};

/// Writes to stderr, above the line of a Progress.
void WriteAbove(const char* text, size_t size);

}

#endif
