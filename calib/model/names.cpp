// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/names.h"

namespace tiltcal
{

const std::array<ModelWords, 5> MODELS{ {
	{ Model::LENS, "lens", "a real lens with aberrations, one for all states" },
	{ Model::CURVED, "curved", "exact, with a field curvature common to all states" },
	{ Model::PLANE, "plane", "exact, a free plane of focus in every state" },
	{ Model::RIGID, "rigid", "exact, the lens only turns and keeps f and w" },
	{ Model::PAPER, "paper", "Baba, Nakane, Hiura (3), (4), (1)" },
} };

const std::array<const char*, 5> DISTORTION_NAMES{ "k1", "k2", "p1", "p2", "k3" };

namespace
{

const struct
{
	EffectId id;
	const char* name;
} EFFECTS[] = {
	{ EffectId::DISTORTION, "distortion" },
	{ EffectId::FIELD_CURVATURE, "field_curvature" },
	{ EffectId::VIGNETTING_NATURAL, "vignetting_natural" },
	{ EffectId::VIGNETTING_OPTICAL, "vignetting_optical" },
	{ EffectId::CHROMATIC_LATERAL, "chromatic_lateral" },
	{ EffectId::CHROMATIC_AXIAL, "chromatic_axial" },
	{ EffectId::BLADES, "blades" },
};

const ModelWords& WordsOf(Model model)
{
	for (const ModelWords& words : MODELS)
		if (words.model == model)
			return words;
	return MODELS[0];
}

}

const char* NameOf(Model model) { return WordsOf(model).name; }
const char* MeaningOf(Model model) { return WordsOf(model).meaning; }

std::optional<Model> ModelNamed(const std::string& name)
{
	for (const ModelWords& words : MODELS)
		if (name == words.name)
			return words.model;
	return std::nullopt;
}

const char* NameOf(EffectId effect)
{
	for (const auto& words : EFFECTS)
		if (words.id == effect)
			return words.name;
	return "";
}

std::optional<EffectId> EffectNamed(const std::string& name)
{
	for (const auto& words : EFFECTS)
		if (name == words.name)
			return words.id;
	return std::nullopt;
}

std::string EffectNames()
{
	std::string list;
	for (const auto& words : EFFECTS)
		list += (list.empty() ? "" : ", ") + std::string(words.name);
	return list;
}

const char* NameOf(Grade grade)
{
	return grade == Grade::GOOD ? "good" : grade == Grade::FAIR ? "fair" : "poor";
}

}
