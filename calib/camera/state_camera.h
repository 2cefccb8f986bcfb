// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The camera of one state (tiltcal/camera.h), from a fit, to and from calibration.json.

#ifndef TILTCAL_STATE_CAMERA_H
#define TILTCAL_STATE_CAMERA_H

#include "model/picture_view.h"
#include <tiltcal/camera.h>

#include <optional>
#include <string>

namespace tiltcal
{

/// Of a picture in a file; more is a mistake.
const int MOST_PIXELS_A_SIDE = 1000000;

/// How it puts directions in its picture.
PictureView PictureViewOf(const StateCamera& camera);

/// What to say of a camera whose distortion has no inverse all over its picture; else empty.
std::string FoldWarning(const StateCamera& camera);

/// What one fit says of a state's camera, without any choice of effects.
StateCamera CameraOfFit(const Task& task, const Solution& solution, const Geometry& geometry, size_t state);

/// The same through the real lens, where that is the file's answer: StateCamera::aberrations. Throws as ReadStateCamera.
std::optional<StateCamera> ReadRealLensCamera(const std::string& file, const std::string& state);

/// Whether the .inc files of that calibration take the real lens unless a scene says otherwise. Throws as ReadStateCamera.
bool TakesRealLens(const std::string& file);

/// A calibration.json with this one state, for ReadStateCamera. An unknown focus and an unknown aperture are null.
std::string StateCameraJson(const StateCamera& camera, const std::string& source);

}

#endif
