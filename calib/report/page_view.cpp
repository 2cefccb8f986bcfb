// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/page_view.h"

#include "base/plain_text.h"
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

PageView::PageView(const Vec3<double>& right_axis, const Vec3<double>& up_axis, const Polygon& points, const PageBox& box) :
	right(right_axis), up(up_axis), towards_viewer(Cross(up_axis, right_axis))
{
	const double infinity = std::numeric_limits<double>::infinity();
	double left = infinity, most_right = -infinity, low = infinity, high = -infinity;
	for (const Vec3<double>& P : points)
	{
		left = std::min(left, Dot(P, right));
		most_right = std::max(most_right, Dot(P, right));
		low = std::min(low, Dot(P, up));
		high = std::max(high, Dot(P, up));
	}
	scale = std::min(box.width / std::max(most_right - left, 1e-9), box.height / std::max(high - low, 1e-9));
	x0 = box.x + box.width / 2 - scale * (left + most_right) / 2;
	y0 = box.y + box.height / 2 + scale * (low + high) / 2;
}

SketchPoint PageView::operator()(const Vec3<double>& P) const
{
	return { x0 + scale * Dot(P, right), y0 - scale * Dot(P, up) };
}

ViewAxes Oblique(double azimuth, double elevation)
{
	const double sa = std::sin(azimuth), ca = std::cos(azimuth), se = std::sin(elevation), ce = std::cos(elevation);
	return { { sa, 0, ca }, { -se * ca, ce, se * sa } };
}

namespace svg
{

std::string Path(const PageView& view, const Polygon& points, bool closed, const std::string& style)
{
	std::string d;
	for (const Vec3<double>& P : points)
	{
		const SketchPoint at = view(P);
		d += fmt::format("{}{:.2f} {:.2f}", d.empty() ? 'M' : 'L', at.x, at.y);
	}
	return fmt::format("<path d=\"{}{}\" {}/>\n", d, closed ? "Z" : "", style);
}

std::string Line(const PageView& view, const Vec3<double>& a, const Vec3<double>& b, const std::string& style)
{
	const SketchPoint from = view(a), to = view(b);
	return fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" {}/>\n", from.x, from.y, to.x, to.y, style);
}

std::string Text(const SketchPoint& at, const std::string& text, const std::string& anchor, const std::string& style)
{
	return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" {}>{}</text>\n", at.x, at.y, anchor, style, HtmlText(text));
}

}

}
