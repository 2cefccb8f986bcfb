// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/search.h"

#include "lens/denoise.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <thread>

namespace tiltcost
{

Row MakeRow(const Pilot& pilot, const Machine& machine, const Setting& setting)
{
	Row row;
	row.setting = setting;
	row.predicted = pilot.Predict(setting);
	const double trace = row.predicted.seconds_per_pixel * machine.pixels;
	row.rays_per_pixel = row.predicted.samples_per_pixel * machine.rays_per_sample;
	row.rays = row.rays_per_pixel * machine.pixels;
	row.cpu = machine.start_cpu + trace;
	row.wall = machine.start_wall + trace / machine.threads;
	return row;
}

namespace
{

std::vector<Setting> Grid(double confidence)
{
	const int least_min = 1, greatest_min = 32, least_max = 16, greatest_max = 8192;
	std::vector<Setting> grid;
	for (int max = least_max / 4; max <= greatest_max; max *= 2)
	{
		Setting setting;
		setting.max = max;
		setting.variance = 0;
		setting.confidence = confidence;
		grid.push_back(setting);
		if (max < least_max)
			continue;
		for (setting.min = least_min; setting.min <= std::min(greatest_min, max / 2); setting.min *= 2)
			for (const double variance : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 3e-8})
			{
				setting.variance = variance;
				grid.push_back(setting);
			}
	}
	return grid;
}

}

std::vector<Row> AllRows(const Pilot& pilot, const Machine& machine, double confidence, const std::function<void(double)>& progress)
{
	const std::vector<Setting> grid = Grid(confidence);
	std::vector<Row> all(grid.size());
	std::atomic<size_t> next{0};
	const auto work = [&](const std::function<void(double)>& say)
	{
		for (size_t i; (i = next++) < grid.size();)
		{
			all[i] = MakeRow(pilot, machine, grid[i]);
			if (say)
				say(double(i + 1) / double(grid.size()));
		}
	};
	std::vector<std::future<void>> helpers;
	for (unsigned k = 1; k < std::thread::hardware_concurrency(); ++k)
		helpers.push_back(std::async(std::launch::async, work, nullptr));
	try
	{
		work(progress);
	}
	catch (...)   // an interrupt: they are not to finish the rest
	{
		next = grid.size();
		throw;
	}
	for (std::future<void>& helper : helpers)
		helper.get();
	// Of equals the one with the larger minimum: it relies least on few samples.
	std::stable_sort(all.begin(), all.end(), [](const Row& a, const Row& b)
	{
		if (a.cpu != b.cpu)
			return a.cpu < b.cpu;
		if (a.predicted.error != b.predicted.error)
			return a.predicted.error < b.predicted.error;
		return a.setting.min > b.setting.min;
	});
	return all;
}

std::vector<Row> BestRows(const std::vector<Row>& all)
{
	std::vector<Row> best;
	for (const Row& row : all)
		if (best.empty() || row.predicted.error < best.back().predicted.error)
			best.push_back(row);
	return best;
}

double DenoiseWallSeconds(const Machine& machine)
{
	const int threads = std::min(machine.threads, tilt_lens::DenoiseThreads);
	double longest = 1.0 / threads;     // share of the work that the busiest of them has
	if (machine.rows > 0)
	{
		const int bands = (machine.rows + tilt_lens::DenoiseBand - 1) / tilt_lens::DenoiseBand;
		longest = double((bands + threads - 1) / threads) / bands;
	}
	return machine.denoise_pixel * machine.pixels * longest;
}

Row WithDenoise(const Pilot& pilot, const Machine& machine, Row row)
{
	row.setting.denoise = true;
	row.denoised_error = pilot.PredictDenoised(row.setting);
	row.cpu += machine.denoise_pixel * machine.pixels;
	row.wall += DenoiseWallSeconds(machine);
	return row;
}

namespace
{

/// Whether every pixel gets at least as many samples by `a` as by `b`, wherever its own samples would end it.
bool AsksForMore(const Setting& a, const Setting& b)
{
	const auto least = [](const Setting& s) { return s.variance > 0 ? s.min : s.max; };
	return a.max >= b.max && a.variance <= b.variance && least(a) >= least(b) && (a.max > b.max || a.variance < b.variance || least(a) > least(b));
}

}

