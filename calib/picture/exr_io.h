// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_EXR_IO_H
#define TILTCAL_EXR_IO_H

#include "picture/picture_file.h"

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Decodes OpenEXR, scan lines or tiles (full resolution), half or float: channels R, G, B as CV_32FC3 in OpenCV's
/// order (blue first), else Y as CV_32FC1: of luminance/chroma pictures, the luminance. Other channels are
/// not looked at (`left_out` names them). The data window is the picture; of several parts, the first. Throws FileError; deep pictures too.
cv::Mat DecodeExr(const PictureFile& picture, std::string* left_out = nullptr);

}

#endif
