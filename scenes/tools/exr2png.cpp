// SPDX-License-Identifier: AGPL-3.0-or-later
//
// exr2png IN.exr OUT.png [PHOTO GAIN SIDE.png]
//
// A linear OpenEXR picture as an 8-bit sRGB PNG, clipped at 1 and nothing else; and, when asked, PHOTO on the left of
// the same picture times GAIN. POV-Ray writes one format at a time: this saves the demo a second render.

#include <ImfArray.h>
#include <ImfRgbaFile.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

// IEC 61966-2-1. A value that is no number counts as black.
unsigned char Encode(float linear)
{
	const double value = linear > 0 ? std::min(double(linear), 1.0) : 0.0;
	const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
	return static_cast<unsigned char>(std::lround(255 * encoded));
}

cv::Mat ReadEncoded(const char* path, float gain)
{
	Imf::RgbaInputFile file(path);
	const auto window = file.dataWindow();
	const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
	cv::Mat picture(height, width, CV_8UC3);
	Imf::Array<Imf::Rgba> row(width);
	for (int y = 0; y < height; ++y)
	{
		file.setFrameBuffer(&row[0] - window.min.x, 1, 0);
		file.readPixels(window.min.y + y);
		for (int x = 0; x < width; ++x)
			picture.at<cv::Vec3b>(y, x) = cv::Vec3b(Encode(gain * row[x].b), Encode(gain * row[x].g), Encode(gain * row[x].r));
	}
	return picture;
}

void Write(const char* path, const cv::Mat& picture)
{
	if (!cv::imwrite(path, picture))
		throw std::runtime_error(std::string("cannot write ") + path);
}

}

int main(int argc, char** argv)
try
{
	if (argc != 3 && argc != 6)
	{
		std::fprintf(stderr, "usage: exr2png IN.exr OUT.png [PHOTO GAIN SIDE.png]\n");
		return 2;
	}
	Write(argv[2], ReadEncoded(argv[1], 1));
	if (argc == 3)
		return 0;
	const cv::Mat photo = cv::imread(argv[3], cv::IMREAD_COLOR), render = ReadEncoded(argv[1], std::stof(argv[4]));
	if (photo.rows != render.rows)
		throw std::runtime_error(std::string(argv[3]) + " is unreadable or of another height than the render");
	cv::Mat side;
	cv::hconcat(std::vector<cv::Mat>{photo, cv::Mat(photo.rows, 12, CV_8UC3, cv::Scalar::all(255)), render}, side);
	Write(argv[5], side);
	return 0;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "exr2png: %s\n", error.what());
	return 3;
}
