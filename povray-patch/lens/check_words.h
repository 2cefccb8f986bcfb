// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a scene says about its tilt_lens camera, word by word and one against the other.

#ifndef TILT_LENS_CHECK_WORDS_H
#define TILT_LENS_CHECK_WORDS_H

#include "lens/lens_spec.h"

namespace tilt_lens
{

/// Throws Refusal when a number is one that no lens has, or words state the same twice.
void CheckWords(const LensSpec& spec);

}

#endif
