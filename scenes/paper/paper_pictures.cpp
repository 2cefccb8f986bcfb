// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_pictures.h"

#include <algorithm>
#include <cmath>

namespace paper
{

std::array<unsigned char, 3> DifferenceColour(double x)
{
	// Dark blue, blue, near white, red, dark red: as dark on either side, and told apart by those who see no green.
	static const double stops[5][3] = { { 97, 48, 5 }, { 195, 147, 67 }, { 247, 247, 247 }, { 77, 96, 214 }, { 31, 0, 103 } };
	const double position = 2 * (std::clamp(x, -1.0, 1.0) + 1);
	const int k = std::min(3, static_cast<int>(position));
	std::array<unsigned char, 3> colour{};
	for (int c = 0; c < 3; ++c)
		colour[static_cast<size_t>(c)] = static_cast<unsigned char>(std::lround(stops[k][c] + (position - k) * (stops[k + 1][c] - stops[k][c])));
	return colour;
}

cv::Mat DifferencePicture(const cv::Mat& a, const cv::Mat& b)
{
	cv::Mat picture(a.size(), CV_8UC3);
	for (int y = 0; y < a.rows; ++y)
		for (int x = 0; x < a.cols; ++x)
		{
			const auto colour = DifferenceColour((a.at<float>(y, x) - b.at<float>(y, x)) / COLOUR_LEVELS);
			picture.at<cv::Vec3b>(y, x) = { colour[0], colour[1], colour[2] };
		}
	return picture;
}

}
