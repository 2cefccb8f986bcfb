// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include "random.h"

#include <string>

/// `bytes` with one to four damages: flipped bits, a cut, a part taken from `other` or from elsewhere in
/// itself, a part lost, numbers of its header replaced by extreme ones, noise. The checksums of a PNG are
/// put right half of the time: otherwise hardly a damage would get past them.
std::string Damaged(std::string bytes, const std::string& other, Random& random);
