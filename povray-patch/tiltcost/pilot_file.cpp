// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/pilot_file.h"

#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <sstream>
#include <tuple>
#include <utility>

namespace tiltcost
{

namespace
{

using tilt_lens::PilotLevel;

/// One pixel's line; empty when it is not one.
std::vector<PilotLevel> ParsePixel(const std::string& line)
{
	std::vector<PilotLevel> levels;
	const char* at = line.c_str();
	char* end = nullptr;
	for (int n = 1; *at; n *= 2)
	{
		PilotLevel level{};
		level.samples = int(std::strtol(at, &end, 10));
		if (end == at || level.samples != n)
			return {};
		for (double* value : {&level.mean[0], &level.mean[1], &level.mean[2], &level.mean[3], &level.mean[4], &level.variance})
		{
			at = end;
			*value = std::strtod(at, &end);
			if (end == at)
				return {};
		}
		levels.push_back(level);
		at = end;
	}
	return levels;
}

}

std::vector<PilotBlock> ParsePilot(const std::string& text)
{
	std::vector<PilotBlock> blocks;
	std::set<std::pair<int, int>> seen;
	std::istringstream in(text);
	std::string line, word;
	while (std::getline(in, line))
	{
		PilotBlock block;
		std::istringstream words(line);
		if (!(words >> word >> block.left >> block.top >> block.width >> block.height >> block.seconds >> block.first_seconds) ||
			word != "block" || block.width < 1 || block.height < 1)
			throw tiltcal::Refused(fmt::format("the pilot render wrote '{:.40}' where a block should begin; do tiltcost and povray belong together?", line));
		tilt_lens::PilotSetting own{};
		if (words >> own.min >> own.max >> own.variance >> own.confidence >> own.denoise)
			block.own = own;
		if (!seen.insert({block.left, block.top}).second)
			throw tiltcal::Refused("more than one frame was rendered; say --frames 5 for the film, or choose one of them with +SFn +EFn");
		while (int(block.pixels.size()) < block.width * block.height && std::getline(in, line))
			block.pixels.push_back(ParsePixel(line));
		// The file may end within a block or a line: the pilot was stopped.
		const bool whole = int(block.pixels.size()) == block.width * block.height && !in.eof();
		if (!whole)
			break;
		const size_t levels = blocks.empty() ? block.pixels[0].size() : blocks[0].pixels[0].size();
		for (const auto& pixel : block.pixels)
			if (pixel.empty() || pixel.size() != levels)
				throw tiltcal::Refused("the pilot render wrote pixels that cannot be read; do tiltcost and povray belong together?");
		blocks.push_back(std::move(block));
	}
	return blocks;
}

void SortByPlace(std::vector<PilotBlock>& blocks)
{
	std::sort(blocks.begin(), blocks.end(), [](const PilotBlock& a, const PilotBlock& b) { return std::tie(a.top, a.left) < std::tie(b.top, b.left); });
}

void ThinOut(size_t count, std::vector<PilotBlock>& blocks)
{
	SortByPlace(blocks);
	const size_t all = blocks.size();
	if (count >= all)
		return;
	std::vector<PilotBlock> kept;
	for (size_t k = 0; k < count; ++k)
		kept.push_back(std::move(blocks[(2 * k + 1) * all / (2 * count)]));
	blocks = std::move(kept);
}

double TraceSeconds(const std::vector<PilotBlock>& blocks)
{
	double seconds = 0;
	for (const PilotBlock& block : blocks)
		seconds += block.seconds;
	return seconds;
}

}
