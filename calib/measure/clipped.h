// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_CLIPPED_H
#define TILTCAL_CLIPPED_H

#include <tiltcal/photo.h>

#include <opencv2/core.hpp>

namespace tiltcal
{

/// 255 where some channel of a linear picture (CV_32F, any channels) is at that channel's white level, 0 elsewhere; CV_8UC1. Empty when no channel has one.
/// White levels are the picture's own: full scale, or wherever so many pixels have the very greatest value that noise
/// cannot have put them there, as in 12 bits left in 16 or in floats of any unit. A picture without any noise has no such place.
cv::Mat ClippedPixels(const cv::Mat& linear);

/// The share of the photograph's edges whose bright side is clipped. 0 for an empty mask.
double ClippedShare(const cv::Mat& clipped, const Photo& photo);

}

#endif
