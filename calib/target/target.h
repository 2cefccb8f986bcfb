// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A calibration target to print, and the same target for POV-Ray. Lengths mm.
// Page frame: origin at the page's top left, x right, y down.

#ifndef TILTCAL_TARGET_H
#define TILTCAL_TARGET_H

#include <tiltcal/board.h>

#include <string>
#include <vector>

namespace tiltcal
{

class FileSet;

/// A point of the page, mm.
struct PagePoint
{
	double x = 0, y = 0;
};

/// Where everything lies on the page. From the top: margin, quiet zone, pattern, quiet
/// zone, the strip with scale bar and text, margin.
struct TargetPage
{
	Board target;
	std::string paper;                 ///< "a3 landscape", "420x300"
	double width = 0, height = 0;
	PagePoint pattern;                 ///< top left of the pattern's bounding box
	double pattern_width = 0, pattern_height = 0;
	double quiet = 0;                  ///< width of the white zone about the pattern
	PagePoint strip;                   ///< top left of the strip
};

const double SCALE_BAR_MM = 100;

/// `paper`: a name (a4, letter, ..; turned as the target needs it), WxH in mm (taken as it
/// is), or "auto", the smallest ISO size that holds the target. Throws UsageError for an
/// unknown name, Refused when the target does not fit, naming a paper that holds it.
TargetPage LayOut(const Board& target, const std::string& paper, double margin_mm);

/// Centres of the circles on the page, row by row.
std::vector<PagePoint> CircleCentres(const TargetPage& page);

/// Top left corners of the black squares on the page. Square (0, 0), top left, is black.
std::vector<PagePoint> BlackSquares(const TargetPage& page);

/// Where the POV-Ray object has its origin: first inner corner, or first circle's centre.
PagePoint Origin(const TargetPage& page);

/// Whether the target looks the same when it is turned by 180 degrees, so that no
/// detector can tell its two ends apart.
bool LooksTheSameTurned(const Board& target);

/// Writes FILE by its suffix: .svg and .pdf (target_print.cpp, cairo, true size), .inc
/// (TargetInc), as part of `set`. Throws UsageError (suffix), FileError.
void WriteTarget(const TargetPage& page, const std::string& file, FileSet& set);

/// The same alone.
void WriteTarget(const TargetPage& page, const std::string& file);

/// Throws UsageError unless the suffix is one that WriteTarget knows.
void CheckTargetSuffix(const std::string& file);

/// target_print.cpp: the page as SVG or PDF, one drawing for both. False when it cannot be written.
bool PrintSvg(const TargetPage& page, const std::string& file);
bool PrintPdf(const TargetPage& page, const std::string& file);

/// target_inc.cpp: the page as a POV-Ray object, world unit mm, frame of a board's photograph
/// (board.h): origin at Origin, x along the columns, y up the rows, z into the board.
std::string TargetInc(const TargetPage& page);

}

#endif
