// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Whether the lens stood still between the photographs of a state.

#ifndef TILTCAL_CHECK_FOCUS_H
#define TILTCAL_CHECK_FOCUS_H

#include <tiltcal/calibration.h>

namespace tiltcal
{

/// The blur once more, with a plane of focus for every state, the untilted one's free too, and then for every photograph; aperture, geometry and the lens's own blur held. Of an exact model,
/// and of the photographs that do not stand out (CheckPhotographs comes first). Not known where those with enough edges are fewer than three.
FocusCheck CheckFocus(const Calibration& calibration);

}

#endif
