// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/quiet.h"

#include <glog/logging.h>
#include <opencv2/core/utils/logger.hpp>

namespace tiltcal
{

LibrariesMuted::LibrariesMuted() : glog_level(FLAGS_minloglevel), opencv_level(cv::utils::logging::getLogLevel())
{
	FLAGS_minloglevel = google::GLOG_FATAL;
	cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
}

LibrariesMuted::~LibrariesMuted()
{
	FLAGS_minloglevel = glog_level;
	cv::utils::logging::setLogLevel(static_cast<cv::utils::logging::LogLevel>(opencv_level));
}

}
