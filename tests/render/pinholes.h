// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The true picture of an ideal lens as the mean of pinhole pictures from a stock POV-Ray.
//
// Seen through one lens point S the picture is an ordinary perspective picture: the pinhole at S, with direction, right
// and up each multiplied by M = I - S q^T, where q.P = 1 is the plane of focus. The mean over the lens is the true
// picture, for any plane, without a blur formula. q, S and M are computed here; no code and no random numbers are
// shared with the camera under test.
#pragma once
#include "oracle_cases.h"
#include "support/picture.h"

#include <filesystem>

constexpr int WIDTH = 160, HEIGHT = 120;
constexpr double ASPECT = double(WIDTH) / HEIGHT;

struct Lens
{
	Vector q; // inverse focus
	Vector n; // lens normal
};

// Camera frame: x right, y up, z along the axis, left-handed. Colour 0 red, 1 green, which stands for all, 2 blue.
Lens LensOf(const Camera& camera, int colour = 1);

// A point of the camera frame, in the world. Without the camera's `moves`.
Vector InWorld(const Camera& camera, const Vector& point);

// The camera's scene, and its block in the scene language.
std::string SceneWithTiltLens(const Camera& camera, const std::filesystem::path& scene, int samples);

// 1: every ray of the pixel is in front of the lens plane, -1: none is, 0: some are.
int Seen(const Camera& camera, int x, int y);

// Runs in folders of its own below `work`. `standard_error` receives the RMS error that the mean may have itself.
Picture MeanOfPinholes(const Camera& camera, const std::filesystem::path& scene, const std::filesystem::path& work,
	const std::string& stock, int frames, double& standard_error);
