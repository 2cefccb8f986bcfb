// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/flat_view.h"

#include <tiltcal/error.h>
#include "base/numbers.h"

#include <fmt/format.h>
#include <opencv2/core/utility.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace tiltcal
{

namespace
{

/// Where `from` sees what `to` sees at a pixel; NaN where that is nowhere, or nothing.
cv::Vec2f PlaceOf(const StateCamera& to, const StateCamera& from, const Point& pixel)
{
	const std::optional<Vec3<double>> seen = Unproject(to, pixel);
	const std::optional<Point> place = seen ? Project(from, *seen) : std::nullopt;
	const float nan = std::numeric_limits<float>::quiet_NaN();
	return place ? cv::Vec2f{ float((*place)[0]), float((*place)[1]) } : cv::Vec2f{ nan, nan };
}

/// Every pixel of the picture's rim.
template<typename Visit>
void ForRim(const StateCamera& c, Visit visit)
{
	for (int x = 0; x < c.width; ++x)
		for (const int y : { 0, c.height - 1 })
			visit(Point{ double(x), double(y) });
	for (int y = 0; y < c.height; ++y)
		for (const int x : { 0, c.width - 1 })
			visit(Point{ double(x), double(y) });
}

}

StateCamera FlatView(const StateCamera& camera, const Margins& margins)
{
	StateCamera flat = camera;
	flat.distortion = {};
	flat.width += 2 * margins.x;
	flat.height += 2 * margins.y;
	flat.principal_point = { camera.principal_point[0] + margins.x, camera.principal_point[1] + margins.y };
	return flat;
}

Margins MarginsOfAll(const StateCamera& camera)
{
	const StateCamera flat = FlatView(camera, {});
	double beyond_x = 0, beyond_y = 0;
	ForRim(camera, [&](const Point& pixel)
	{
		const cv::Vec2f place = PlaceOf(camera, flat, pixel);
		const double x = std::max<double>(-place[0], place[0] - (camera.width - 1)), y = std::max<double>(-place[1], place[1] - (camera.height - 1));
		if (!(x < camera.width && y < camera.height))
			throw Refused(fmt::format("state {}: the distortion cannot be undone at the picture's edge, pixel ({:.0f}, {:.0f}); give --overscan in percent",
				camera.state, pixel[0], pixel[1]));
		beyond_x = std::max(beyond_x, x);
		beyond_y = std::max(beyond_y, y);
	});
	return { int(std::ceil(beyond_x)), int(std::ceil(beyond_y)) };
}

Margins ParseOverscan(const std::string& text, const StateCamera& camera)
{
	if (text == "auto")
		return MarginsOfAll(camera);
	const std::optional<double> percent = FiniteNumber(text);
	if (!percent || *percent < 0 || *percent > 100)
		throw UsageError(fmt::format("--overscan {}: give percent of the picture on each side, 0 to 100, or auto", text));
	return { int(std::ceil(*percent / 100 * camera.width)), int(std::ceil(*percent / 100 * camera.height)) };
}

double SharePictured(const StateCamera& camera, const Margins& margins)
{
	const StateCamera flat = FlatView(camera, margins);
	return SharePictured(PixelMap(camera, flat), flat);
}

double SharePictured(const cv::Mat& map, const StateCamera& flat)
{
	long shown = 0;
	for (int y = 0; y < map.rows; ++y)
		for (int x = 0; x < map.cols; ++x)
		{
			const cv::Vec2f place = map.at<cv::Vec2f>(y, x);
			shown += place[0] >= -0.5f && place[0] <= float(flat.width) - 0.5f && place[1] >= -0.5f && place[1] <= float(flat.height) - 0.5f;
		}
	return double(shown) / double(map.total());
}

cv::Mat PixelMap(const StateCamera& to, const StateCamera& from)
{
	cv::Mat map(to.height, to.width, CV_32FC2);
	cv::parallel_for_({ 0, to.height }, [&](const cv::Range& rows)
	{
		for (int y = rows.start; y < rows.end; ++y)
			for (int x = 0; x < to.width; ++x)
				map.at<cv::Vec2f>(y, x) = PlaceOf(to, from, { double(x), double(y) });
	});
	return map;
}

}
