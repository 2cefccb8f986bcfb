// SPDX-License-Identifier: AGPL-3.0-or-later
//
// One line on stderr that is written over, where stderr is a terminal; elsewhere each
// stage's title and its last word.

#ifndef TILTCOST_PROGRESS_H
#define TILTCOST_PROGRESS_H

#include <string>

namespace tiltcost
{

/// ", some 12 s to go" of work of which this share took so many seconds; nothing for files, logs and a share of 0 or 1.
std::string TimeLeft(double share, double seconds);

class Progress
{
public:
	void Begin(const std::string& title);
	void Show(const std::string& state);
	void End();

private:
	std::string name, last;
};

}

#endif
