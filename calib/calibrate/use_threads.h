// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_USE_THREADS_H
#define TILTCAL_USE_THREADS_H

namespace tiltcal
{

/// While one lives, OpenCV and our solver use at most so many threads, 0 being all processors; then as many as before. Like
/// QuietLibraries' switches these are the process's. Throws UsageError where the number is none.
class UseThreads
{
public:
	explicit UseThreads(int most);
	~UseThreads();
	UseThreads(const UseThreads&) = delete;
	UseThreads& operator=(const UseThreads&) = delete;

private:
	int solver_before, opencv_before;
};

}

#endif
