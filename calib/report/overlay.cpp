// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/overlay.h"

#include <tiltcal/calibrate.h>
#include "base/files.h"
#include "model/predict.h"
#include "picture/image_io.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include "lens/optics.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const int SHIFT = 4;   // sub-pixel bits of OpenCV's drawing
const cv::Scalar CORNER(80, 220, 80), EDGE(255, 255, 120), ERROR(255, 80, 255), PREDICTED(255, 190, 60);
const double FULL_COLOUR = 2;   // px of difference at which the ring is fully red or blue

cv::Point Fixed(double x, double y)
{
	return { static_cast<int>(std::lround(x * (1 << SHIFT))), static_cast<int>(std::lround(y * (1 << SHIFT))) };
}

int Length(double r) { return static_cast<int>(std::lround(r * (1 << SHIFT))); }

/// Blue: measured smaller than predicted; yellow: equal; red: larger.
cv::Scalar DifferenceColour(double difference)
{
	const double t = std::clamp(difference / FULL_COLOUR, -1.0, 1.0);
	return t >= 0 ? cv::Scalar(0, 215 * (1 - t), 255) : cv::Scalar(255 * -t, 215 * (1 + t) + 90 * -t, 255 * (1 + t));
}

/// Dimmed and lifted, so that the rings stand out on black and on white squares.
cv::Mat Canvas(const cv::Mat& grey)
{
	cv::Mat canvas;
	cv::cvtColor(grey.depth() == CV_8U ? grey : ToDisplay(grey), canvas, cv::COLOR_GRAY2BGR);
	canvas.convertTo(canvas, CV_8UC3, 0.55, 40);
	return canvas;
}

void Cross(cv::Mat& canvas, const Corner& k)
{
	cv::line(canvas, Fixed(k.x - 5, k.y), Fixed(k.x + 5, k.y), CORNER, 1, cv::LINE_AA, SHIFT);
	cv::line(canvas, Fixed(k.x, k.y - 5), Fixed(k.x, k.y + 5), CORNER, 1, cv::LINE_AA, SHIFT);
}

void DrawEdges(cv::Mat& canvas, const Calibration& c, size_t s, size_t p)
{
	for (const Edge& e : c.task.states[s].photos[p].edges)
	{
		const double predicted = PredictedBlur(c, s, p, e);
		cv::circle(canvas, Fixed(e.x, e.y), Length(std::max(e.blur, 0.0) / 2), DifferenceColour(e.blur - predicted), 2, cv::LINE_AA, SHIFT);
		cv::circle(canvas, Fixed(e.x, e.y), Length(predicted / 2), PREDICTED, 1, cv::LINE_AA, SHIFT);
	}
}

void DrawCorners(cv::Mat& canvas, const Calibration& c, size_t s, size_t p)
{
	for (const Corner& k : c.task.states[s].photos[p].corners)
	{
		const Point at = Reproject(c.task, c.MainGeometry(), s, p, k.column, k.row);
		Cross(canvas, k);
		cv::line(canvas, Fixed(k.x, k.y), Fixed(k.x + 20 * (at[0] - k.x), k.y + 20 * (at[1] - k.y)), ERROR, 2, cv::LINE_AA, SHIFT);
	}
}

/// One entry of the legend; returns where the next begins.
int Entry(cv::Mat& strip, int x, int y, const cv::Scalar& colour, int thickness, bool ring, const std::string& text)
{
	if (ring)
		cv::circle(strip, cv::Point(x + 10, y), 8, colour, thickness, cv::LINE_AA);
	else
		cv::line(strip, cv::Point(x, y), cv::Point(x + 20, y), colour, thickness, cv::LINE_AA);
	cv::putText(strip, text, cv::Point(x + 28, y + 6), cv::FONT_HERSHEY_SIMPLEX, 0.55, cv::Scalar(235, 235, 235), 1, cv::LINE_AA);
	int base = 0;
	return x + 28 + cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 0.55, 1, &base).width + 26;
}

