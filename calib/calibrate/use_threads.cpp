// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/use_threads.h"

#include "solve/least_squares.h"
#include <tiltcal/error.h>

#include <fmt/format.h>
#include <opencv2/core.hpp>

namespace tiltcal
{

UseThreads::UseThreads(int most) : solver_before(LimitThreads(0)), opencv_before(cv::getNumThreads())
{
	LimitThreads(most > 0 ? most : solver_before);
	if (most < 0)
		throw UsageError(fmt::format("`threads` {}: give 0 for all processors, or a number of threads", most));
	if (most > 0)
		cv::setNumThreads(most);
}

UseThreads::~UseThreads()
{
	LimitThreads(solver_before);
	cv::setNumThreads(opencv_before);
}

}
