// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_CSV_H
#define TILTCAL_WRITE_CSV_H

#include <tiltcal/calibration.h>

#include <string>
#include <vector>

namespace tiltcal
{

/// file,column,row,x_px,y_px,sigma_px: one row per corner.
std::string CornersCsv(const std::vector<Photo>& photos);

/// file,x_px,y_px,nx,ny,blur_px,sigma_px: one row per edge (picture axes, y down).
std::string EdgesCsv(const std::vector<Photo>& photos);

/// One row per photograph: how its corners and its blur fit, beside those of the others, and what it is suspected of.
std::string PhotographsCsv(const Calibration& calibration);

/// A field as RFC 4180 wants it: quoted when it holds a comma, a quote or a line end.
std::string CsvField(const std::string& text);

}

#endif