cv::Mat Legend(const Calibration& c, size_t s, size_t p, int width)
{
	cv::Mat strip(96, width, CV_8UC3, cv::Scalar(40, 40, 40));
	const StateLens& lens = c.solution.states[s];
	const Photo& photo = c.task.states[s].photos[p];
	double sum = 0;
	for (const Edge& e : photo.edges)
		sum += std::pow(e.blur - PredictedBlur(c, s, p, e), 2);
	cv::putText(strip, fmt::format("{} | state {} | model {} | lens tilt {:.2f} deg, direction {:.1f} deg | corners {:.2f} px RMS, blur {:.2f} px RMS | {}",
		BaseName(photo.file), c.task.states[s].name, NameOf(c.solution.model), lens.lens_tilt.value, lens.tilt_direction.value,
		c.MainGeometry().states[s].photo_rms[p], std::sqrt(sum / double(std::max<size_t>(photo.edges.size(), 1))), RatioText(photo)),
		cv::Point(14, 26), cv::FONT_HERSHEY_SIMPLEX, 0.6, cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
	int x = 14;
	x = Entry(strip, x, 48, CORNER, 1, false, c.task.board.IsCheckerboard() ? "detected corner" : "detected centre");
	x = Entry(strip, x, 48, ERROR, 2, false, "reprojection error x 20");
	Entry(strip, x, 48, PREDICTED, 1, true, "predicted blur disc");
	x = 14;
	x = Entry(strip, x, 76, DifferenceColour(-FULL_COLOUR), 2, true, fmt::format("measured disc, {:g} px or more below prediction", FULL_COLOUR));
	x = Entry(strip, x, 76, DifferenceColour(0), 2, true, "as predicted");
	Entry(strip, x, 76, DifferenceColour(FULL_COLOUR), 2, true, fmt::format("{:g} px or more above", FULL_COLOUR));
	return strip;
}

}

cv::Mat DrawMeasured(const cv::Mat& grey, const Photo& photo)
{
	cv::Mat canvas = Canvas(grey), whole;
	for (const Edge& e : photo.edges)
	{
		const double x = e.ny + e.slope * e.nx, y = -e.nx + e.slope * e.ny, half = 0.35 * e.square_px / std::hypot(x, y);
		cv::line(canvas, Fixed(e.x - half * x, e.y - half * y), Fixed(e.x + half * x, e.y + half * y), EDGE, 1, cv::LINE_AA, SHIFT);
		cv::circle(canvas, Fixed(e.x, e.y), Length(std::max(e.blur, 0.0) / 2), DifferenceColour(0), 1, cv::LINE_AA, SHIFT);
	}
	for (const Corner& k : photo.corners)
		Cross(canvas, k);
	cv::Mat strip(64, canvas.cols, CV_8UC3, cv::Scalar(40, 40, 40));
	const bool circles = !photo.edges.empty() && photo.edges.front().arc >= 0;
	const std::string text = fmt::format("{} | {} {} left out | {}", BaseName(photo.file), photo.edges_dropped, circles ? "arcs" : "edges", RatioText(photo));
	int base = 0;
	const double fitting = (strip.cols - 28) / double(cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, 1, 1, &base).width);
	cv::putText(strip, text, cv::Point(14, 24), cv::FONT_HERSHEY_SIMPLEX, std::min(0.5, fitting), cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
	int x = Entry(strip, 14, 46, CORNER, 1, false, circles ? "centre" : "corner");
	x = Entry(strip, x, 46, EDGE, 1, false, circles ? "outline" : "edge");
	Entry(strip, x, 46, DifferenceColour(0), 1, true, "blur disc");
	cv::vconcat(canvas, strip, whole);
	return whole;
}

cv::Mat DrawOverlay(const cv::Mat& grey, const Calibration& c, size_t s, size_t p)
{
	cv::Mat canvas = Canvas(grey);
	DrawEdges(canvas, c, s, p);
	DrawCorners(canvas, c, s, p);
	cv::Mat whole;
	cv::vconcat(canvas, Legend(c, s, p, canvas.cols), whole);
	return whole;
}

}
