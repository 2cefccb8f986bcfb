// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What `denoise` takes on this machine.

#ifndef TILTCOST_DENOISE_COST_H
#define TILTCOST_DENOISE_COST_H

#include "program/temporary_folder.h"

#include <string>

namespace tiltcost
{

/// CPU seconds that `denoise` takes for a pixel of a picture that is `width` pixels wide: `povray` renders an empty one with and without it, a
/// second or so. Not the denoiser alone: POV-Ray also keeps the samples and hands the picture on a second time. Throws tiltcal::Error where it does not render.
double DenoiseSecondsPerPixel(const std::string& povray, int width, const tiltcal::TemporaryFolder& folder);

}

#endif
