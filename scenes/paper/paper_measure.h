// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Everything the page says, as numbers.

#ifndef PAPER_MEASURE_H
#define PAPER_MEASURE_H

#include "paper_run.h"

namespace paper
{

/// Writes results.json and the difference pictures into run.out. Throws tiltcal::Error.
void Measure(const Run& run);

}

#endif
