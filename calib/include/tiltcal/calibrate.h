// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_CALIBRATE_H
#define TILTCAL_CALIBRATE_H

#include <tiltcal/calibration.h>
#include "measure/detect.h"
#include "effects/effects.h"
#include "solve/joint_fit.h"
#include "measure/measure.h"
#include "base/transfer.h"

#include <string>
#include <utility>
#include <vector>

namespace tiltcal
{

/// Throws UsageError for a --pitch (mm) that no sensor has.
void CheckPitch(double pitch_mm);

struct StateFiles
{
	std::string name;
	std::vector<std::string> files;
};

/// Measures every photograph, with progress on the log. States come out in the order
/// given; the first is the untilted one. Throws Error: unreadable, no board, sizes differ.
Task MeasureAll(const std::vector<StateFiles>& states, const Board& board, double pitch_mm,
	const Transfer& transfer, const DetectOptions& options, const EdgeChoice& choice = {});

/// Measures a photograph of an evenly lit plain surface taken in state `state`. Throws Error: unreadable, of another size, clipped, dark.
void AddFlatField(Task& task, size_t state, const std::string& file, const Transfer& transfer);

/// Whether photograph n shows the board in the same pose in every state.
enum class Poses
{
	AUTO,     ///< shared when the counts agree and the corners do too
	SHARED,
	OWN
};

/// Solves everything. `model` is "plane", "rigid", "curved", "paper", or "auto": curved where CurvatureIsSeen,
/// else plane. The paper's model is always solved
/// too, and only refused when it was the one asked for. Then vignetting and chromatic aberration are estimated, and the
/// effects chosen. Throws Refused.
Calibration Calibrate(const Task& task, const std::string& model, Poses poses, Refinement refinement = Refinement::EDGES,
	const EffectChoice& effects = {});

}

#endif
