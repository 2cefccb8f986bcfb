// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Files that are being written, for a signal handler that ends the program: it takes them away.

#ifndef TILTCAL_UNFINISHED_H
#define TILTCAL_UNFINISHED_H

#include <csignal>

#include <string>

namespace tiltcal
{

/// `file` is temporary until ForgetUnfinished.
void NoteUnfinished(const std::string& file);

/// `file` is gone or has its place.
void ForgetUnfinished(const std::string& file);

/// For signal handlers, on any thread. True: all unfinished files are removed. False: files are changing places; the signal is raised
/// again when they have.
bool RemoveUnfinished(int signal);

/// While one lives, this thread is not interrupted and RemoveUnfinished waits.
class Uninterrupted
{
public:
	Uninterrupted();
	~Uninterrupted();
	Uninterrupted(const Uninterrupted&) = delete;
	Uninterrupted& operator=(const Uninterrupted&) = delete;

private:
	sigset_t before;
};

}

#endif
