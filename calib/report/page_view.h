// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From the camera frame to a drawing: an orthographic projector and a few SVG elements.

#ifndef TILTCAL_PAGE_VIEW_H
#define TILTCAL_PAGE_VIEW_H

#include "report/scene_parts.h"

#include <string>

namespace tiltcal
{

struct SketchPoint
{
	double x = 0, y = 0;   ///< SVG user units, y down
};

struct PageBox
{
	double x = 0, y = 0, width = 0, height = 0;
};

/// Orthographic: `right` and `up` are the page's axes, unit vectors of the camera frame.
class PageView
{
public:
	/// The largest scale at which all of `points` lie in `box`, centred.
	PageView(const Vec3<double>& right, const Vec3<double>& up, const Polygon& points, const PageBox& box);

	SketchPoint operator()(const Vec3<double>& P) const;
	double Scale() const { return scale; }   ///< user units to a mm
	/// How far towards the viewer P is, mm.
	double Nearness(const Vec3<double>& P) const { return Dot(P, towards_viewer); }

private:
	Vec3<double> right, up, towards_viewer;
	double scale = 1, x0 = 0, y0 = 0;
};

/// The axes of a view from beside the lens, `azimuth` radians back behind it and `elevation` up, so that z goes right.
struct ViewAxes
{
	Vec3<double> right, up;
};
ViewAxes Oblique(double azimuth, double elevation);

namespace svg
{

/// `style` is attributes, such as "fill=\"none\" stroke=\"#888\"".
std::string Path(const PageView& view, const Polygon& points, bool closed, const std::string& style);
std::string Line(const PageView& view, const Vec3<double>& a, const Vec3<double>& b, const std::string& style);
/// With a white rim, so that it can be read on lines. `anchor`: start, middle or end. `text` is escaped here.
std::string Text(const SketchPoint& at, const std::string& text, const std::string& anchor = "start", const std::string& style = "");

}

}

#endif
