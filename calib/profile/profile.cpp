// SPDX-License-Identifier: AGPL-3.0-or-later

#include "profile/profile.h"

#include <tiltcal/error.h>
#include "base/numbers.h"
#include "base/plain_text.h"
#include "picture/image_io.h"
#include <tiltcal/transfer.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const int SHADING_ORDER = 4;

double Brightness(double linear) { return 255 * EncodeSrgb(linear); }

void CheckInside(const Line& line, cv::Size size)
{
	const auto inside = [&](double x, double y) { return x >= 0 && y >= 0 && x <= size.width - 1 && y <= size.height - 1; };
	if (!inside(line.x0, line.y0) || !inside(line.x1, line.y1))
		throw UsageError(fmt::format("--line {}: leaves the picture of {}x{} pixels; x runs from 0 to {}, y from 0 to {}",
			line.text, size.width, size.height, size.width - 1, size.height - 1));
}

LineProfile Along(const cv::Mat& a, const cv::Mat& b, const Line& line)
{
	LineProfile profile;
	profile.line = line;
	const double length = std::hypot(line.x1 - line.x0, line.y1 - line.y0);
	// A length that is whole but for rounding ends on its last pixel.
	const int steps = static_cast<int>(std::floor(length + 1e-9));
	for (int k = 0; k <= steps; ++k)
	{
		const double t = length > 0 ? k / length : 0;
		const double x = line.x0 + t * (line.x1 - line.x0), y = line.y0 + t * (line.y1 - line.y0);
		profile.samples.push_back({ double(k), x, y, Brightness(Bilinear(a, x, y)), Brightness(Bilinear(b, x, y)) });
		profile.mean_abs_error += std::abs(profile.samples.back().a - profile.samples.back().b);
	}
	profile.mean_abs_error /= double(profile.samples.size());
	return profile;
}

void CompareWhole(const cv::Mat& a, const cv::Mat& b, Comparison& c)
{
	double sum = 0, squares = 0;
	for (int y = 0; y < a.rows; ++y)
		for (int x = 0; x < a.cols; ++x)
		{
			const double off = std::abs(Brightness(a.at<float>(y, x)) - Brightness(b.at<float>(y, x)));
			sum += off;
			squares += off * off;
		}
	c.mean_abs_error = sum / double(a.total());
	c.rms_error = std::sqrt(squares / double(a.total()));
}

/// Light in counts of a sensor or another unit, where most is brighter than white, would be white all over.
double GainOf(const cv::Mat& linear) { return LightQuantile(linear, 0.5) > 1 ? DisplayGain(linear) : 1; }

const char* MatchName(Match match)
{
	return match == Match::NONE ? "none" : match == Match::GAIN ? "gain" : "shading";
}

}

Line ParseLine(const std::string& text)
{
	Line line;
	line.text = text;
	size_t at = 0;
	for (double* const number : { &line.x0, &line.y0, &line.x1, &line.y1 })
	{
		const std::optional<double> value = NumberAt(text, at);
		if (!value || (number == &line.y1 ? at != text.size() : text[at] != ','))
			throw UsageError(fmt::format("--line {}: give x0,y0,x1,y1 in pixels, such as 0,660,1799,660", OneLine(text.substr(0, 60))));
		*number = *value;
		++at;
	}
	return line;
}

Match ParseMatch(const std::string& text)
{
	for (const Match match : { Match::NONE, Match::GAIN, Match::SHADING })
		if (text == MatchName(match))
			return match;
	throw UsageError(fmt::format("--match {}: give none, gain or shading", text));
}

Comparison Compare(const cv::Mat& a, const cv::Mat& b, const std::vector<Line>& lines, Match match)
{
	Comparison c;
	c.match = match;
	const cv::Mat light = Luminance(a);
	c.gain = GainOf(light);
	const cv::Mat ya = c.gain * light, yb = c.gain * Luminance(b);
	for (const Line& line : lines)
		CheckInside(line, ya.size());
	if (match != Match::NONE)
		c.shading = FitShading(ya, yb, match == Match::GAIN ? 0 : SHADING_ORDER);
	c.matched = match == Match::NONE ? yb : ApplyShading(yb, c.shading);
	for (const Line& line : lines)
		c.lines.push_back(Along(ya, c.matched, line));
	CompareWhole(ya, c.matched, c);
	return c;
}

std::string ComparisonText(const Comparison& c)
{
	std::string out;
	if (c.gain != 1)
		out += fmt::format("light of another unit: both are compared at {:.5g} times theirs, which makes A's brightest hundredth white\n", c.gain);
	switch (c.match)
	{
	case Match::NONE:
		out += "match none: B is compared as it is\n";
		break;
	case Match::GAIN:
		out += fmt::format("match gain: B times {:.5f}\n", c.shading.coefficients[0]);
		break;
	case Match::SHADING:
		out += fmt::format("match shading: B times a polynomial of order {} in x, y from -1 to 1; coefficients of 1, x, y, xx, xy, yy, ...:\n  {:.5f}\n",
			c.shading.order, fmt::join(c.shading.coefficients, " "));
		break;
	}
	for (size_t k = 0; k < c.lines.size(); ++k)
		out += fmt::format("line {} ({}): mean absolute error {:.3f} of 255 over {} samples\n", k + 1, c.lines[k].line.text,
			c.lines[k].mean_abs_error, c.lines[k].samples.size());
	return out + fmt::format("whole picture: mean absolute error {:.3f} of 255, RMS {:.3f}\n", c.mean_abs_error, c.rms_error);
}

std::string ComparisonJson(const Comparison& c, const ComparedFiles& files)
{
	nlohmann::ordered_json json;
	json["a"] = files.a;
	json["b"] = files.b;
	json["gain"] = c.gain;
	json["match"] = MatchName(c.match);
	json["shading"] = { { "order", c.shading.order }, { "coefficients", c.shading.coefficients } };
	json["lines"] = nlohmann::ordered_json::array();
	for (const LineProfile& p : c.lines)
		json["lines"].push_back({ { "line", { p.line.x0, p.line.y0, p.line.x1, p.line.y1 } }, { "samples", p.samples.size() },
			{ "mean_abs_error", p.mean_abs_error } });
	json["mean_abs_error"] = c.mean_abs_error;
	json["rms_error"] = c.rms_error;
	// A file name may be in another encoding than JSON's.
	return json.dump(1, '\t', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}
