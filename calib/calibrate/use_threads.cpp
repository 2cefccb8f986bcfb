// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/use_threads.h"

#include "solve/least_squares.h"
#include <tiltcal/error.h>

#include <fmt/format.h>
#include <opencv2/core.hpp>

namespace tiltcal
{

ThreadsKept::ThreadsKept() : solver_before(LimitThreads(0)), opencv_before(cv::getNumThreads())
{
	LimitThreads(solver_before);
}

ThreadsKept::~ThreadsKept()
{
	LimitThreads(solver_before);
	cv::setNumThreads(opencv_before);
}

UseThreads::UseThreads(int most)
{
	if (most < 0)
		throw UsageError(fmt::format("`threads` {}: give 0 for all processors, or a number of threads", most));
	if (most == 0)
		return;
	LimitThreads(most);
	cv::setNumThreads(most);
}

}
