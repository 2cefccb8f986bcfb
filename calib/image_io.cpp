// SPDX-License-Identifier: AGPL-3.0-or-later

#include "image_io.h"

#include "error.h"
#include "exr_io.h"
#include "files.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

namespace fs = std::filesystem;

namespace tiltcal
{

namespace
{

std::string ReadBytes(const std::string& file)
{
	std::error_code code;
	if (!fs::exists(file, code))
		throw FileError(fmt::format("{}: no such file", file));
	if (fs::is_directory(file, code))
		throw FileError(fmt::format("{}: is a folder, not a picture; give the files, such as '{}/*.png'", file, file));
	std::ifstream in(file, std::ios::binary);
	std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
	if (!in)
		throw FileError(fmt::format("{}: cannot be read; check its permissions", file));
	if (bytes.empty())
		throw FileError(fmt::format("{}: is empty (0 bytes)", file));
	return bytes;
}

bool StartsWith(const std::string& bytes, const std::string& magic)
{
	return bytes.compare(0, magic.size(), magic) == 0;
}

/// OpenCV fills the missing part of a cut JPEG or PNG with grey and says nothing,
/// so the end marker is looked for here.
void RefuseTruncated(const std::string& file, const std::string& bytes)
{
	const bool png = StartsWith(bytes, "\x89PNG");
	const bool jpeg = StartsWith(bytes, "\xff\xd8\xff");
	const std::string end = png ? "IEND" : "\xff\xd9";
	if ((png || jpeg) && bytes.rfind(end) == std::string::npos)
		throw FileError(fmt::format("{}: is truncated (the end of the {} stream is missing); copy it again",
			file, png ? "PNG" : "JPEG"));
}

cv::Mat Decode(const std::string& file, const std::string& bytes)
{
	RefuseTruncated(file, bytes);
	cv::Mat image;
	try
	{
		const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
		image = cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
	}
	catch (const cv::Exception& e)
	{
		throw FileError(fmt::format("{}: cannot be decoded: {}", file, e.err));
	}
	if (image.empty())
		throw FileError(fmt::format("{}: not a picture, or damaged; PNG, JPEG, TIFF and OpenEXR are read", file));
	return image;
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

cv::Mat DropAlpha(const cv::Mat& image)
{
	cv::Mat result;
	if (image.channels() == 4)
		cv::cvtColor(image, result, cv::COLOR_BGRA2BGR);
	else if (image.channels() == 2)
		cv::extractChannel(image, result, 0);
	else
		result = image;
	return result;
}

}

cv::Mat ReadLinear(const std::string& file, const Transfer& transfer)
{
	const std::string bytes = ReadBytes(file);
	cv::Mat image;
	if (StartsWith(bytes, "\x76\x2f\x31\x01"))
		image = ReadExr(file);
	else
	{
		image = DropAlpha(Decode(file, bytes));
		switch (image.depth())
		{
		case CV_8U: image = Linearise<uchar>(image, transfer); break;
		case CV_16U: image = Linearise<ushort>(image, transfer); break;
		case CV_32F: break;
		case CV_64F: image.convertTo(image, CV_32F); break;
		default: throw FileError(fmt::format("{}: its sample format is not read; convert it to 8 or 16 bit", file));
		}
	}
	if (image.channels() != 1 && image.channels() != 3)
		throw FileError(fmt::format("{}: has {} channels; 1 (grey) or 3 (colour) are read", file, image.channels()));
	if (!cv::checkRange(image))
		throw FileError(fmt::format("{}: has pixels that are not numbers (NaN or infinite)", file));
	return image;
}

cv::Mat Luminance(const cv::Mat& linear)
{
	if (linear.channels() == 1)
		return linear;
	cv::Mat grey;
	cv::transform(linear, grey, cv::Matx13f(0.0722f, 0.7152f, 0.2126f));
	return grey;
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

void WritePng(const std::string& file, const cv::Mat& image)
{
	WriteAtomically(file, [&](const std::string& temporary) { return cv::imwrite(temporary, image); });
}

}
