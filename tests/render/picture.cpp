// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture.h"

#include <ImfArray.h>
#include <ImfRgbaFile.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

Picture ReadExr(const std::string& path)
{
	Imf::RgbaInputFile file(path.c_str());
	const auto window = file.dataWindow();
	Picture picture;
	picture.width = window.max.x - window.min.x + 1;
	picture.height = window.max.y - window.min.y + 1;
	const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
	Imf::Array<Imf::Rgba> values(static_cast<long>(pixels));
	file.setFrameBuffer(&values[0] - window.min.x - window.min.y * picture.width, 1, std::size_t(picture.width));
	file.readPixels(window.min.y, window.max.y);
	picture.rgb.reserve(3 * pixels);
	for (std::size_t i = 0; i < pixels; ++i)
	{
		const Imf::Rgba& value = values[static_cast<long>(i)];
		picture.rgb.insert(picture.rgb.end(), {double(value.r), double(value.g), double(value.b)});
	}
	return picture;
}

Picture Coarser(const Picture& picture, int size)
{
	Picture coarse;
	coarse.width = picture.width / size;
	coarse.height = picture.height / size;
	coarse.rgb.assign(3 * std::size_t(coarse.width) * std::size_t(coarse.height), 0.0);
	for (int y = 0; y < coarse.height * size; ++y)
		for (int x = 0; x < coarse.width * size; ++x)
			for (int c = 0; c < 3; ++c)
				coarse.rgb[std::size_t(3 * (y / size * coarse.width + x / size) + c)] +=
					picture.rgb[std::size_t(3 * (y * picture.width + x) + c)] / (size * size);
	return coarse;
}

static void NeedEqualSizes(const Picture& a, const Picture& b)
{
	if (a.width != b.width || a.height != b.height)
		throw std::runtime_error("pictures of different sizes");
}

double RmsDifference(const Picture& a, const Picture& b)
{
	NeedEqualSizes(a, b);
	double sum = 0;
	for (std::size_t i = 0; i < a.rgb.size(); ++i)
		sum += (a.rgb[i] - b.rgb[i]) * (a.rgb[i] - b.rgb[i]);
	return std::sqrt(sum / double(a.rgb.size()));
}

double LargestDifference(const Picture& a, const Picture& b)
{
	NeedEqualSizes(a, b);
	double largest = 0;
	for (std::size_t i = 0; i < a.rgb.size(); ++i)
		largest = std::max(largest, std::abs(a.rgb[i] - b.rgb[i]));
	return largest;
}
