// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/block_choice.h"

#include <tiltcal/error.h>
#include "lens/pilot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace tiltcost
{

namespace
{

/// A block's neighbours say what its few samples missed: lamps far out of focus.
const double OwnShare = 0.75;

/// A block's squared error grows less than the squared differences in it: much of them is texture.
const double WorthExponent = 0.75;

/// This share of the blocks is chosen as if nothing were known, so that none counts for more than twice an equal share.
const double BlindShare = 0.5;

/// Place on the curve of Morton's order: bits of column and row by turns.
unsigned long long Place(const ScoutedBlock& block)
{
	unsigned long long place = 0;
	const unsigned column = unsigned(block.left / tilt_lens::PilotBlockSize), row = unsigned(block.top / tilt_lens::PilotBlockSize);
	for (int bit = 0; bit < 32; ++bit)
		place |= (unsigned long long)(column >> bit & 1) << 2 * bit | (unsigned long long)(row >> bit & 1) << (2 * bit + 1);
	return place;
}

bool Before(const ScoutedBlock& a, const ScoutedBlock& b) { return Place(a) < Place(b); }

/// 0 .. count - 1, each part of which is spread over all: their bits in reverse.
std::vector<size_t> Spread(size_t count)
{
	int bits = 0;
	while ((size_t(1) << bits) < count)
		++bits;
	std::vector<size_t> order;
	for (size_t i = 0; i < size_t(1) << bits; ++i)
	{
		size_t reversed = 0;
		for (int bit = 0; bit < bits; ++bit)
			reversed |= (i >> bit & 1) << (bits - 1 - bit);
		if (reversed < count)
			order.push_back(reversed);
	}
	return order;
}

}

std::vector<ScoutedBlock> ParseScouted(const std::string& text)
{
	std::vector<ScoutedBlock> blocks;
	std::istringstream in(text);
	std::string line, word;
	while (std::getline(in, line) && !in.eof())    // a last line that was cut off
	{
		ScoutedBlock block;
		std::istringstream words(line);
		if (!(words >> word >> block.left >> block.top >> block.seconds >> block.samples >> block.change) || word != "scout" || block.samples < 1)
			throw tiltcal::Refused(fmt::format("the first pilot wrote '{:.40}' where a block should be; do tiltcost and povray belong together?", line));
		blocks.push_back(block);
	}
	return blocks;
}

double TraceSeconds(const std::vector<ScoutedBlock>& blocks)
{
	double seconds = 0;
	for (const ScoutedBlock& block : blocks)
		seconds += block.seconds;
	return seconds;
}

double SecondsPerSample(const std::vector<ScoutedBlock>& blocks)
{
	double samples = 0;
	for (const ScoutedBlock& block : blocks)
		samples += block.samples;
	return samples > 0 ? TraceSeconds(blocks) / samples : 0;
}

BlockChoice::BlockChoice(const std::vector<ScoutedBlock>& blocks) : scouted(blocks)
{
	std::sort(scouted.begin(), scouted.end(), Before);
	for (const ScoutedBlock& block : scouted)
	{
		double around = 0;
		int neighbours = 0;
		for (int k = 0; k < 9; ++k)
		{
			const size_t i = IndexOf(block.left + (k % 3 - 1) * tilt_lens::PilotBlockSize, block.top + (k / 3 - 1) * tilt_lens::PilotBlockSize);
			if (k != 4 && i < scouted.size())
			{
				around += scouted[i].change;
				++neighbours;
			}
		}
		const double change = neighbours > 0 ? OwnShare * block.change + (1 - OwnShare) * around / neighbours : block.change;
		worths.push_back(std::pow(change, WorthExponent));
	}
}

/// scouted.size() where it was not looked at.
size_t BlockChoice::IndexOf(int left, int top) const
{
	if (left < 0 || top < 0)
		return scouted.size();
	ScoutedBlock wanted;
	wanted.left = left;
	wanted.top = top;
	const auto found = std::lower_bound(scouted.begin(), scouted.end(), wanted, Before);
	return found != scouted.end() && found->left == left && found->top == top ? size_t(found - scouted.begin()) : scouted.size();
}

double BlockChoice::Worth() const
{
	return std::accumulate(worths.begin(), worths.end(), 0.0);
}

double BlockChoice::WorthOf(int left, int top) const
{
	const size_t i = IndexOf(left, top);
	return i < worths.size() ? worths[i] : 0;
}

/// In proportion to what blocks are worth and to a share that all have, at most 1; they add up to `count` or to all.
std::vector<double> BlockChoice::Chances(size_t count) const
{
	const double all = double(scouted.size()), worth = Worth();
	std::vector<double> size, chances;
	for (const double w : worths)
		size.push_back(worth > 0 ? BlindShare / all + (1 - BlindShare) * w / worth : 1 / all);
	if (count >= scouted.size())
		return std::vector<double>(scouted.size(), 1.0);
	// Those that are sure leave the others the more.
	double factor = double(count);
	for (size_t sure = 0, before = 1; sure != before;)
	{
		before = sure;
		sure = 0;
		double rest = 0;
		for (const double s : size)
			if (factor * s >= 1)
				++sure;
			else
				rest += s;
		factor = rest > 0 ? (double(count) - double(sure)) / rest : factor;
	}
	for (const double s : size)
		chances.push_back(std::min(1.0, factor * s));
	return chances;
}

std::optional<double> BlockChoice::ChanceOf(int left, int top, size_t count) const
{
	const size_t i = IndexOf(left, top);
	if (i == scouted.size())
		return {};
	return Chances(count)[i];
}

std::vector<int> BlockChoice::Choose(size_t count, int columns) const
{
	count = std::min(count, scouted.size());
	const std::vector<double> chances = Chances(count);
	// Systematic: equal steps along the chances.
	std::vector<size_t> met(count, scouted.size());
	double sum = 0;
	size_t step = 0;
	for (size_t i = 0; i < scouted.size(); ++i)
		for (sum += chances[i]; step < count && double(step) + 0.5 < sum; ++step)
			met[step] = i;
	std::vector<int> chosen;
	for (const size_t k : Spread(count))
		if (met[k] < scouted.size())
			chosen.push_back(scouted[met[k]].top / tilt_lens::PilotBlockSize * columns + scouted[met[k]].left / tilt_lens::PilotBlockSize);
	return chosen;
}

std::vector<double> CalibratedWeights(const std::vector<SampledBlock>& sampled, double blocks, double worth)
{
	double d = 0, dw = 0, dww = 0;
	for (const SampledBlock& s : sampled)
	{
		d += 1 / s.chance;
		dw += s.worth / s.chance;
		dww += s.worth * s.worth / s.chance;
	}
	const double determinant = d * dww - dw * dw;
	double a = blocks / d, b = 0;
	// As good as all of one worth: nothing to calibrate by.
	if (determinant > 1e-9 * d * dww)
	{
		a = (blocks * dww - worth * dw) / determinant;
		b = (worth * d - blocks * dw) / determinant;
		for (const SampledBlock& s : sampled)
			if (a + b * s.worth <= 0)
			{
				a = blocks / d;
				b = 0;
				break;
			}
	}
	std::vector<double> weights;
	for (const SampledBlock& s : sampled)
		weights.push_back((a + b * s.worth) / s.chance);
	return weights;
}

}
