// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The table that tiltcost --csv writes.
#pragma once
#include <filesystem>
#include <vector>

struct TiltcostRow
{
	int min = 0, max = 0;
	double variance = 0, confidence = 0.9;
	double error = 0, denoised_error = 0; // RMS; 0 where the denoised one is not known
	double rays = 0, cpu = 0, denoise_cpu = 0; // seconds; denoising comes on top
	double error_sigma = 0, denoised_sigma = 0, time_sigma = 0; // relative; 0: not told
};

// Throws std::runtime_error when the file has no rows or says something else.
std::vector<TiltcostRow> ReadTiltcostTable(const std::filesystem::path& csv);
