// SPDX-License-Identifier: AGPL-3.0-or-later
//
// report.html of results.json.

#ifndef PAPER_PAGE_H
#define PAPER_PAGE_H

#include <string>

namespace paper
{

/// Writes out/report.html: its numbers are those of out/results.json, its pictures lie within it, so that it opens offline.
/// Throws tiltcal::Error.
void WritePage(const std::string& out);

}

#endif
