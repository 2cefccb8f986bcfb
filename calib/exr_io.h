// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_EXR_IO_H
#define TILTCAL_EXR_IO_H

#include <opencv2/core.hpp>

#include <string>

namespace tiltcal
{

/// Reads an OpenEXR file: channel Y as CV_32FC1, or R, G, B as CV_32FC3 in OpenCV's
/// order (blue first). The data window is the picture. Throws FileError.
cv::Mat ReadExr(const std::string& file);

}

#endif
