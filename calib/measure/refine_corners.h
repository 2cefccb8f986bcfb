// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REFINE_CORNERS_H
#define TILTCAL_REFINE_CORNERS_H

#include <tiltcal/photo.h>

namespace tiltcal
{

/// Puts every corner where the lines of its edges meet (the paper's features), least squares with their own uncertainties.
/// Corners that no edges refine stay where they are, less sure the more the picture is blurred.
void RefineCorners(Photo& photo);

}

#endif
