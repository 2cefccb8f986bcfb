// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Pieces of report.html: text, numbers, tables, pictures.

#ifndef TILTCAL_HTML_H
#define TILTCAL_HTML_H

#include <tiltcal/calibration.h>

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal::html
{

/// With so many digits behind the point; "∞" and, for what is not known, "–".
std::string Number(double value, int digits);

/// "618.42 ± 0.31 mm": the digits that two digits of sigma allow. Without a sigma (0, NaN) `digits` of them and the value alone.
std::string WithSigma(const Estimate& e, const std::string& unit, int digits = 3);

/// A table: the first row is the head, the first column names the rows. Cells are HTML already.
std::string Table(const std::vector<std::vector<std::string>>& rows);

/// JPEG as a data: URI, at most `width` px wide, of at most `bytes` bytes where a smaller picture of no less than 480 px allows it.
std::string JpegUri(const cv::Mat& image, int width, size_t bytes);

/// "#rrggbb" of photograph 0, 1, ...; repeats after 12.
std::string PhotoColour(size_t photo);

/// 1, 2 or 5 times a power of ten, no larger than x > 0.
double RoundNumber(double x);

}

#endif
