// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The words of models and effects, each stated once.

#ifndef TILTCAL_NAMES_H
#define TILTCAL_NAMES_H

#include <tiltcal/calibration.h>

#include <array>
#include <optional>
#include <string>

namespace tiltcal
{

struct ModelWords
{
	Model model;
	const char *name, *meaning;
};

/// Every model; the ones to rely on first.
extern const std::array<ModelWords, 5> MODELS;

/// Of the five of Distortion, in its order.
extern const std::array<const char*, 5> DISTORTION_NAMES;

std::optional<Model> ModelNamed(const std::string& name);

/// "exact, a free plane of focus in every state".
const char* MeaningOf(Model model);

std::optional<EffectId> EffectNamed(const std::string& name);

/// "distortion, field_curvature, ..".
std::string EffectNames();

}

#endif
