// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_TIFF_IO_H
#define TILTCAL_TIFF_IO_H

#include "picture/picture_file.h"

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Decodes the first picture of a TIFF or BigTIFF as coded: CV_8U, CV_16U (unsigned) or CV_32F, CV_64F, one channel
/// or three (blue first), in strips or tiles, planes together or apart. White-is-zero is inverted, alpha dropped (`left_out` then names it),
/// the orientation tag not applied. Throws FileError: other kinds, by name, and what is damaged.
cv::Mat DecodeTiff(const PictureFile& picture, std::string* left_out = nullptr, bool* subsampled_colour = nullptr);

}

#endif
