// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A page on which the lens of a scene can be tilted.

#ifndef TILTCOST_LENS_PAGE_H
#define TILTCOST_LENS_PAGE_H

#include "tiltcost/pilot_run.h"

#include <string>

namespace tiltcost
{

/// Has POV-Ray parse the scene, ends it when the picture begins, and returns the page (plane_page/plane_page.h). Throws tiltcal::Error
/// where the scene does not render or its camera is no tilt_lens, and Interrupted.
std::string LensPage(const Job& job, const tiltcal::TemporaryFolder& folder);

}

#endif
