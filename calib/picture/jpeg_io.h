// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_JPEG_IO_H
#define TILTCAL_JPEG_IO_H

#include "picture/picture_file.h"

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Decodes a baseline or progressive JPEG of 8 bits as coded: CV_8UC1 or CV_8UC3 (blue first). EXIF orientation
/// is not applied. Throws FileError: CMYK, and anything that libjpeg would fill with grey.
cv::Mat DecodeJpeg(const PictureFile& picture);

/// Whether colour is stored at less than the full size (4:2:0, 4:2:2). Throws FileError: damaged.
bool HasSubsampledColour(const PictureFile& picture);

}

#endif
