// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The page's sections, each HTML of its own, all numbers from results.json.

#ifndef PAPER_PAGE_PARTS_H
#define PAPER_PAGE_PARTS_H

#include "paper_tables.h"

#include <string>

namespace paper
{

/// "5.06 ± 0.01 mm" of { value, sigma }; a dash for null.
std::string WithSigma(const Json& estimate, const std::string& unit, int digits);

/// "+5°" and so on: what a reader sees of a state's name.
std::string Title(const std::string& state);

/// Both tables in a few lines.
std::string Headline(const Json& results);

std::string TiltSection(const Json& results);
std::string BrightnessSection(const Json& results);

/// What the difference is made of: bars, tables, how each part was separated, the closed loop, the curve of sampling noise (a plot from
/// `out`), and what a thin lens cannot know.
std::string AblationSection(const Json& results, const std::string& out);

std::string ReproduceSection(const Json& results);

/// An SVG file as <img> with its content inside, or nothing where the file is not there (gnuplot missing).
std::string SvgImage(const std::string& file, const std::string& alt);

}

#endif
