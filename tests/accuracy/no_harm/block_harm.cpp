// SPDX-License-Identifier: AGPL-3.0-or-later

#include "no_harm/block_harm.h"

#include <boost/math/distributions/poisson.hpp>
#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{

/// OpenEXR's half floats round white by up to 2^-12: squared, a third of that. Less than this is not the pictures' doing.
const double Rounding = 2e-8;

double Clipped(double x) { return std::min(1.0, std::max(0.0, x)); }

/// Mean squared error of a block.
double SquaredError(const Picture& picture, const Picture& truth, int left, int top)
{
	double sum = 0;
	for (int y = top; y < top + HarmBlock; ++y)
		for (int i = 3 * (y * truth.width + left); i < 3 * (y * truth.width + left + HarmBlock); ++i)
			sum += std::pow(Clipped(picture.rgb[std::size_t(i)]) - Clipped(truth.rgb[std::size_t(i)]), 2);
	return sum / (3 * HarmBlock * HarmBlock);
}

/// Whether the mean of `made - factor raw` is above nothing, by Student's t.
bool IsWorse(const std::vector<double>& raw, const std::vector<double>& made, double factor, double student)
{
	const double n = double(raw.size());
	double mean = 0, squares = 0;
	for (std::size_t i = 0; i < raw.size(); ++i)
		mean += (made[i] - factor * raw[i] - Rounding) / n;
	for (std::size_t i = 0; i < raw.size(); ++i)
		squares += std::pow(made[i] - factor * raw[i] - Rounding - mean, 2);
	return mean > 0 && mean > student * std::sqrt(squares / (n * (n - 1)));
}

}

void BlockHarm::Add(const BlockHarm& other)
{
	blocks += other.blocks;
	judged += other.judged;
	once += other.once;
	tenth += other.tenth;
	any += other.any;
	raw += other.raw;
	made += other.made;
	if (other.worst > worst)
	{
		worst = other.worst;
		worst_x = other.worst_x;
		worst_y = other.worst_y;
	}
}

BlockHarm CompareBlocks(const std::vector<Picture>& raw, const std::vector<Picture>& made, const Picture& truth)
{
	if (raw.size() != made.size() || raw.size() < 2)
		throw std::runtime_error("two pairs at least");
	const double student = boost::math::quantile(boost::math::complement(boost::math::students_t(double(raw.size() - 1)), HarmLevel));
	const double tenth = 1.1 * 1.1;
	BlockHarm harm;
	std::vector<double> own(raw.size()), after(raw.size());
	for (int top = 0; top + HarmBlock <= truth.height; top += HarmBlock)
		for (int left = 0; left + HarmBlock <= truth.width; left += HarmBlock)
		{
			double own_sum = 0, after_sum = 0;
			for (std::size_t i = 0; i < raw.size(); ++i)
			{
				own[i] = SquaredError(raw[i], truth, left, top);
				after[i] = SquaredError(made[i], truth, left, top);
				harm.once += after[i] > tenth * own[i] + Rounding;
				own_sum += own[i];
				after_sum += after[i];
			}
			harm.judged += int(raw.size());
			++harm.blocks;
			harm.tenth += IsWorse(own, after, tenth, student);
			harm.raw += own_sum;
			harm.made += after_sum;
			if (!IsWorse(own, after, 1, student))
				continue;
			++harm.any;
			const double ratio = std::sqrt(after_sum / std::max(own_sum, Rounding * double(raw.size())));
			if (ratio > harm.worst)
			{
				harm.worst = ratio;
				harm.worst_x = left;
				harm.worst_y = top;
			}
		}
	return harm;
}

int HarmAllowed(int blocks)
{
	const boost::math::poisson chance(HarmLevel * blocks);
	int count = 0;
	while (boost::math::cdf(boost::math::complement(chance, count)) > 1e-4)
		++count;
	return count;
}
