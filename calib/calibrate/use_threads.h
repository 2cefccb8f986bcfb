// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_USE_THREADS_H
#define TILTCAL_USE_THREADS_H

#include "base/while_any.h"

namespace tiltcal
{

/// Keeps how many threads OpenCV and our solver use.
class ThreadsKept
{
public:
	ThreadsKept();
	~ThreadsKept();

private:
	int solver_before, opencv_before;
};

/// While one lives, OpenCV and our solver use at most so many threads, 0 being all processors; then as many as before. Like
/// QuietLibraries' switches these are the process's: of several the latest's number holds. Throws UsageError where the number is none.
class UseThreads
{
public:
	explicit UseThreads(int most);

private:
	WhileAny<ThreadsKept> kept;
};

}

#endif
