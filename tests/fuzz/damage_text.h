// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "random.h"

#include <string>

/// A text with a few damages of its own kind: numbers and words replaced by nasty ones, lines lost, doubled or moved, deep brackets,
/// other line ends; a third of the time as Damaged (damage.h) does it.
std::string DamagedText(std::string text, const std::string& other, Random& random);
