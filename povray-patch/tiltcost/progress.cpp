// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/progress.h"

#include "program/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace tiltcost
{

std::string TimeLeft(double share, double seconds)
{
	if (!isatty(STDERR_FILENO) || !(share > 0) || share >= 1 || seconds < 1)
		return "";
	return ", some " + tiltcal::TimeText(seconds * (1 - share) / share) + " to go";
}

void Progress::Begin(const std::string& title)
{
	name = title;
	last.clear();
	Show("...");
}

void Progress::Show(const std::string& state)
{
	last = state;
	// \033[K clears what a longer state left.
	if (isatty(STDERR_FILENO))
		fmt::print(stderr, "\rtiltcost: {}: {}\033[K", name, state);
}

void Progress::End()
{
	if (isatty(STDERR_FILENO))
		fmt::print(stderr, "\r\033[K");
	else
		fmt::print(stderr, "tiltcost: {}: {}\n", name, last);
}

}