std::optional<Row> BestDenoisedWithin(const Pilot& pilot, const Machine& machine, const std::vector<Row>& all, double seconds)
{
	std::vector<Row> within;
	for (const Row& row : all)
		if (row.setting.max <= pilot.Samples() && row.wall + DenoiseWallSeconds(machine) <= seconds)
			within.push_back(row);
	std::optional<Row> found;
	for (const Row& row : within)
	{
		// Denoising the pilot is slow: what another one within the time has more samples than everywhere is not looked at.
		if (std::any_of(within.begin(), within.end(), [&](const Row& other) { return AsksForMore(other.setting, row.setting); }))
			continue;
		const Row denoised = WithDenoise(pilot, machine, row);
		if (!found || denoised.denoised_error < found->denoised_error)
			found = denoised;
	}
	return found;
}

std::optional<Row> CheapestDenoised(const Pilot& pilot, const Machine& machine, const std::vector<Row>& best, double error)
{
	for (const Row& row : best)
		if (row.setting.max <= pilot.Samples())
			if (const Row denoised = WithDenoise(pilot, machine, row); denoised.denoised_error <= error)
				return denoised;
	return {};
}

std::optional<Row> CheapestBelow(const std::vector<Row>& best, const Figure& figure, double bound)
{
	for (const Row& row : best)
		if (figure(row) <= bound)
			return row;
	return {};
}

std::optional<Row> BestWithin(const std::vector<Row>& best, double seconds)
{
	std::optional<Row> found;
	for (const Row& row : best)
		if (row.wall <= seconds)
			found = row;
	return found;
}

std::vector<Row> TableRows(const std::vector<Row>& best, int count)
{
	const double coarsest = 0.03, step = 1.5, closest = 1.2, finest = 1e-6;
	// Time grows about so steeply as errors fall. What is best by it lies at the foot of a
	// step (a MAX is exhausted, the next is not begun) and not on top.
	const double steepness = 1.5;
	const auto worth = [&](const Row& row) { return std::log(row.wall) + steepness * std::log(row.predicted.error); };
	std::vector<Row> rows;
	double wanted = std::min(coarsest, best.front().predicted.error);
	for (; int(rows.size()) < count && wanted > finest; wanted /= step)
	{
		const Row* chosen = nullptr;
		for (const Row& row : best)
			if (row.predicted.error <= wanted * std::sqrt(step) && row.predicted.error > wanted / std::sqrt(step) && (!chosen || worth(row) < worth(*chosen)))
				chosen = &row;
		if (!chosen)
			continue;
		// Two that are hardly apart count as one.
		if (!rows.empty() && chosen->predicted.error * closest > rows.back().predicted.error)
		{
			if (worth(*chosen) < worth(rows.back()))
				rows.back() = *chosen;
			continue;
		}
		rows.push_back(*chosen);
	}
	if (rows.empty())
		rows.push_back(best.front());
	return rows;
}

size_t StopsPaying(const std::vector<Row>& rows, double levels)
{
	size_t i = 0;
	while (i < rows.size() && rows[i].predicted.Levels() > levels)
		++i;
	return i;
}

Spread SpreadOf(const Pilot& pilot, const Machine& machine, const Setting& setting, const std::vector<double>& denoised)
{
	const int parts = SpreadParts;
	if (pilot.Blocks() < LeastBlocksForSpread)
		return {};
	std::vector<double> errors, seconds;
	for (int part = 0; part < parts; ++part)
	{
		const Prediction p = pilot.Predict(setting, part, parts);
		errors.push_back(p.error);
		seconds.push_back(machine.start_cpu + p.seconds_per_pixel * machine.pixels);
	}
	const auto relative = [&](const std::vector<double>& of)
	{
		double mean = 0, squares = 0;
		for (const double x : of)
			mean += x / parts;
		for (const double x : of)
			squares += (x - mean) * (x - mean);
		return mean > 0 ? std::sqrt(squares * (parts - 1) / parts) / mean : 0;
	};
	// Blocks that are traced are not uncertain.
	const double untraced = std::sqrt(std::max(0.0, 1 - pilot.Pixels() / machine.pixels));
	return {relative(errors) * untraced, relative(denoised) * untraced, relative(seconds) * untraced};
}

}
