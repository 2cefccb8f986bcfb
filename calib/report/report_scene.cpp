// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/report_scene.h"

#include "base/plain_text.h"
#include "lens/angles.h"
#include "model/focus_words.h"
#include "report/html.h"
#include "report/page_view.h"

#include "lens/optics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace tiltcal
{

namespace
{

const double WIDTH = 1160;
const char* const FOCUS_LINE = "stroke=\"#1565c0\" stroke-width=\"2.5\" fill=\"none\"";
const char* const FRUSTUM = "stroke=\"#999\" stroke-width=\"1\" fill=\"#999\" fill-opacity=\"0.05\"";
const char* const AXIS = "stroke=\"#555\" stroke-width=\"1\" stroke-dasharray=\"8 3 2 3\"";
const char* const THIN_BLUE = "stroke=\"#1565c0\" stroke-width=\"1\" stroke-dasharray=\"5 4\"";
const char* const LENS = "stroke=\"#c2185b\" stroke-width=\"3\" stroke-linecap=\"round\"";
const char* const LENS_PLANE = "stroke=\"#c2185b\" stroke-width=\"1\" stroke-dasharray=\"2 3\"";
const char* const SENSOR = "stroke=\"#222\" stroke-width=\"3\"";
const char* const SENSOR_PLANE = "stroke=\"#222\" stroke-width=\"1\" stroke-dasharray=\"2 3\"";
const Vec3<double> ORIGIN{ 0, 0, 0 }, AHEAD{ 0, 0, 1 };

class Sketch
{
public:
	Sketch(const Calibration& calibration, size_t s) : c(calibration), state(s), lens(calibration.solution.states[s]), scene(MakeScene(calibration, s)),
		hinge_is_drawn(scene.has_hinge && Length(scene.hinge) < 1.6 * scene.far)
	{
		// With the hinge there is more to show.
		const double tall = hinge_is_drawn ? 420 : 310;
		side = { 30, 50, 520, tall + 220 };
		oblique = { 600, 50, 530, tall };
		camera = { 660, tall + 150, 260, 150 };
		height = tall + 330;
	}

	std::string Svg() const
	{
		return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"sketch\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n",
			WIDTH, height, HtmlText("Camera, boards and surface of focus of " + c.task.states[state].name)) + Side() + FromAbove() + CameraAlone() + "</svg>\n";
	}

private:
	/// What has to be on the page.
	Polygon Extent() const
	{
		Polygon all{ ORIGIN, -1.3 * scene.w * AHEAD };
		for (const Vec3<double>& corner : scene.corner_rays)
			all.push_back(scene.far * corner);
		for (const BoardPart& board : scene.boards)
			all.insert(all.end(), board.outline.begin(), board.outline.end());
		for (const Polygon& part : scene.focus)
			all.insert(all.end(), part.begin(), part.end());
		return all;
	}

	/// End of the line from the sensor's axis along the sensor plane to Scheimpflug's line.
	double ScheimpflugHeight() const { return Dot(scene.lens_normal, AHEAD) * scene.w / Dot(scene.lens_normal, scene.tilt_up); }

	std::string Frustum(const PageView& view) const
	{
		std::string out;
		for (size_t k = 0; k < 4; ++k)
			out += svg::Path(view, { ORIGIN, scene.far * scene.corner_rays[k], scene.far * scene.corner_rays[(k + 1) % 4] }, true, FRUSTUM);
		return out;
	}

	std::string Sharp(const PageView& view, size_t p) const
	{
		std::string d;
		for (const auto& segment : scene.boards[p].sharp)
		{
			const SketchPoint a = view(segment[0]), b = view(segment[1]);
			d += fmt::format("M{:.1f} {:.1f}L{:.1f} {:.1f}", a.x, a.y, b.x, b.y);
		}
		return d.empty() ? "" : fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"3.5\" stroke-linecap=\"round\"/>\n", d, html::PhotoColour(p));
	}

	std::string Outline(const PageView& view, size_t p, double opacity) const
	{
		return svg::Path(view, scene.boards[p].outline, true, fmt::format("stroke=\"{0}\" stroke-width=\"1.3\" fill=\"{0}\" fill-opacity=\"{1}\"", html::PhotoColour(p), opacity));
	}

	/// Each board's number at one of its corners, those of different boards at different ones.
	std::string BoardNumbers(const PageView& view) const
	{
		std::string out;
		for (size_t p = 0; p < scene.boards.size(); ++p)
		{
			const Polygon& corners = scene.boards[p].outline;
			Vec3<double> centre{ 0, 0, 0 };
			for (const Vec3<double>& P : corners)
				centre = centre + 0.25 * P;
			const SketchPoint at = view(centre + 1.07 * (corners[p % 4] - centre));
			out += svg::Text({ at.x, at.y + 5 }, std::to_string(p + 1), "middle", fmt::format("class=\"number\" fill=\"{}\"", html::PhotoColour(p)));
		}
		return out;
	}

	std::string ScaleBar(const PageView& view, double x, double y) const
	{
		const double mm = html::RoundNumber(120 / view.Scale()), length = mm * view.Scale();
		return fmt::format("<path d=\"M{0:.1f} {1:.1f}v6h{2:.1f}v-6\" fill=\"none\" stroke=\"#222\"/>\n", x, y, length) + svg::Text({ x + length + 6, y + 8 }, fmt::format("{:g} mm", mm));
	}

	std::string FocusName() const { return scene.field_curvature != 0 ? "surface of focus" : "plane of focus"; }

	std::string Side() const
	{
		Polygon extent = Extent();
		const Vec3<double>& up = scene.tilt_up;
		const bool meets = hinge_is_drawn && std::abs(ScheimpflugHeight()) < 2 * scene.far;
		if (hinge_is_drawn)
			extent.push_back(1.03 * scene.hinge);
		if (meets)
			extent.push_back(ScheimpflugHeight() * up - scene.w * AHEAD);
		const PageView view(AHEAD, up, extent, side);
		const SketchPoint origin = view(ORIGIN);
		std::string out = fmt::format("<g class=\"side\" data-px-per-mm=\"{:.6f}\" data-axis-x=\"{:.3f}\" data-axis-y=\"{:.3f}\">\n", view.Scale(), origin.x, origin.y);
		out += svg::Text({ side.x, 24 }, scene.has_hinge ? "Side view, along the hinge line" : "Side view, from the right", "start", "class=\"title\"");
		out += Frustum(view) + svg::Line(view, -1.3 * scene.w * AHEAD, scene.far * AHEAD, AXIS);
		for (size_t p = 0; p < scene.boards.size(); ++p)
			out += Outline(view, p, 0.10);
		out += PlaneFromTheSide(view);
		for (size_t p = 0; p < scene.boards.size(); ++p)
			out += Sharp(view, p);
		out += BoardNumbers(view);
		if (meets)
			out += Scheimpflug(view);
		out += LensAndSensor(view);
		if (hinge_is_drawn)
			out += HingeFromTheSide(view);
		out += DistanceOfFocus(view) + ScaleBar(view, side.x, height - 20);
		return out + "</g>\n";
	}

	/// Dashed: the plane that touches the surface of focus on the lens axis, as far as the hinge. Solid: the surface in the picture.
	std::string PlaneFromTheSide(const PageView& view) const
	{
		std::string out;
		// Heights at which the plane leaves the drawing: the hinge, and the far end of the frustum's middle.
		double from = 0, to = 0;
		for (const Vec3<double>& P : scene.focus_section)
		{
			from = std::min(from, Dot(P, scene.tilt_up));
			to = std::max(to, Dot(P, scene.tilt_up));
		}
		if (hinge_is_drawn)
			(Dot(scene.hinge, scene.tilt_up) < 0 ? from : to) = Dot(scene.hinge, scene.tilt_up);
		if (std::abs(scene.q.z) * scene.far > 0.1 && to > from)
			out += svg::Line(view, OnPlane(from), OnPlane(to), std::string("class=\"plane-trace\" ") + THIN_BLUE);
		for (const Polygon& part : scene.focus)
			out += svg::Path(view, part, true, "fill=\"#1565c0\" fill-opacity=\"0.12\"");
		if (scene.focus_section.size() > 1)
			out += svg::Path(view, scene.focus_section, false, std::string("class=\"focus-trace\" ") + FOCUS_LINE);
		return out;
	}

	std::string Scheimpflug(const PageView& view) const
	{
		const Vec3<double> meet = ScheimpflugHeight() * scene.tilt_up - scene.w * AHEAD;
		const SketchPoint at = view(meet);
		return svg::Line(view, ORIGIN, meet, LENS_PLANE) + svg::Line(view, -scene.w * AHEAD, meet, SENSOR_PLANE)
			+ svg::Line(view, scene.hinge, meet, THIN_BLUE) + svg::Line(view, ORIGIN, scene.hinge, "stroke=\"#999\" stroke-width=\"1\"")
			+ fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\" fill=\"#222\"/>\n", at.x, at.y)
			+ svg::Text({ at.x + 9, at.y + (ScheimpflugHeight() < 0 ? 14 : -6) }, "lens, sensor and plane of focus meet (Scheimpflug)");
	}

	std::string LensAndSensor(const PageView& view) const
	{
		const Vec3<double>& n = scene.lens_normal;
		const Vec3<double> rim = (scene.d / 2) * tilt_lens::Normalized(Dot(n, AHEAD) * scene.tilt_up - Dot(n, scene.tilt_up) * AHEAD);
		double low = 0, high = 0;
		for (const Vec3<double>& corner : scene.corner_rays)
		{
			low = std::min(low, -scene.w * Dot(corner, scene.tilt_up));
			high = std::max(high, -scene.w * Dot(corner, scene.tilt_up));
		}
		return svg::Line(view, low * scene.tilt_up - scene.w * AHEAD, high * scene.tilt_up - scene.w * AHEAD, SENSOR)
			+ svg::Line(view, -1.0 * rim, rim, LENS);
	}

	std::string HingeText() const { return "hinge, " + html::Number(Length(scene.hinge), 1) + " mm from the lens"; }

	std::string HingeFromTheSide(const PageView& view) const
	{
		const SketchPoint at = view(scene.hinge);
		return fmt::format("<circle class=\"hinge\" cx=\"{:.3f}\" cy=\"{:.3f}\" r=\"5\" fill=\"#fff\" stroke=\"#1565c0\" stroke-width=\"2.5\"/>\n", at.x, at.y)
			+ svg::Text({ at.x + 14, at.y + 4 }, HingeText(), "start", "class=\"strong\"");
	}

	/// U along the axis, and the angle of the plane.
	std::string DistanceOfFocus(const PageView& view) const
	{
		const double U = lens.focus_distance.value;
		const std::string tilt = scene.has_hinge ? "plane of focus, " + html::Number(std::abs(lens.focal_plane_tilt.value), 1) + "° to the sensor"
			: "plane of focus, " + FocusInShort(InverseFocus(lens)).value_or("parallel to the sensor");
		const bool below = hinge_is_drawn && Dot(scene.hinge, scene.tilt_up) < 0;
		std::string out;
		if (std::isfinite(U) && U > 0 && U < scene.far)
		{
			const SketchPoint at = view(U * AHEAD), origin = view(ORIGIN);
			out += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.5\" fill=\"#1565c0\"/>\n", at.x, at.y)
				+ svg::Text({ origin.x + 0.45 * (at.x - origin.x), at.y - 7 }, "U = " + html::Number(U, 1) + " mm", "middle", "class=\"strong\"");
		}
		// In the corner that the plane leaves free.
		const double y = !hinge_is_drawn || below ? side.y + 2 : side.y + side.height - 8;
		out += svg::Text({ side.x, y }, tilt, "start", "class=\"strong\" fill=\"#1565c0\"");
		if (scene.has_hinge && !hinge_is_drawn)
			out += svg::Text({ side.x, y + 18 }, HingeText() + " (outside)");
		return out;
	}

	/// From over the camera's shoulder; from ahead of it where that would show the plane of focus edge-on; else from higher up.
	ViewAxes AxesThatShowThePlane() const
	{
		const double degree = tilt_lens::Pi / 180, enough = 0.35;
		// A lens focused at infinity has no plane to show.
		const Vec3<double> m = tilt_lens::MaxAbs(scene.q) > 0 ? tilt_lens::Normalized(scene.q) : AHEAD;
		ViewAxes best{};
		double most = -1;
		for (const auto& [azimuth, elevation] : { std::pair{ 38, 24 }, std::pair{ -38, 24 }, std::pair{ 30, 50 }, std::pair{ -30, 50 } })
		{
			const ViewAxes axes = Oblique(azimuth * degree, elevation * degree);
			const double facing = std::abs(Dot(m, Cross(axes.up, axes.right)));
			if (facing > most)
			{
				most = facing;
				best = axes;
			}
			if (facing > enough)
				break;
		}
		return best;
	}

	std::string FromAbove() const
	{
		const ViewAxes axes = AxesThatShowThePlane();
		Polygon extent = Extent();
		if (hinge_is_drawn)
			for (const auto& line : PlaneFromHinge())
				extent.insert(extent.end(), line.begin(), line.end());
		const PageView view(axes.right, axes.up, extent, oblique);
		std::string out = "<g class=\"oblique\">\n" + svg::Text({ oblique.x, 24 }, view.Nearness(AHEAD) > 0 ? "From above, beside and ahead of the camera" : "From above, beside and behind the camera", "start", "class=\"title\"");
		out += Frustum(view) + svg::Line(view, -1.3 * scene.w * AHEAD, scene.far * AHEAD, AXIS);
		if (hinge_is_drawn)
			out += HingeFromAbove(view);
		out += Sorted(view);
		for (size_t p = 0; p < scene.boards.size(); ++p)
			out += Sharp(view, p);
		out += BoardNumbers(view) + Disc(view);
		const SketchPoint eye = view(ORIGIN);
		out += svg::Text({ eye.x - 4, eye.y + 34 }, "camera", "middle") + ScaleBar(view, oblique.x, oblique.y + oblique.height + 16);
		out += svg::Text({ oblique.x + oblique.width, oblique.y + oblique.height + 24 }, "bold: where a board meets the " + FocusName(), "end");
		return out + "</g>\n";
	}

	/// Point of the plane of focus (of the bowl: the plane that touches it) at the height h along tilt_up, beside the hinge's middle.
	Vec3<double> OnPlane(double h) const { return h * scene.tilt_up + ((1 - Dot(scene.q, scene.tilt_up) * h) / scene.q.z) * AHEAD; }

	/// The hinge line, and from its ends two lines in the plane of focus to where the picture begins to show it.
	std::vector<std::array<Vec3<double>, 2>> PlaneFromHinge() const
	{
		const Vec3<double> along{ scene.tilt_up.y, -scene.tilt_up.x, 0 };
		const double reach = 0.5 * Length(scene.corner_rays[0] - scene.corner_rays[2]) * scene.far / 2;
		const Vec3<double> a = scene.hinge - reach * along, b = scene.hinge + reach * along;
		std::vector<std::array<Vec3<double>, 2>> lines{ { a, b } };
		if (scene.focus_section.empty() || std::abs(scene.q.z) * scene.far < 0.1)
			return lines;
		const bool below = Dot(scene.hinge, scene.tilt_up) < 0;
		const Vec3<double>& nearest = below ? scene.focus_section.front() : scene.focus_section.back();
		const Vec3<double> begin = OnPlane(Dot(nearest, scene.tilt_up));
		lines.push_back({ a, begin - reach * along });
		lines.push_back({ b, begin + reach * along });
		return lines;
	}

	std::string HingeFromAbove(const PageView& view) const
	{
		std::string out;
		const auto lines = PlaneFromHinge();
		for (size_t k = 0; k < lines.size(); ++k)
			out += svg::Line(view, lines[k][0], lines[k][1], k == 0 ? "stroke=\"#1565c0\" stroke-width=\"2.5\"" : THIN_BLUE);
		const Vec3<double>& end = view(lines[0][0]).x > view(lines[0][1]).x ? lines[0][0] : lines[0][1];
		return out + svg::Text({ view(end).x + 8, view(end).y + 5 }, "hinge line", "start", "class=\"strong\"");
	}

	/// Boards and the surface of focus, the farthest from the viewer first.
	std::string Sorted(const PageView& view) const
	{
		std::vector<std::pair<double, std::string>> parts;
		const auto nearness = [&](const Polygon& polygon)
		{
			double sum = 0;
			for (const Vec3<double>& P : polygon)
				sum += view.Nearness(P);
			return sum / double(polygon.size());
		};
		for (const Polygon& part : scene.focus)
			parts.emplace_back(nearness(part), svg::Path(view, part, true, "fill=\"#1565c0\" fill-opacity=\"0.22\" stroke=\"#1565c0\" stroke-width=\"0.6\""));
		for (size_t p = 0; p < scene.boards.size(); ++p)
			parts.emplace_back(nearness(scene.boards[p].outline), Outline(view, p, 0.16));
		std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
		std::string out;
		for (const auto& part : parts)
			out += part.second;
		return out;
	}

	std::string Disc(const PageView& view) const
	{
		const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(scene.lens_normal);
		Polygon rim, sensor;
		for (int k = 0; k < 48; ++k)
		{
			const double a = 2 * tilt_lens::Pi * k / 48;
			rim.push_back(scene.d / 2 * (std::cos(a) * basis.a + std::sin(a) * basis.b));
		}
		for (const Vec3<double>& corner : scene.corner_rays)
			sensor.push_back(-scene.w * corner);
		return svg::Path(view, sensor, true, "fill=\"#bbb\" stroke=\"#222\" stroke-width=\"1.5\"") + svg::Path(view, rim, true, "fill=\"#f8bbd0\" stroke=\"#c2185b\" stroke-width=\"1.5\"");
	}

	/// Sensor and lens from the side, large enough to see the tilt.
	std::string CameraAlone() const
	{
		const Vec3<double>&up = scene.tilt_up, &n = scene.lens_normal;
		Polygon extent{ 0.5 * scene.w * AHEAD, -1.1 * scene.w * AHEAD };
		for (const Vec3<double>& corner : scene.corner_rays)
			extent.push_back(-scene.w * corner);
		const PageView view(AHEAD, up, extent, camera);
		const Vec3<double> in_lens = tilt_lens::Normalized(Dot(n, AHEAD) * up - Dot(n, up) * AHEAD);
		const double reach = 0.5 * camera.height / view.Scale();
		std::string out = "<g class=\"camera\">\n" + svg::Text({ oblique.x, camera.y - 18 }, "The camera alone, from the same side", "start", "class=\"title\"");
		out += svg::Line(view, -1.1 * scene.w * AHEAD, 0.5 * scene.w * AHEAD, AXIS);
		out += svg::Line(view, -reach * up, reach * up, SENSOR_PLANE) + svg::Line(view, -reach * in_lens, reach * in_lens, LENS_PLANE);
		if (scene.has_hinge)
			out += svg::Line(view, ORIGIN, 0.5 * scene.w * n, LENS_PLANE);
		out += LensAndSensor(view);
		const SketchPoint lens_at = view(ORIGIN), sensor_at = view(-scene.w * AHEAD), axis_end = view(0.5 * scene.w * AHEAD);
		out += svg::Text({ (lens_at.x + sensor_at.x) / 2, lens_at.y - 7 }, "w = " + html::Number(scene.w, 2) + " mm", "middle", "class=\"strong\"");
		out += svg::Text({ sensor_at.x - 8, sensor_at.y - 7 }, "sensor", "end");
		out += svg::Text({ axis_end.x + 12, axis_end.y - 34 }, "d = " + html::Number(scene.d, 2) + " mm", "start", "class=\"strong\"");
		out += svg::Text({ axis_end.x + 12, axis_end.y + 4 }, scene.has_hinge ? "lens tilted by " + html::Number(lens.lens_tilt.value, 2) + "°" : "lens not tilted", "start", "class=\"strong\" fill=\"#c2185b\"");
		if (scene.has_hinge)
			out += svg::Text({ axis_end.x + 12, axis_end.y + 24 }, "towards " + html::Number(lens.tilt_direction.value, 1) + "° (0 up, 90 right)");
		return out + "</g>\n";
	}

	const Calibration& c;
	const size_t state;
	const StateLens& lens;
	const SceneParts scene;
	const bool hinge_is_drawn;
	PageBox side, oblique, camera;   ///< the three views
	double height = 0;
};

}

std::string SceneSvg(const Calibration& calibration, size_t state) { return Sketch(calibration, state).Svg(); }

}
