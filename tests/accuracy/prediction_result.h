// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A prediction of tiltcost's beside what the render was, the bounds it is held to, and the table of many.
#pragma once
#include "support/tiltcost_table.h"

#include <filesystem>
#include <string>
#include <vector>

/// Times are CPU seconds of one picture.
struct Result
{
	std::string scene;
	TiltcostRow predicted;
	double share = 0;
	double error = 0, uncertain = 0, rays = 0, cpu = 0;   ///< as rendered; `uncertain`: one standard deviation of `error`, relative
	double denoised = 0, denoised_uncertain = 0;          ///< errors of the same with denoise, where they are predicted
	double denoised_cpu = 0;

	double ErrorOff() const { return predicted.error / error - 1; }
	double RaysOff() const { return predicted.rays / rays - 1; }
	double TimeOff() const { return predicted.cpu / cpu - 1; }
	double DenoisedOff() const { return denoised > 0 ? predicted.denoised_error / denoised - 1 : 0; }
	/// Of both together: what denoising takes is a few seconds of many.
	double DenoisedTimeOff() const { return denoised > 0 ? (predicted.cpu + predicted.denoise_cpu) / denoised_cpu - 1 : 0; }
	double ErrorLimit() const;
	double DenoisedLimit() const;
	double TimeLimit() const;
	/// Of errors always; of times where they are judged, for elsewhere they are the machine's.
	bool SigmasPromise(bool judge_time) const;
	/// Time is rays times what one takes: the bound of the product holds for the factor that is the machine's no affair.
	bool Good(bool judge_time) const;
};

/// How it was rendered.
struct Rendering
{
	int width = 0, height = 0;
	bool judge_time = false;
};

/// A line for the terminal, marked where it is out of bounds.
std::string Line(const Result& result, bool judge_time);

/// Writes tiltcost.csv and tiltcost.html, a fragment for the report, into `folder`.
void WritePredictions(const std::filesystem::path& folder, const std::vector<Result>& results, const Rendering& rendering);
