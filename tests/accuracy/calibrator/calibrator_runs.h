// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What calibrator_cost calibrates: photographs, measured once and cached, or an ideal lens.

#ifndef CALIBRATOR_RUNS_H
#define CALIBRATOR_RUNS_H

#include <tiltcal/calibration.h>

#include <memory>
#include <string>
#include <vector>

namespace calibrator_cost
{

/// One setting of effort: what a user can choose.
struct Effort
{
	int photos = 0;   ///< per state
	int edges = 0;    ///< per photograph; 0: all
};

/// CPU seconds of the steps before the solving, summed over the photographs used.
struct Preparation
{
	double detection = 0, measuring = 0;
};

/// Features of the states untilted, plus5 (5 degrees towards 0) and minus5.
class Source
{
public:
	virtual ~Source() = default;
	/// Photographs there are per state.
	virtual int Photos() const = 0;
	/// Different draws of that effort that there are to take.
	virtual int Draws(const Effort& effort, int wanted) const = 0;
	/// The features of draw k of `draws`, another choice of photographs (`effort.photos` of Photos()) or
	/// of edges, or other noise. Throws tiltcal::Error.
	virtual tiltcal::Task Draw(const Effort& effort, int k, int draws, Preparation& preparation) = 0;
	/// The share of everything there is that a draw uses; 0 when draws are independent.
	virtual double ShareUsed(const Effort& effort) const = 0;
	/// Draws that exist; 0: without end.
	virtual double DrawsExisting(const Effort& effort) const = 0;
};

/// FOLDER/untilted-*.png (or .jpg), plus5-*, minus5-*: boards of 12x9 squares of 25 mm, pitch 0.02 mm.
/// Reads, detects and measures everything once. Throws tiltcal::Error.
std::unique_ptr<Source> Photographs(const std::string& folder);

/// A thin lens without aberrations and 0.06 px of noise per edge (0.03 per corner), by rays
/// (tests/support/synthetic_lens.h), six poses.
std::unique_ptr<Source> ThinLens();

/// Draw k of `draws` choices of `chosen` out of n, spread evenly over all choices.
std::vector<int> Choice(int n, int chosen, int k, int draws);

/// Binomial coefficient.
double Choices(int n, int chosen);

/// CPU seconds of this process so far.
double CpuSeconds();

}

#endif
