// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose_photo.h"

#include <tiltcal/error.h>
#include "camera/pose_weights.h"
#include "measure/find_crossing.h"
#include "picture/image_io.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// The pose that tells the weights is itself better by them; a third round changes nothing that can be seen.
const int WEIGHING_ROUNDS = 2;

/// What the eye and this program compare: noise is about equal in dark and bright.
cv::Mat Encoded(const cv::Mat& photo)
{
	cv::Mat grey = Luminance(photo).clone();
	const double gain = DisplayGain(grey);
	grey.forEach<float>([gain](float& value, const int*) { value = static_cast<float>(EncodeSrgb(gain * value)); });
	return grey;
}

void NeedSize(const StateCamera& camera, const cv::Mat& photo)
{
	if (photo.cols != camera.width || photo.rows != camera.height)
		throw UsageError(fmt::format("`photo` is {} x {} pixels, the calibrated picture {} x {}: give the photograph at its full size",
			photo.cols, photo.rows, camera.width, camera.height));
}

/// The point moved to the crossing near `at`, if there is one within `reach`.
bool Measure(const cv::Mat& grey, const Point& at, int half, double reach, Placed placed, PosePoint& point)
{
	const auto found = FindCrossing(grey, { at[0], at[1] }, half, reach);
	if (!found)
		return false;
	point.u = found->x;
	point.v = found->y;
	point.placed = placed;
	return true;
}

/// The photograph, and the same smoothed for crossings whose blur leaves little slope beside the noise. A blur that is the same all round does not move them.
struct Greys
{
	cv::Mat sharp, smooth;
	int half;

	Greys(const cv::Mat& photo, int window) : sharp(Encoded(photo)), half(window) { cv::GaussianBlur(sharp, smooth, cv::Size(), half / 6.0); }
	/// For a blur disc so many px wide: wider than half of the window, or not.
	const cv::Mat& For(double blur) const { return blur > half ? smooth : sharp; }
};

/// Measures points where `pose` sees them: those found before anew, those of the file that were not measured yet, and those whose blur asks for the smoothed picture.
void Look(const StateCamera& camera, const Greys& greys, double unit_mm, const std::vector<PosePoint>& points, PhotoPose& solved)
{
	const CameraPose pose = solved.pose;
	const int half = greys.half;
	solved = { pose, {}, {}, {}, {} };
	for (PosePoint p : points)
	{
		const bool given = p.placed != Placed::NOWHERE;
		Point at;
		const bool inside = SeenAt(camera, pose, p.world, at) && at[0] >= 0 && at[1] >= 0 && at[0] <= camera.width - 1 && at[1] <= camera.height - 1;
		const cv::Mat& grey = greys.For(BlurAt(camera, pose, unit_mm, p.world));
		// Predicted by the camera: half of what a click may be off. A pixel that is given stays where its owner meant it.
		const bool near = inside && (!given || std::hypot(at[0] - p.u, at[1] - p.v) <= half);
		const bool is_done = p.placed == Placed::MEASURED && &grey == &greys.sharp;
		if (is_done || (near && Measure(grey, at, half, 0.5 * half, given ? Placed::MEASURED : Placed::FOUND, p)) || given)
			solved.points.push_back(p);
		else
			(inside ? solved.missing : solved.outside).push_back(p.line);
	}
}

/// Found points that the fit hardly counts belong to something else; the user's own ones stay, with a warning.
bool LeaveOutStrangers(PhotoPose& solved)
{
	std::vector<PosePoint> kept;
	for (size_t i = 0; i < solved.points.size(); ++i)
	{
		if (solved.points[i].placed == Placed::FOUND && solved.pose.residuals[i].norm() > solved.pose.far_off * solved.points[i].sigma)
			solved.strange.push_back(solved.points[i].line);
		else
			kept.push_back(solved.points[i]);
	}
	const bool any = kept.size() < solved.points.size();
	solved.points = kept;
	return any;
}

/// "8, 16-17, 21".
std::string Ranges(std::vector<int> lines)
{
	std::sort(lines.begin(), lines.end());
	std::string out;
	for (size_t i = 0, j; i < lines.size(); i = j + 1)
	{
		for (j = i; j + 1 < lines.size() && lines[j + 1] == lines[j] + 1; ++j)
			;
		out += fmt::format("{}{}", i ? ", " : "", lines[i]) + (j > i ? fmt::format("-{}", lines[j]) : "");
	}
	return out;
}

}

