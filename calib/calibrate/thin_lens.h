// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From measured photographs to a thin lens and where it stands.

#ifndef TILTCAL_THIN_LENS_H
#define TILTCAL_THIN_LENS_H

#include <tiltcal/calibrate.h>

#include <optional>
#include <vector>

namespace tiltcal
{

/// A board that was moved between the states shows as a reprojection error of many
/// pixels, or as no answer; the little that the pupil moves when the lens tilts does not double it. `normals`: of the lens, by state.
bool PosesAreShared(const Task& task, const std::vector<Vec3<double>>& normals, const CalibrateOptions& options);

/// Geometry and lens by an exact model, the one that predicts photographs best where none is given, refined together, and what is checked of its photographs. c.task becomes
/// `measured` without what the measuring of straight edges leaves out.
void SolveThinLens(const Task& measured, const std::optional<Model>& model, const CalibrateOptions& options, Calibration& c);

/// The same once more from what the edges would be without the rims that were found, which cut blurs and move edges, and those rims once more by that lens. Returns the
/// task with the edges as they are: a real lens sees them through what rims leave. Nothing is changed where the blur of photographs left out is not predicted better so,
/// there is no answer, or a rim holds back the axis's own light.
Task SolveThroughRims(const Task& measured, const CalibrateOptions& options, Calibration& c);

}

#endif
