// SPDX-License-Identifier: AGPL-3.0-or-later
//
// exr2png IN.exr OUT.png [PHOTO GAIN SIDE.png]
//
// A linear OpenEXR picture as an 8-bit sRGB PNG, clipped at 1 and nothing else; and, when asked, PHOTO on the left of
// the same picture times GAIN. POV-Ray writes one format at a time: this saves the demo a second render.

#include <tiltcal/transfer.h>
#include "picture/image_io.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

cv::Mat Encoded(const cv::Mat& linear, float gain)
{
	cv::Mat picture(linear.size(), CV_8UC3);
	for (int y = 0; y < linear.rows; ++y)
		for (int x = 0; x < linear.cols; ++x)
			for (int c = 0; c < 3; ++c)
				picture.at<cv::Vec3b>(y, x)[c] = static_cast<unsigned char>(std::lround(255 * tiltcal::EncodeSrgb(gain * linear.at<cv::Vec3f>(y, x)[c])));
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
	cv::Mat linear = tiltcal::ReadLinear(argv[1], tiltcal::Transfer());
	if (linear.channels() == 1)
		cv::cvtColor(linear, linear, cv::COLOR_GRAY2BGR);
	Write(argv[2], Encoded(linear, 1));
	if (argc == 3)
		return 0;
	const cv::Mat photo = cv::imread(argv[3], cv::IMREAD_COLOR), render = Encoded(linear, std::stof(argv[4]));
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
