// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effects of a lens: which of them a scene calls for, and the steps that its rays
// take. Free of POV-Ray.

#ifndef TILT_LENS_EFFECTS_H
#define TILT_LENS_EFFECTS_H

#include <string>

#include "lens/lens_spec.h"

namespace tilt_lens
{

/// Takes the effects of the scene's words into a lens that is resolved otherwise, checks
/// that they can be rendered, and settles the lens's steps. Throws Refusal.
void ResolveEffects(const LensSpec& spec, const CameraVectors& camera, TiltLens& lens);

/// The effects of the lens by their words, in the order of the steps, with commas between;
/// empty for none.
std::string EffectNames(const TiltLens& lens);

/// Words of the scene that need an opening, where the lens has none: they do nothing. Empty
/// where it has one.
std::string IdleWords(const LensSpec& spec, const TiltLens& lens);

}

#endif