PhotoPose SolvePoseInPhoto(const StateCamera& camera, const cv::Mat& photo, std::vector<PosePoint> points, int half, const std::string& file, double unit_mm)
{
	NeedSize(camera, photo);
	RefuseOutside(camera, points, file);
	const Greys greys(photo, half);
	PhotoPose solved;
	for (PosePoint& p : points)
		if (p.placed == Placed::GIVEN)
		{
			Measure(greys.sharp, { p.u, p.v }, half, half, Placed::MEASURED, p);
			solved.points.push_back(p);
		}
	solved.pose = SolvePose(camera, solved.points, file);
	// Every round's camera predicts more of them; four clicks and a hundred crossings took three.
	size_t before;
	do
	{
		before = solved.points.size();
		Look(camera, greys, unit_mm, points, solved);
		do
			solved.pose = SolvePose(camera, solved.points, file);
		while (LeaveOutStrangers(solved));
		for (int round = 0; round < WEIGHING_ROUNDS; ++round)
		{
			WeighByBlur(camera, solved.pose, unit_mm, solved.points);
			solved.pose = SolvePose(camera, solved.points, file);
		}
	} while (solved.points.size() > before && solved.points.size() < points.size());
	return solved;
}

std::string PhotoPoseText(const PhotoPose& solved)
{
	std::string text = PoseText(solved.pose, solved.points);
	if (!solved.missing.empty())
		text += fmt::format("no crossing where the camera sees them: lines {}\n", Ranges(solved.missing));
	if (!solved.strange.empty())
		text += fmt::format("something else's crossing, hidden perhaps: lines {}\n", Ranges(solved.strange));
	if (!solved.outside.empty())
		text += fmt::format("outside the picture: lines {}\n", Ranges(solved.outside));
	return text;
}

cv::Mat DrawPosePoints(const cv::Mat& photo, const PhotoPose& solved)
{
	const cv::Scalar GIVEN(60, 190, 255), MEASURED(80, 220, 80), FOUND(255, 200, 60), ERROR(255, 80, 255);
	const int SHIFT = 4;   // sub-pixel bits of OpenCV's drawing
	const auto fixed = [](double x, double y) { return cv::Point(static_cast<int>(std::lround(x * 16)), static_cast<int>(std::lround(y * 16))); };
	cv::Mat canvas;
	cv::cvtColor(ToDisplay(Luminance(photo)), canvas, cv::COLOR_GRAY2BGR);
	canvas.convertTo(canvas, CV_8UC3, 0.6, 40);
	for (size_t i = 0; i < solved.points.size(); ++i)
	{
		const PosePoint& p = solved.points[i];
		const Eigen::Vector2d& off = solved.pose.residuals[i];
		cv::line(canvas, fixed(p.u, p.v), fixed(p.u + 20 * off.x(), p.v + 20 * off.y()), ERROR, 2, cv::LINE_AA, SHIFT);
		cv::circle(canvas, fixed(p.u, p.v), 8 * 16, p.placed == Placed::GIVEN ? GIVEN : p.placed == Placed::MEASURED ? MEASURED : FOUND, 2, cv::LINE_AA, SHIFT);
	}
	const char* const words[] = { "given", "measured near the given pixel", "found", "20 x the way to where the camera sees it" };
	const cv::Scalar colours[] = { GIVEN, MEASURED, FOUND, ERROR };
	cv::Mat strip(40, canvas.cols, CV_8UC3, cv::Scalar(30, 30, 30));
	for (int k = 0, x = 12; k < 4; ++k)
	{
		cv::putText(strip, words[k], { x, 26 }, cv::FONT_HERSHEY_SIMPLEX, 0.55, colours[k], 1, cv::LINE_AA);
		x += cv::getTextSize(words[k], cv::FONT_HERSHEY_SIMPLEX, 0.55, 1, nullptr).width + 30;
	}
	cv::vconcat(canvas, strip, canvas);
	return canvas;
}

}
