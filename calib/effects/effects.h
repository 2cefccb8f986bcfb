// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which of tilt_lens's effects a calibration writes into its camera blocks: those that the photographs show, or those asked for.

#ifndef TILTCAL_EFFECTS_H
#define TILTCAL_EFFECTS_H

#include <tiltcal/calibrate.h>

#include "lens/optical_vignetting.h"

#include <string>
#include <vector>

namespace tiltcal
{

/// "auto", "all", "none" or names separated by commas. Throws UsageError, which lists the names.
EffectChoice ParseEffects(const std::string& text);

/// Fills calibration.effects, one for every name, from what else it holds. Throws Refused where a name of the list could not be
/// estimated, saying why.
void ChooseEffects(const EffectChoice& choice, Calibration& calibration);

/// The numbers and sigmas of distortion and field curvature as `calibration` tells them by now, where those are written: sigmas grow after the choice.
void TellWidened(const EffectChoice& choice, Calibration& calibration);

/// Whether it is written. False for the paper's model.
bool Uses(const Calibration& calibration, EffectId effect);

/// The answer whose numbers are written, or, when none is, that of both kinds of vignetting.
const FalloffAnswer& FalloffOf(const Calibration& calibration);

/// The answer that tells the rim: FalloffOf, or where no rim is written that of both kinds of vignetting.
const FalloffAnswer& RimOf(const Calibration& calibration);

/// The rims that are written.
std::vector<RimEstimate> WrittenRims(const Calibration& calibration);

/// One row per effect, for people: what, value, significance, held out without and with, written or not and why.
std::string EffectsText(const Calibration& calibration);

}

#endif
