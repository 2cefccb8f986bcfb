// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tables 1 and 2, the lens, the closed loop's numbers, the effects: gathered from tiltcal's JSON files.

#ifndef PAPER_TABLES_H
#define PAPER_TABLES_H

#include "paper_run.h"

#include <nlohmann/json.hpp>

#include <string>

namespace paper
{

using Json = nlohmann::ordered_json;

/// Throws tiltcal::Error that names the file.
Json ReadJson(const std::string& file);

/// True tilt and that of every method: { true: {STATE: deg}, methods: [{ name, states: {STATE: {deg, sigma}} }] }, the paper's own result first.
Json TiltTable(const Run& run);

/// w, d, U, f of the paper's lens, of the models paper and curved here, nominal, and of the prescription where photos/truth.json is there.
Json LensTable(const Run& run);

/// Mean brightness error on both lines, with gain and shading, the paper's own beside it.
Json BrightnessTable(const Run& run);

/// The same with fewer effects, and through the camera of the paper's method.
Json EffectTable(const Run& run);

/// What the closed loop found of the camera that it started from.
Json ClosedLoopTable(const Run& run);

/// What tiltcal says of pupils, rims and the two curvatures.
Json PupilTable(const Run& run);

}

#endif
