// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The lens of a picture as JSON, for programs that show it (tiltcost --page). Free of POV-Ray.
//
// Asked for in the environment: TILT_LENS_WRITE_LENS=FILE. FILE is written when the picture begins.

#ifndef TILT_LENS_LENS_TEXT_H
#define TILT_LENS_LENS_TEXT_H

#include <string>

#include "lens/lens_spec.h"

namespace tilt_lens
{

/// Name of the environment's variable.
const char WriteLensVariable[] = "TILT_LENS_WRITE_LENS";

/// The words of the block that state neither plane nor sensor nor aperture, and are no preview, one a line: what stays when
/// those change.
std::string OtherWords(const LensSpec& spec);

/// One line of JSON, with all digits; its keys are those of calib/plane_page/lens.js. width x height: pixels of the picture.
std::string LensText(const LensSpec& spec, const CameraVectors& camera, const TiltLens& lens, int width, int height);

}

#endif
