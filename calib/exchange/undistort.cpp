// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/undistort.h"

#include "exchange/write_exr.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <vector>

namespace tiltcal
{

namespace
{

/// Keys's weights with a = -1/2 for the pixels -1, 0, 1, 2 about a place `s` behind pixel 0. OpenCV's remap takes a = -3/4, which shifts
/// slopes by up to 0.05 px, and rounds places to 1/32 px.
std::array<float, 4> CubicWeights(float s)
{
	return { s * (-0.5f + s * (1 - 0.5f * s)), 1 + s * s * (1.5f * s - 2.5f), s * (0.5f + s * (2 - 1.5f * s)), s * s * (0.5f * s - 0.5f) };
}

/// All channels of `picture` at a place less than a pixel outside, or black.
void Sample(const cv::Mat& picture, const cv::Vec2f& place, float* out)
{
	const int channels = picture.channels();
	std::fill(out, out + channels, 0.f);
	if (!(place[0] > -1 && place[1] > -1 && place[0] < float(picture.cols) && place[1] < float(picture.rows)))
		return;
	const int x = int(std::floor(place[0])), y = int(std::floor(place[1]));
	const std::array<float, 4> across = CubicWeights(place[0] - float(x)), down = CubicWeights(place[1] - float(y));
	for (int j = 0; j < 4; ++j)
	{
		const float* row = picture.ptr<float>(std::clamp(y + j - 1, 0, picture.rows - 1));
		for (int i = 0; i < 4; ++i)
		{
			const float* pixel = row + channels * std::clamp(x + i - 1, 0, picture.cols - 1);
			for (int k = 0; k < channels; ++k)
				out[k] += down[size_t(j)] * across[size_t(i)] * pixel[k];
		}
	}
	for (int k = 0; k < channels; ++k)
		out[k] = std::max(out[k], 0.f);
}

float Encoded(const Transfer& transfer, float linear)
{
	const double light = std::clamp<double>(linear, 0, 1);
	switch (transfer.kind)
	{
	case Transfer::SRGB:
		return float(EncodeSrgb(light));
	case Transfer::GAMMA:
		return float(std::pow(light, 1 / transfer.gamma));
	default:
		return float(light);
	}
}

void WritePng16(const cv::Mat& linear, const Transfer& transfer, const std::string& file, FileSet& set)
{
	cv::Mat coded = linear.clone();
	for (int y = 0; y < coded.rows; ++y)
		for (int k = 0; k < coded.cols * coded.channels(); ++k)
			coded.ptr<float>(y)[k] = Encoded(transfer, coded.ptr<float>(y)[k]);
	cv::Mat integers;
	coded.convertTo(integers, CV_16U, 65535);
	std::vector<uchar> bytes;
	cv::imencode(".png", integers, bytes);
	set.Text(file, std::string(bytes.begin(), bytes.end()));
}

void WriteExrOf(const cv::Mat& linear, const std::string& file, FileSet& set)
{
	std::vector<cv::Mat> planes;
	cv::split(linear, planes);
	const std::map<std::string, cv::Mat> channels = planes.size() == 1 ? std::map<std::string, cv::Mat>{ { "Y", planes[0] } }
		: std::map<std::string, cv::Mat>{ { "B", planes[0] }, { "G", planes[1] }, { "R", planes[2] } };
	set.Write(file, [&](const std::string& temporary) { return WriteExr(temporary, channels, {}); });
}

}

Resampling::Resampling(const StateCamera& camera, const Margins& margins, Direction direction)
{
	const StateCamera flat = FlatView(camera, margins);
	const bool undistort = direction == Direction::UNDISTORT;
	const StateCamera &to = undistort ? flat : camera, &source = undistort ? camera : flat;
	map = PixelMap(to, source);
	from = { source.width, source.height };
	expected = undistort ? fmt::format("the photographs of the calibration have {} x {}", from.width, from.height)
		: fmt::format("the undistorted picture has {} x {}; --overscan says how much larger than the photograph it is", from.width, from.height);
}

cv::Mat Resampling::Of(const cv::Mat& linear, const std::string& file) const
{
	if (linear.size() != from)
		throw Refused(fmt::format("{} is {} x {} pixels; {}", file, linear.cols, linear.rows, expected));
	cv::Mat out(map.size(), linear.type());
	cv::parallel_for_({ 0, map.rows }, [&](const cv::Range& rows)
	{
		for (int y = rows.start; y < rows.end; ++y)
			for (int x = 0; x < map.cols; ++x)
				Sample(linear, map.at<cv::Vec2f>(y, x), out.ptr<float>(y) + linear.channels() * x);
	});
	return out;
}

double BrighterThanWhite(const cv::Mat& linear)
{
	std::vector<cv::Mat> channels;
	cv::split(linear, channels);
	cv::Mat beyond;
	for (const cv::Mat& channel : channels)
		beyond = beyond.empty() ? cv::Mat(channel > 1) : cv::Mat(beyond | (channel > 1));
	return cv::countNonZero(beyond) / double(linear.total());
}

void WriteLinear(const cv::Mat& linear, const Transfer& transfer, const std::string& file, FileSet& set)
{
	const std::string suffix = std::filesystem::path(file).extension().string();
	if (suffix == ".png")
		return WritePng16(linear, transfer, file, set);
	if (suffix == ".exr")
		return WriteExrOf(linear, file, set);
	throw UsageError(fmt::format("{}: the suffix says the format: .png (16 bits) or .exr", file));
}

}
