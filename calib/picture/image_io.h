// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pictures in linear light. Pixel centres are at integers, (0, 0) is top left.

#ifndef TILTCAL_IMAGE_IO_H
#define TILTCAL_IMAGE_IO_H

#include <tiltcal/photo.h>
#include <tiltcal/transfer.h>

#include <opencv2/core.hpp>

#include <string>

namespace tiltcal
{

struct PhotographFacts;

/// Reads PNG, JPEG, TIFF (8, 16 bit integer or float) or OpenEXR into linear light:
/// CV_32FC1 or CV_32FC3 (blue first), 1 = the integer formats' full scale.
/// The transfer curve applies to the integer formats; floating point is linear.
/// The format is told by the content. Alpha is dropped; orientation (EXIF, TIFF) is not
/// applied, in any format: pixels are where the sensor had them.
/// Throws FileError, and nothing else, for anything that is not a whole picture of these
/// (picture_file.h has the limits): also CMYK, NaN or infinite pixels, negative light.
/// `facts`, when given, receives what EXIF says, which channels are left out, and how light and colour are stored.
cv::Mat ReadLinear(const std::string& file, const Transfer& transfer, PhotographFacts* facts = nullptr);

/// Luminance (Rec. 709 / sRGB primaries) as CV_32FC1.
cv::Mat Luminance(const cv::Mat& linear);

/// Value of a CV_32FC1 picture at a point in it (0 <= x <= cols - 1, 0 <= y <= rows - 1), between its four pixels.
double Bilinear(const cv::Mat& image, double x, double y);

/// The light that a share of the pixels exceeds not; of all channels, a part of the pixels stands for all. CV_32F.
double LightQuantile(const cv::Mat& linear, double share);

/// The light that 1 % of the pixels exceed, likewise.
double BrightestHundredth(const cv::Mat& linear);

/// What to show a picture with: 1, but where most of it is brighter than white or all of it is dark, as the counts of a sensor and other units are, what
/// makes its brightest hundredth white.
double DisplayGain(const cv::Mat& linear);

/// 8-bit sRGB picture of `linear` times `gain`, CV_8UC1 or CV_8UC3.
cv::Mat ToDisplay(const cv::Mat& linear, double gain);

/// The same with its DisplayGain.
cv::Mat ToDisplay(const cv::Mat& linear);

/// An 8-bit picture as a PNG file's bytes.
std::string PngOf(const cv::Mat& image);

/// Writes an 8-bit picture as PNG, atomically. Throws FileError.
void WritePng(const std::string& file, const cv::Mat& image);

}

#endif
