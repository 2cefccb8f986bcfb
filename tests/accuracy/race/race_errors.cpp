// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_errors.h"

#include <algorithm>
#include <array>
#include <cmath>

double RelativeMse(const Picture& picture, const Picture& truth)
{
	double sum = 0;
	for (std::size_t i = 0; i < truth.rgb.size(); ++i)
	{
		const double difference = picture.rgb[i] - truth.rgb[i];
		sum += difference * difference / (truth.rgb[i] * truth.rgb[i] + 0.01);
	}
	return sum / double(truth.rgb.size());
}

// d picture / dx and / dy at a value, central differences, 0 at the picture's rim.
static std::array<double, 2> Gradient(const Picture& picture, std::size_t i)
{
	const std::size_t width = std::size_t(picture.width), x = i / 3 % width, y = i / 3 / width;
	const auto& v = picture.rgb;
	const bool inner_x = x > 0 && x + 1 < width, inner_y = y > 0 && y + 1 < std::size_t(picture.height);
	return {inner_x ? (v[i + 3] - v[i - 3]) / 2 : 0, inner_y ? (v[i + 3 * width] - v[i - 3 * width]) / 2 : 0};
}

Picture Moved(const Picture& picture, double dx, double dy)
{
	Picture moved = picture;
	for (std::size_t i = 0; i < picture.rgb.size(); ++i)
	{
		const auto [gx, gy] = Gradient(picture, i);
		moved.rgb[i] -= dx * gx + dy * gy;
	}
	return moved;
}

Offset FindOffset(const Picture& picture, const Picture& truth)
{
	double xx = 0, xy = 0, yy = 0, x = 0, y = 0;
	for (std::size_t i = 0; i < truth.rgb.size(); ++i)
	{
		const auto [gx, gy] = Gradient(truth, i);
		const double difference = truth.rgb[i] - picture.rgb[i];
		xx += gx * gx;
		xy += gx * gy;
		yy += gy * gy;
		x += gx * difference;
		y += gy * difference;
	}
	const double determinant = xx * yy - xy * xy;
	if (determinant <= 0)
		return {};
	return {(yy * x - xy * y) / determinant, (xx * y - xy * x) / determinant};
}

double ShareOfWorseBlocks(const Picture& picture, const Picture& other, const Picture& truth)
{
	const int size = 8;
	int worse = 0, blocks = 0;
	for (int top = 0; top + size <= truth.height; top += size)
		for (int left = 0; left + size <= truth.width; left += size)
		{
			double squares = 0, other_squares = 0;
			for (int y = top; y < top + size; ++y)
				for (int i = 3 * (y * truth.width + left); i < 3 * (y * truth.width + left + size); ++i)
				{
					const std::size_t k = std::size_t(i);
					squares += std::pow(picture.rgb[k] - truth.rgb[k], 2);
					other_squares += std::pow(other.rgb[k] - truth.rgb[k], 2);
				}
			worse += squares > 1.1 * 1.1 * other_squares;
			++blocks;
		}
	return blocks > 0 ? double(worse) / blocks : 0;
}

double WithoutOwnError(double rms, double own_error)
{
	// Never to nothing: where the own error is nearly all, the difference of squares is noise.
	return std::sqrt(std::max(rms * rms - own_error * own_error, 0.04 * rms * rms));
}

Picture Mean(const std::vector<Picture>& pictures, double& own_error)
{
	Picture mean = pictures.front();
	const double n = double(pictures.size());
	for (std::size_t i = 0; i < mean.rgb.size(); ++i)
	{
		mean.rgb[i] = 0;
		for (const Picture& picture : pictures)
			mean.rgb[i] += picture.rgb[i] / n;
	}
	double squares = 0;
	for (const Picture& picture : pictures)
		squares += std::pow(RmsDifference(picture, mean), 2);
	own_error = std::sqrt(squares / (n * (n - 1)));
	return mean;
}
