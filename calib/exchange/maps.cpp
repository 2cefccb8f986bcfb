// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/maps.h"

#include "exchange/write_exr.h"
#include "lens/field_curvature.h"

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

/// `map`: where in `from` each pixel is.
void WriteStMap(const cv::Mat& map, const StateCamera& from, const std::string& file, const std::map<std::string, std::string>& notes, FileSet& set)
{
	const std::map<std::string, cv::Mat> channels{ { "R", cv::Mat(map.size(), CV_32FC1) }, { "G", cv::Mat(map.size(), CV_32FC1) },
		{ "B", cv::Mat::zeros(map.size(), CV_32FC1) } };
	cv::Mat R = channels.at("R"), G = channels.at("G");
	for (int y = 0; y < map.rows; ++y)
		for (int x = 0; x < map.cols; ++x)
		{
			const cv::Vec2f place = map.at<cv::Vec2f>(y, x);
			const bool nowhere = std::isnan(place[0]);
			R.at<float>(y, x) = nowhere ? -1 : float((double(place[0]) + 0.5) / from.width);
			G.at<float>(y, x) = nowhere ? -1 : float(1 - (double(place[1]) + 0.5) / from.height);
		}
	set.Write(file, [&](const std::string& temporary) { return WriteExr(temporary, channels, notes); });
}

}

double WriteStMaps(const StateCamera& camera, const Margins& margins, const std::string& stem, FileSet& set)
{
	const StateCamera flat = FlatView(camera, margins);
	std::map<std::string, std::string> notes{ { "tiltcal_state", camera.state }, { "tiltcal_photograph", fmt::format("{} x {}", camera.width, camera.height) },
		{ "tiltcal_undistorted", fmt::format("{} x {}", flat.width, flat.height) } };
	notes["comments"] = "STMap of tiltcal: (R, G) are 0 to 1 from the left and bottom edge of the photograph; -1 is outside";
	WriteStMap(PixelMap(flat, camera), camera, stem + "-undistort.exr", notes, set);
	notes["comments"] = "STMap of tiltcal: (R, G) are 0 to 1 from the left and bottom edge of the undistorted picture; -1 is outside";
	const cv::Mat redistort = PixelMap(camera, flat);
	WriteStMap(redistort, flat, stem + "-redistort.exr", notes, set);
	return SharePictured(redistort, flat);
}

double FocusDepth(const StateCamera& camera, const Vec3<double>& v)
{
	return v.z / tilt_lens::InverseFocusDistanceOnBowl(camera.PlaneOfFocus(), camera.field_curvature_per_mm, camera.LensNormal(), v);
}

void WriteRayMap(const StateCamera& camera, const std::string& file, FileSet& set)
{
	std::map<std::string, cv::Mat> channels;
	std::vector<std::string> names{ "ray.X", "ray.Y", "ray.Z" };
	if (camera.KnowsFocus())
		names.push_back("focus.Z");
	for (const std::string& name : names)
		channels[name] = cv::Mat(camera.height, camera.width, CV_32FC1);
	cv::Mat x = channels["ray.X"], y = channels["ray.Y"], z = channels["ray.Z"], focus = camera.KnowsFocus() ? channels["focus.Z"] : cv::Mat();
	cv::parallel_for_({ 0, camera.height }, [&](const cv::Range& rows)
	{
		for (int j = rows.start; j < rows.end; ++j)
			for (int i = 0; i < camera.width; ++i)
			{
				const double nan = std::numeric_limits<double>::quiet_NaN();
				const Vec3<double> v = Unproject(camera, { double(i), double(j) }).value_or(Vec3<double>{ nan, nan, nan });
				const double length = std::sqrt(Dot(v, v));
				x.at<float>(j, i) = float(v.x / length);
				y.at<float>(j, i) = float(v.y / length);
				z.at<float>(j, i) = float(v.z / length);
				if (!focus.empty())
					focus.at<float>(j, i) = float(FocusDepth(camera, v));
			}
	});
	set.Write(file, [&](const std::string& temporary)
	{
		return WriteExr(temporary, channels, { { "tiltcal_state", camera.state },
			{ "comments", "ray: unit direction, x right, y up, z forward; focus.Z: depth of what is in focus on it, mm; NaN where the distortion has no inverse" } });
	});
}

}
