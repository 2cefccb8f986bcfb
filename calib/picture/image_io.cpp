// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/image_io.h"

#include <tiltcal/photo.h>
#include <tiltcal/error.h>
#include "picture/exif.h"
#include "picture/exr_io.h"
#include "base/files.h"
#include "picture/jpeg_io.h"
#include "picture/picture_file.h"
#include "picture/png_io.h"
#include "picture/tiff_io.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

namespace tiltcal
{

namespace
{

cv::Mat Decode(const PictureFile& picture, std::string& left_out, bool& subsampled_colour)
{
	switch (picture.format)
	{
	case PictureFormat::PNG: return DecodePng(picture, &left_out);
	case PictureFormat::JPEG:
		subsampled_colour = HasSubsampledColour(picture);
		return DecodeJpeg(picture);
	case PictureFormat::TIFF: return DecodeTiff(picture, &left_out, &subsampled_colour);
	case PictureFormat::EXR: break;
	}
	return DecodeExr(picture, &left_out);
}

/// Linear float of an integer picture through a table of its codes.
template<typename Code>
cv::Mat Linearise(const cv::Mat& coded, const Transfer& transfer)
{
	const int levels = std::numeric_limits<Code>::max() + 1;
	std::vector<float> table(static_cast<size_t>(levels));
	for (int i = 0; i < levels; ++i)
		table[static_cast<size_t>(i)] = static_cast<float>(ToLinear(transfer, i / double(levels - 1)));
	cv::Mat linear(coded.size(), CV_MAKETYPE(CV_32F, coded.channels()));
	const int n = coded.cols * coded.channels();
	for (int y = 0; y < coded.rows; ++y)
	{
		const Code* in = coded.ptr<Code>(y);
		float* out = linear.ptr<float>(y);
		for (int x = 0; x < n; ++x)
			out[x] = table[in[x]];
	}
	return linear;
}

/// In linear light below 0 there is only what noise and resampling leave (a Lanczos filter
/// undershoots an edge by a tenth); above any unit of light there is only damage.
const double LEAST_LIGHT = -0.1, MOST_LIGHT = 1e12;

void CheckLight(const std::string& file, const cv::Mat& linear)
{
	if (!cv::checkRange(linear))
		throw FileError(fmt::format("{}: has pixels that are not numbers (NaN or infinite)", file));
	double least = 0, most = 0;
	cv::minMaxLoc(linear.reshape(1), &least, &most);
	if (most > MOST_LIGHT)
		throw FileError(fmt::format("{}: has pixels of {:g}; 1 is white", file, most));
	if (least < 0 && least < LEAST_LIGHT * most)
		throw FileError(fmt::format("{}: has pixels of {:g} where the brightest is {:g}: this is no light; export linear brightness, not logarithms or differences",
			file, least, most));
}

cv::Mat ReadAndLinearise(const std::string& file, const Transfer& transfer, PhotographFacts* facts)
{
	const PictureFile picture = ReadPictureFile(file);
	std::string left_out;
	bool subsampled_colour = false;
	cv::Mat image = Decode(picture, left_out, subsampled_colour);
	if (facts)
	{
		*facts = ReadFacts(picture, image.cols);
		facts->left_out = left_out;
		facts->subsampled_colour = subsampled_colour;
		facts->floating_point = image.depth() != CV_8U && image.depth() != CV_16U;
	}
	switch (image.depth())
	{
	case CV_8U: return Linearise<uchar>(image, transfer);
	case CV_16U: return Linearise<ushort>(image, transfer);
	default: break;
	}
	image.convertTo(image, CV_32F);
	CheckLight(file, image);
	return image;
}

}

cv::Mat ReadLinear(const std::string& file, const Transfer& transfer, PhotographFacts* facts)
{
	try
	{
		return ReadAndLinearise(file, transfer, facts);
	}
	catch (const Error&)
	{
		throw;
	}
	catch (const std::bad_alloc&)
	{
		throw FileError(fmt::format("{}: too large for this machine's memory", file));
	}
	catch (const std::exception& e)
	{
		throw FileError(fmt::format("{}: cannot be read: {}", file, e.what()));
	}
}

double Bilinear(const cv::Mat& image, double x, double y)
{
	const int x0 = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(0, image.cols - 2));
	const int y0 = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(0, image.rows - 2));
	const int x1 = std::min(x0 + 1, image.cols - 1), y1 = std::min(y0 + 1, image.rows - 1);
	const double fx = x - x0, fy = y - y0;
	return (1 - fy) * ((1 - fx) * image.at<float>(y0, x0) + fx * image.at<float>(y0, x1))
		+ fy * ((1 - fx) * image.at<float>(y1, x0) + fx * image.at<float>(y1, x1));
}

cv::Mat Luminance(const cv::Mat& linear)
{
	if (linear.channels() == 1)
		return linear;
	cv::Mat grey;
	cv::transform(linear, grey, cv::Matx13f(0.0722f, 0.7152f, 0.2126f));
	return grey;
}

double LightQuantile(const cv::Mat& linear, double share)
{
	std::vector<float> values;
	const int step = std::max(1, static_cast<int>(std::sqrt(double(linear.total()) / 1e5)));
	for (int y = 0; y < linear.rows; y += step)
		for (int x = 0; x < linear.cols; x += step)
			for (int c = 0; c < linear.channels(); ++c)
				values.push_back(linear.ptr<float>(y)[x * linear.channels() + c]);
	const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * double(values.size()));
	std::nth_element(values.begin(), at, values.end());
	return *at;
}

double BrightestHundredth(const cv::Mat& linear) { return LightQuantile(linear, 0.99); }

double DisplayGain(const cv::Mat& linear)
{
	const double DARK = 0.01;   // a hundredth of white: 10 % grey in sRGB
	const double brightest = BrightestHundredth(linear);
	const bool ordinary = brightest > DARK && LightQuantile(linear, 0.5) <= 1;
	return ordinary || !(brightest > 0) ? 1 : 1 / brightest;
}

cv::Mat ToDisplay(const cv::Mat& linear, double gain)
{
	// A table of 4096 steps in the square root of the light is finer than 8 bits everywhere.
	const int STEPS = 4096;
	static const std::vector<uchar> table = []
	{
		std::vector<uchar> t(STEPS + 1);
		for (int i = 0; i <= STEPS; ++i)
			t[static_cast<size_t>(i)] = cv::saturate_cast<uchar>(255 * EncodeSrgb((i / double(STEPS)) * (i / double(STEPS))));
		return t;
	}();
	cv::Mat display(linear.size(), CV_MAKETYPE(CV_8U, linear.channels()));
	const int n = linear.cols * linear.channels();
	for (int y = 0; y < linear.rows; ++y)
	{
		const float* in = linear.ptr<float>(y);
		uchar* out = display.ptr<uchar>(y);
		for (int x = 0; x < n; ++x)
		{
			const double c = std::clamp(double(in[x]) * gain, 0.0, 1.0);
			out[x] = table[static_cast<size_t>(std::lround(std::sqrt(c) * STEPS))];
		}
	}
	return display;
}

cv::Mat ToDisplay(const cv::Mat& linear) { return ToDisplay(linear, DisplayGain(linear)); }

std::string PngOf(const cv::Mat& image)
{
	// Not imwrite, which does not see a full disk.
	std::vector<uchar> bytes;
	cv::imencode(".png", image, bytes);
	return { bytes.begin(), bytes.end() };
}

void WritePng(const std::string& file, const cv::Mat& image)
{
	WriteText(file, PngOf(image));
}

}
