// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Which settings are worth having: the cheapest for an error, the best for a time.

#ifndef TILTCOST_SEARCH_H
#define TILTCOST_SEARCH_H

#include "tiltcost/prediction.h"

#include <functional>
#include <optional>
#include <vector>

namespace tiltcost
{

/// What the whole picture costs besides its samples, and on how many threads.
struct Machine
{
	double pixels = 0;              ///< of the picture, or of the part that is rendered
	double start_cpu = 0;           ///< seconds before and beside tracing: parsing, photons, output
	double start_wall = 0;
	int threads = 1;
	double rays_per_sample = 1;         ///< three with wavelengths apart, less where rims stop some
	int rows = 0;                       ///< that are rendered of a picture; 0: not known, and taken to be many
	double denoise_pixel = 0;           ///< CPU seconds that denoise takes for one
};

/// One standard deviation of a row's errors and of its time, relative, that come from tracing
/// some blocks instead of all: jackknife over ten groups of blocks. 0: not known.
struct Spread
{
	double error = 0, denoised = 0, seconds = 0;
};

/// A row of the table.
struct Row
{
	Setting setting;
	Prediction predicted;
	double rays_per_pixel = 0, rays = 0;    ///< through the lens
	double cpu = 0, wall = 0;       ///< of the whole picture, seconds
	double denoised_error = 0;      ///< RMS, with denoise; 0: not asked for
	Spread spread;
};

Row MakeRow(const Pilot& pilot, const Machine& machine, const Setting& setting);

/// All settings that are tried, the cheapest first. MIN 1 to 32, MAX 16 to 8192, variance in half decades, and fixed
/// numbers of samples, all with this `confidence`. `progress`, where given, is called with the share that is done, by the caller's thread alone: as many work as there are processors.
std::vector<Row> AllRows(const Pilot& pilot, const Machine& machine, double confidence = DefaultConfidence, const std::function<void(double)>& progress = {});

/// Those of them that no other one beats in both error and time, the coarsest first.
std::vector<Row> BestRows(const std::vector<Row>& all);

/// A figure that is bounded: error, levels or time.
typedef std::function<double(const Row&)> Figure;

/// Seconds by the clock that denoising the whole picture adds: threads share it by bands of rows.
double DenoiseWallSeconds(const Machine& machine);

/// The same row with denoise: its error, and its time with what denoising takes.
Row WithDenoise(const Pilot& pilot, const Machine& machine, Row row);

/// Cheapest of the rows that with denoise reaches `error`, denoised.
std::optional<Row> CheapestDenoised(const Pilot& pilot, const Machine& machine, const std::vector<Row>& best, double error);

/// Cheapest row whose `figure` is at most `bound`. `best` as of BestRows.
std::optional<Row> CheapestBelow(const std::vector<Row>& best, const Figure& figure, double bound);

/// Row with the least error among those within `seconds` of wall time. `best` as of BestRows.
std::optional<Row> BestWithin(const std::vector<Row>& best, double seconds);

/// The same with denoise, whose time counts, among all settings that the pilot has samples for. What gives most without is often not what
/// gives most with it: denoise takes the grain that adaptive samples are spent on.
std::optional<Row> BestDenoisedWithin(const Pilot& pilot, const Machine& machine, const std::vector<Row>& all, double seconds);

/// The rows of the table: of errors about 0.03 (or the coarsest), 0.02, 0.013, ... those that
/// give most for their time; at most `count` of them and at least one.
std::vector<Row> TableRows(const std::vector<Row>& best, int count);

/// Index of the first row below `levels` (of 255): where it stops paying. rows.size() for none.
size_t StopsPaying(const std::vector<Row>& rows, double levels);

const int SpreadParts = 10, LeastBlocksForSpread = 2 * SpreadParts;

/// Of a setting; with denoise where its errors without each of SpreadParts parts are given (Pilot::PredictDenoised). Nothing where the pilot has too few blocks to tell.
Spread SpreadOf(const Pilot& pilot, const Machine& machine, const Setting& setting, const std::vector<double>& denoised = {});

}

#endif
