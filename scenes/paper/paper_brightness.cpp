// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_brightness.h"

#include "picture/image_io.h"
#include <tiltcal/transfer.h>

#include <cmath>

namespace paper
{

namespace
{

Error Of(const cv::Mat& a, const cv::Mat& b, const cv::Rect& part)
{
	cv::Mat difference;
	cv::subtract(a(part), b(part), difference, cv::noArray(), CV_64F);
	const double count = double(part.area());
	return { cv::norm(difference, cv::NORM_L1) / count, cv::norm(difference, cv::NORM_L2) / std::sqrt(count) };
}

}

cv::Mat ReadLuminance(const std::string& file)
{
	return tiltcal::Luminance(tiltcal::ReadLinear(file, tiltcal::Transfer{}));
}

cv::Mat Brightness(const cv::Mat& luminance)
{
	cv::Mat out(luminance.size(), CV_32FC1);
	for (int y = 0; y < out.rows; ++y)
		for (int x = 0; x < out.cols; ++x)
			out.at<float>(y, x) = static_cast<float>(255 * tiltcal::EncodeSrgb(luminance.at<float>(y, x)));
	return out;
}

Errors Differences(const cv::Mat& a, const cv::Mat& b)
{
	return { Of(a, b, { 0, RED_ROW, a.cols, 1 }), Of(a, b, { GREEN_COLUMN, 0, 1, a.rows }), Of(a, b, { 0, 0, a.cols, a.rows }) };
}

Error DifferenceInRows(const cv::Mat& a, const cv::Mat& b, int begin, int end)
{
	return Of(a, b, { 0, begin, a.cols, end - begin });
}

}
