// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Scenes whose camera block is random: most of the words make sense, most of the time.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

struct Block
{
	std::string scene;                  // the text of the scene file
	std::vector<std::string> options;   // for POV-Ray's command line
};

// Block number `index` of a seed, whatever was asked for before. Everything but the camera has a radiance below 1, so
// that no camera can make a pixel that is not finite; blur_samples stays below 4097, so that no render is long.
Block CameraBlock(std::uint64_t seed, std::uint64_t index);
