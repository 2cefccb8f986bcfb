// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_STOPWATCH_H
#define TILTCAL_STOPWATCH_H

#include <chrono>

namespace tiltcal
{

/// Seconds by the clock since it was made.
class Stopwatch
{
public:
	double Seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

private:
	std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

}

#endif
