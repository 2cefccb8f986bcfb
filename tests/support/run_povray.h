// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Runs POV-Ray on a scene in a folder, without display and without its chatter.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

// The picture goes to an OpenEXR file beside the scene. Throws std::runtime_error with POV-Ray's last lines on failure,
// and when the program is missing. One thread: ctest runs two tests at a time.
void RunPovray(const std::string& program, const std::filesystem::path& folder, const std::string& scene,
	const std::string& picture, int width, int height, const std::vector<std::string>& more = {});
