// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/rows.h"

#include "lens/adaptive.h"
#include "lens/denoise.h"
#include "tiltcost/search.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace tiltcost
{

namespace
{

/// Cost of a pixel at (x, y). A block's own centre costs what the block did.
double Between(const std::vector<BlockCost>& blocks, double x, double y)
{
	constexpr size_t Nearest = 4;
	double distance[Nearest], cost[Nearest];
	std::fill(distance, distance + Nearest, std::numeric_limits<double>::infinity());
	std::fill(cost, cost + Nearest, 0.0);
	for (const BlockCost& block : blocks)
	{
		double d = (block.x - x) * (block.x - x) + (block.y - y) * (block.y - y), c = block.seconds_per_pixel;
		for (size_t i = 0; i < Nearest; ++i)
			if (d < distance[i])
			{
				std::swap(d, distance[i]);
				std::swap(c, cost[i]);
			}
	}
	double sum = 0, weights = 0;
	for (size_t i = 0; i < Nearest && distance[i] < std::numeric_limits<double>::infinity(); ++i)
	{
		const double weight = 1 / (distance[i] + 1);
		sum += weight * cost[i];
		weights += weight;
	}
	return weights > 0 ? sum / weights : 0;
}

}

std::vector<double> RowSeconds(const std::vector<BlockCost>& blocks, int width, int height)
{
	// Finer than every half block nothing is known.
	const int step = tilt_lens::PilotBlockSize / 2;
	std::vector<double> rows(size_t(height), 0.0);
	for (int y = 0; y < height; y += step)
	{
		const int high = std::min(step, height - y);
		double seconds = 0;
		for (int x = 0; x < width; x += step)
		{
			const int wide = std::min(step, width - x);
			seconds += wide * Between(blocks, x + 0.5 * wide, y + 0.5 * high);
		}
		std::fill(rows.begin() + y, rows.begin() + y + high, seconds);
	}
	return rows;
}

std::string RowsText(const PilotRun& run, const Pilot& pilot, const Setting& setting)
{
	std::vector<double> rows = RowSeconds(pilot.BlockCosts(setting), run.log.width, run.log.height);
	const std::vector<tilt_lens::SampleLevel> levels = tilt_lens::SampleLevels(setting.min, setting.max, setting.variance, setting.confidence, &Chi2);
	int margin = levels.size() > 1 ? tilt_lens::NeighbourReach : 0;
	if (margin > 0 && levels.front().samples < tilt_lens::LeastOwnVariance)
		margin++;                       // for the first samples that theirs are compared with
	if (setting.denoise)
	{
		margin += tilt_lens::DenoiseReach;
		for (double& row : rows)
			row += run.machine.denoise_pixel * run.log.width;
	}
	const nlohmann::json json = {{"width", run.log.width}, {"height", run.log.height}, {"margin_rows", margin},
		{"start_cpu_s", run.machine.start_cpu}, {"start_wall_s", run.machine.start_wall}, {"pilot_wall_s", run.wall},
		{"setting", SceneText(setting)}, {"radiosity", run.log.radiosity}, {"photons", run.log.photons}, {"row_s", rows}};
	return json.dump() + "\n";
}

}
