// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/picture.h"

#include <ImfArray.h>
#include <ImfRgbaFile.h>

#include <algorithm>
#include <cmath>
#include <fstream>
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
		picture.alpha.push_back(double(value.a));
	}
	return picture;
}

Picture ReadPpm(const std::string& path)
{
	std::ifstream file(path, std::ios::binary);
	std::string word;
	int numbers[3];
	bool good = bool(file >> word) && word == "P6";
	for (int i = 0; good && i < 3;)
	{
		file >> std::ws;
		if (file.peek() == '#') // POV-Ray notes the date
			std::getline(file, word);
		else if ((good = bool(file >> numbers[i])))
			++i;
	}
	if (!good || numbers[2] != 65535)
		throw std::runtime_error(path + " is no 16-bit PPM picture");
	file.get();
	Picture picture{numbers[0], numbers[1], {}, {}};
	const std::size_t pixels = std::size_t(picture.width) * std::size_t(picture.height);
	std::vector<unsigned char> bytes(6 * pixels);
	if (!file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size())))
		throw std::runtime_error(path + " is cut off");
	for (std::size_t i = 0; i < 3 * pixels; ++i)
		picture.rgb.push_back((bytes[2 * i] * 256 + bytes[2 * i + 1]) / 65535.0);
	picture.alpha.assign(pixels, 1.0);
	return picture;
}

Picture ReadPicture(const std::string& path)
{
	const bool ppm = path.size() > 4 && path.substr(path.size() - 4) == ".ppm";
	return ppm ? ReadPpm(path) : ReadExr(path);
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

Picture Mirrored(const Picture& picture)
{
	Picture mirrored = picture;
	const std::size_t width = std::size_t(picture.width);
	for (std::size_t i = 0; i < picture.rgb.size(); ++i)
	{
		const std::size_t row = i / 3 / width, column = i / 3 % width;
		mirrored.rgb[3 * (row * width + width - 1 - column) + i % 3] = picture.rgb[i];
	}
	return mirrored;
}

bool AllFinite(const Picture& picture)
{
	const auto finite = [](double value) { return std::isfinite(value); };
	return std::all_of(picture.rgb.begin(), picture.rgb.end(), finite) &&
		std::all_of(picture.alpha.begin(), picture.alpha.end(), finite);
}

void WriteRaw(const Picture& picture, const std::string& path)
{
	std::ofstream file(path, std::ios::binary);
	file.write(reinterpret_cast<const char*>(picture.rgb.data()), std::streamsize(picture.rgb.size() * sizeof(double)));
	if (!file.flush())
		throw std::runtime_error("cannot write " + path);
}

Picture ReadRaw(const std::string& path, int width, int height)
{
	Picture picture{width, height, std::vector<double>(3 * std::size_t(width) * std::size_t(height)), {}};
	const auto bytes = std::streamsize(picture.rgb.size() * sizeof(double));
	std::ifstream file(path, std::ios::binary);
	if (!file.read(reinterpret_cast<char*>(picture.rgb.data()), bytes) || file.peek() != std::ifstream::traits_type::eof())
		throw std::runtime_error("cannot read " + path + " as a picture of that size; run the case that makes it first");
	return picture;
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
