// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "lens/pilot.h"

namespace tilt_lens
{

PilotRequest ParsePilotRequest(const char *text)
{
	PilotRequest request;
	int at = 0;

	if((text != nullptr) && (std::sscanf(text, "%d,%d,%lf,%n", &request.blocks, &request.samples, &request.seconds, &at) == 3) && (at > 0) &&
	   (request.blocks > 0) && (request.samples > 0) && ((request.samples & (request.samples - 1)) == 0) && (request.seconds > 0.0) && (text[at] != '\0'))
		request.file = text + at;
	else
		request.blocks = 0;
	return request;
}

PilotRequest PilotOfEnvironment()
{
	PilotRequest request = ParsePilotRequest(std::getenv(PilotVariable));
	const char *const chosen = std::getenv(PilotBlocksVariable);

	if(chosen != nullptr)
		request.chosen = chosen;
	return request;
}

bool PilotIsOn()
{
	return bool(PilotOfEnvironment());
}

bool PilotMayWrite()
{
	return std::getenv(PilotWritesVariable) != nullptr;
}

std::vector<int> PilotBlocks(const PilotRequest& request, int width, int height)
{
	return PilotBlocks(request, width, height, 0, 0, width - 1, height - 1);
}

std::vector<int> PilotBlocks(const PilotRequest& request, int width, int height, int left, int top, int right, int bottom)
{
	const int across = (width + PilotBlockSize - 1) / PilotBlockSize;
	const auto first = [](int from, int to) { return std::min((from + PilotBlockSize - 1) / PilotBlockSize, to / PilotBlockSize); };
	const int first_column = first(left, right), first_row = first(top, bottom);
	const int columns = right / PilotBlockSize - first_column + 1, rows = bottom / PilotBlockSize - first_row + 1;
	const int all = (width > 0) && (height > 0) ? columns * rows : 0;
	std::vector<int> blocks;
	std::vector<bool> chosen(size_t(all), false);
	const auto choose = [&](int column, int row)
	{
		const size_t block = size_t(row * columns + column);
		if(!chosen[block])
			blocks.push_back((first_row + row) * across + first_column + column);
		chosen[block] = true;
	};

	if(!request.chosen.empty())
	{
		std::ifstream file(request.chosen.c_str());
		for(int block; (all > 0) && (file >> block);)
		{
			const int column = block % across - first_column, row = block / across - first_row;
			if((block >= 0) && (column >= 0) && (column < columns) && (row >= 0) && (row < rows))
				choose(column, row);
		}
		return blocks;
	}
	// Steps of 1/p and 1/p^2, p^3 = p + 1.
	for(int i = 0; (i < request.blocks) && (blocks.size() < size_t(all)); i++)
	{
		const double x = std::fmod(0.5 + i * 0.7548776662466927, 1.0), y = std::fmod(0.5 + i * 0.5698402909980532, 1.0);
		choose(int(x * columns), int(y * rows));
	}
	for(int block = 0; (request.blocks >= all) && (block < all); block++)
		choose(block % columns, block / columns);
	return blocks;
}

std::string PilotText(int left, int top, int width, int height, double seconds, double first_seconds, const PilotSetting& setting, const std::vector<std::vector<PilotLevel> >& pixels)
{
	char number[160];
	std::string text;

	std::snprintf(number, sizeof(number), "block %d %d %d %d %.6g %.6g %d %d %.9g %.9g %d\n", left, top, width, height, seconds, first_seconds,
		setting.min, setting.max, setting.variance, setting.confidence, int(setting.denoise));
	text += number;
	for(size_t i = 0; i < pixels.size(); i++)
	{
		for(size_t k = 0; k < pixels[i].size(); k++)
		{
			const PilotLevel& l = pixels[i][k];
			std::snprintf(number, sizeof(number), "%s%d %.9g %.9g %.9g %.9g %.9g %.9g", k > 0 ? " " : "", l.samples, l.mean[0], l.mean[1], l.mean[2], l.mean[3], l.mean[4], l.variance);
			text += number;
		}
		text += "\n";
	}
	return text;
}

double ScoutedChange(const std::vector<double>& rgb, int columns, int rows)
{
	double sum = 0.0;
	int pairs = 0;
	const auto differ = [&](int a, int b)
	{
		for(int c = 0; c < 3; c++)
		{
			const double from = rgb[size_t(3 * a + c)], to = rgb[size_t(3 * b + c)];
			const double change = std::min(ScoutWhite, std::max(0.0, from)) - std::min(ScoutWhite, std::max(0.0, to));
			sum += change * change / 3.0;
		}
		pairs++;
	};

	for(int i = 0; i < columns * rows; i++)
	{
		if(i % columns + 1 < columns)
			differ(i, i + 1);
		if(i / columns + 1 < rows)
			differ(i, i + columns);
	}
	return pairs > 0 ? sum / pairs : 0.0;
}

std::string ScoutText(int left, int top, double seconds, int samples, double change)
{
	char text[120];

	std::snprintf(text, sizeof(text), "scout %d %d %.6g %d %.9g\n", left, top, seconds, samples, change);
	return text;
}

}
