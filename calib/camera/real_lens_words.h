// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_REAL_LENS_WORDS_H
#define TILTCAL_REAL_LENS_WORDS_H

#include "lens/aberrations.h"

#include <tiltcal/camera.h>

#include <string>

namespace tiltcal
{

/// How many of its numbers it needs: ThirdOrderTerms, or all where one of the fifth order is not 0.
int TermsOf(const tilt_lens::RealLens<double>& lens);

/// The words `pupil_magnification` and `aberrations` of the tilt_lens block, indented by two tabs. `terms`: ThirdOrderTerms or all.
std::string RealLensWords(const tilt_lens::RealLens<double>& lens, int terms);

/// Its lengths in units of `unit_mm`.
tilt_lens::RealLens<double> RealLensOf(const CameraAberrations& aberrations, double unit_mm = 1);

}

#endif
