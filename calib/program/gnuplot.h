// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_GNUPLOT_H
#define TILTCAL_GNUPLOT_H

#include "base/file_set.h"

#include <string>

namespace tiltcal
{

/// Runs gnuplot on `script` (terminal and output are set here) and leaves the picture in
/// `file`, atomically: SVG when that is its suffix, else PNG. `width` and `height` in pixels. Returns false, with a warning on the log, when gnuplot is missing
/// or fails: a plot is an extra, not a reason to lose the results.
bool Plot(const std::string& file, const std::string& script, int width, int height);

/// The same as one file of a set.
bool Plot(FileSet& set, const std::string& file, const std::string& script, int width, int height);

/// Text as an expression of gnuplot: in single quotes, in which nothing is special, and pieces of double quotes for control characters.
std::string GnuplotString(const std::string& text);

}

#endif
