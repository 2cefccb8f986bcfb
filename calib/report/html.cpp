// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/html.h"

#include "base/plain_text.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal::html
{

namespace
{

std::string Base64(const std::vector<unsigned char>& bytes)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string text;
	text.reserve(4 * (bytes.size() / 3 + 1));
	for (size_t i = 0; i < bytes.size(); i += 3)
	{
		unsigned group = 0;
		for (size_t k = 0; k < 3; ++k)
			group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
		for (size_t k = 0; k < 4; ++k)
			text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
	}
	return text;
}

std::vector<unsigned char> Jpeg(const cv::Mat& image, int width)
{
	cv::Mat small = image;
	if (image.cols > width)
		cv::resize(image, small, cv::Size(width, std::max(1, image.rows * width / image.cols)), 0, 0, cv::INTER_AREA);
	std::vector<unsigned char> bytes;
	cv::imencode(".jpg", small, bytes, { cv::IMWRITE_JPEG_QUALITY, 85 });
	return bytes;
}

}

std::string Number(double value, int digits)
{
	if (std::isnan(value))
		return "–";
	if (std::isinf(value))
		return value > 0 ? "∞" : "−∞";
	std::string text = fmt::format("{:.{}f}", std::abs(value), digits);
	// What rounds to 0 has no sign.
	const bool nothing = text.find_first_not_of("0.") == std::string::npos;
	return value < 0 && !nothing ? "−" + text : text;
}

std::string WithSigma(const Estimate& e, const std::string& unit, int digits)
{
	const std::string tail = unit.empty() || unit == "°" ? unit : " " + unit;
	if (!(e.sigma > 0) || !std::isfinite(e.sigma) || !std::isfinite(e.value))
		return Number(e.value, digits) + (std::isfinite(e.value) ? tail : "");
	const int shown = std::clamp(1 - static_cast<int>(std::floor(std::log10(e.sigma))), 0, 9);
	return Number(e.value, shown) + " ± " + Number(e.sigma, shown) + tail;
}

std::string Table(const std::vector<std::vector<std::string>>& rows)
{
	std::string out = "<div class=\"wide\"><table>\n";
	for (size_t r = 0; r < rows.size(); ++r)
	{
		out += "<tr>";
		for (size_t k = 0; k < rows[r].size(); ++k)
			out += fmt::format("<{0}>{1}</{0}>", r == 0 || k == 0 ? "th" : "td", rows[r][k]);
		out += "</tr>\n";
	}
	return out + "</table></div>\n";
}

std::string JpegUri(const cv::Mat& image, int width, size_t bytes)
{
	const int least = 480;
	std::vector<unsigned char> jpeg = Jpeg(image, width);
	while (jpeg.size() > bytes && width > least)
	{
		width = std::max(least, static_cast<int>(0.8 * std::min(width, image.cols)));
		jpeg = Jpeg(image, width);
	}
	return "data:image/jpeg;base64," + Base64(jpeg);
}

std::string PhotoColour(size_t photo)
{
	// Distinct in hue and in lightness, none near the blue of the plane of focus.
	static const char* const colours[] = { "#d62728", "#2ca02c", "#9467bd", "#e08a00", "#8c564b", "#e377c2", "#5f6b00", "#00929e", "#a0005a", "#6b6b6b", "#b8a000", "#3b3b98" };
	return colours[photo % (sizeof colours / sizeof *colours)];
}

double RoundNumber(double x)
{
	const double power = std::pow(10, std::floor(std::log10(x)));
	const double digit = x / power;
	return power * (digit >= 5 ? 5 : digit >= 2 ? 2 : 1);
}

}
