// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What to photograph next, as text and as a part of report.html; and the page of a calibration that is still being photographed.

#ifndef TILTCAL_REPORT_NEXT_H
#define TILTCAL_REPORT_NEXT_H

#include <tiltcal/calibration.h>

#include <string>
#include <utility>
#include <vector>

namespace tiltcal
{

/// The sigmas after so many photographs, while they arrive.
struct SigmasOfMany
{
	size_t photographs = 0;
	std::vector<ExpectedSigma> sigmas;
};

/// What a page that is drawn again and again shows beside the calibration.
struct WatchNotes
{
	bool on = false;                          ///< the page loads itself again
	std::vector<SigmasOfMany> history;
	std::vector<std::string> events;          ///< the newest last
	std::string waiting;                      ///< no calibration yet: why
	std::vector<std::string> lacking;         ///< what to do about it
	bool beside_earlier = false;              ///< ... and the folder holds a calibration of before
};

/// For report.txt and the terminal: what is missing, and how to take the next photographs.
std::string NextText(const Calibration& calibration);

/// The same for report.html, with where in the picture, and how the sigmas fall.
std::string NextSection(const Calibration& calibration);

/// How sigmas fell with the photographs, and what happened; empty where nothing was watched.
std::string WatchSection(const WatchNotes& notes);

/// The page before there is a calibration. `task`: what was measured so far; may be empty.
std::string WaitingPage(const Task& task, const WatchNotes& notes, const std::string& date);

}

#endif
