// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_PNG_IO_H
#define TILTCAL_PNG_IO_H

#include "picture/picture_file.h"

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Decodes a PNG of any kind as coded: CV_8U or CV_16U, one channel or three (blue first). Palettes and
/// 1, 2, 4 bits become 8, alpha is dropped (`left_out` then names it), gAMA is ignored. Throws FileError, also when only a part is there.
cv::Mat DecodePng(const PictureFile& picture, std::string* left_out = nullptr);

}

#endif
