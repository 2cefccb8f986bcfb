// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/report_maps.h"

#include "base/plain_text.h"
#include "model/predict.h"
#include <tiltcal/calibrate.h>
#include "effects/effects.h"
#include "model/footprint.h"
#include "report/html.h"
#include "report/overlay.h"
#include "solve/solve_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace tiltcal
{

namespace
{

const double WIDTH = 570;

std::string Open(double height, const std::string& label)
{
	return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"map\" viewBox=\"0 0 {} {:.0f}\" role=\"img\" aria-label=\"{}\">\n", WIDTH, height, HtmlText(label));
}

std::string Text(double x, double y, const std::string& text, const char* anchor = "start")
{
	return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, HtmlText(text));
}

/// The value below which `share` of them lie; 0 of none.
double Quantile(std::vector<double> values, double share)
{
	if (values.empty())
		return 0;
	const size_t k = std::min(values.size() - 1, static_cast<size_t>(share * double(values.size())));
	std::nth_element(values.begin(), values.begin() + long(k), values.end());
	return values[k];
}

/// Round, and no smaller than x; 0.1 for nothing at all.
double RoundAbove(double x)
{
	if (!(x > 1e-9))
		return 0.1;
	const double below = html::RoundNumber(x);
	return below >= x ? below : html::RoundNumber(2.51 * below) >= x ? html::RoundNumber(2.51 * below) : html::RoundNumber(5.01 * below);
}

/// A plot area with axes: data to page.
struct Axes
{
	double x, y, width, height;   // page, y of the upper end
	double x_most, y_least, y_most;

	double PageX(double value) const { return x + width * value / x_most; }
	double PageY(double value) const { return y + height * (y_most - value) / (y_most - y_least); }

	/// Frame, grid and numbers.
	std::string Draw(double x_step, double y_step, bool x_numbers) const
	{
		std::string out, grid;
		for (double v = 0; v <= x_most * 1.0001; v += x_step)
		{
			grid += fmt::format("M{:.1f} {:.1f}v{:.1f}", PageX(v), y, height);
			if (x_numbers)
				out += Text(PageX(v), y + height + 16, fmt::format("{:g}", v), "middle");
		}
		for (double v = std::ceil(y_least / y_step) * y_step; v <= y_most * 1.0001; v += y_step)
		{
			grid += fmt::format("M{:.1f} {:.1f}h{:.1f}", x, PageY(v), width);
			out += Text(x - 6, PageY(v) + 4, fmt::format("{:g}", std::abs(v) < 1e-9 ? 0 : v), "end");
		}
		return fmt::format("<path d=\"{}\" stroke=\"#ddd\" fill=\"none\"/>\n", grid) + out;
	}
};

/// Dots of one colour in one path.
std::string Dots(const std::string& path, const std::string& colour)
{
	return path.empty() ? "" : fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"3.4\" stroke-linecap=\"round\" stroke-opacity=\"0.75\" fill=\"none\"/>\n", path, colour);
}

/// The picture's frame on the page.
struct Frame
{
	double scale, height;

	explicit Frame(const Task& task) : scale((WIDTH - 2) / task.width), height(scale * task.height) {}
	double X(double u) const { return 1 + scale * (u + 0.5); }
	double Y(double v) const { return 1 + scale * (v + 0.5); }
	std::string Draw() const
	{
		return fmt::format("<rect x=\"1\" y=\"1\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#fafafa\" stroke=\"#888\"/>\n", WIDTH - 2, height);
	}
	std::string PrincipalPoint(const Point& at) const
	{
		return fmt::format("<path d=\"M{:.1f} {:.1f}h16m-8-8v16\" stroke=\"#000\" fill=\"none\"/>\n", X(at[0]) - 8, Y(at[1]));
	}
};

/// t from -1 (blue) over 0 (light grey) to 1 (red): distinguishable to the colour-blind too.
std::string SignedColour(double t)
{
	const double a = std::min(1.0, std::abs(t));
	const auto mix = [&](double grey, double full) { return static_cast<int>(std::lround(grey + (full - grey) * a)); };
	return t < 0 ? fmt::format("#{:02x}{:02x}{:02x}", mix(215, 10), mix(215, 60), mix(215, 190)) : fmt::format("#{:02x}{:02x}{:02x}", mix(215, 200), mix(215, 20), mix(215, 20));
}

}

std::string BlurPlot(const Calibration& c, size_t s)
{
	const std::vector<Photo>& photos = c.task.states[s].photos;
	struct Pair
	{
		double predicted, measured;
	};
	std::vector<std::vector<Pair>> pairs(photos.size());
	std::vector<double> differences;
	double most = 1;
	for (size_t p = 0; p < photos.size(); ++p)
		for (const Edge& e : photos[p].edges)
		{
			const Pair pair{ PredictedBlur(c, s, p, e), e.blur };
			if (!std::isfinite(pair.predicted) || !std::isfinite(pair.measured))
				continue;
			pairs[p].push_back(pair);
			differences.push_back(std::abs(pair.measured - pair.predicted));
			most = std::max({ most, pair.predicted, pair.measured });
		}
	const double step = html::RoundNumber(most / 4), range = RoundAbove(Quantile(differences, 0.99));
	const Axes above{ 48, 8, WIDTH - 60, 300, 1.02 * most, 0, 1.02 * most }, below{ 48, 340, WIDTH - 60, 130, 1.02 * most, -range, range };
	std::string out = Open(520, "Blur, measured and predicted") + above.Draw(step, step, false) + below.Draw(step, range / 2, true);
	out += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}M{:.1f} {:.1f}h{:.1f}\" stroke=\"#777\" fill=\"none\"/>\n", above.PageX(0), above.PageY(0), above.PageX(above.x_most), above.PageY(above.y_most),
		below.x, below.PageY(0), below.width);
	int beyond = 0;
	for (size_t p = 0; p < photos.size(); ++p)
	{
		std::string upper, lower;
		for (const Pair& pair : pairs[p])
		{
			upper += fmt::format("M{:.1f} {:.1f}h0", above.PageX(pair.predicted), above.PageY(pair.measured));
			const double difference = pair.measured - pair.predicted;
			beyond += std::abs(difference) > range;
			lower += fmt::format("M{:.1f} {:.1f}h0", below.PageX(pair.predicted), below.PageY(std::clamp(difference, -range, range)));
		}
		out += Dots(upper, html::PhotoColour(p)) + Dots(lower, html::PhotoColour(p));
	}
	out += Text(56, 24, "measured blur, px") + Text(56, 332, "measured − predicted, px") + Text(WIDTH - 12, 508, "predicted blur, px", "end");
	if (beyond)
		out += Text(56, 508, fmt::format("{} of {} edges beyond the lower plot, drawn at its rim", beyond, differences.size()));
	return out + "</svg>\n";
}

std::string FalloffPlot(const Calibration& c, size_t s)
{
	std::string measured, model;
	double angle = 1, least = 1, most = 1;
	const std::vector<FalloffPoint>& points = FalloffOf(c).points;
	for (const FalloffPoint& p : points)
	{
		angle = p.state == s ? std::max(angle, p.angle_deg) : angle;
		least = p.state == s ? std::min({ least, p.measured, p.model }) : least;
		most = p.state == s ? std::max({ most, p.measured, p.model }) : most;
	}
	const Axes axes{ 48, 26, WIDTH - 60, 230, 1.03 * angle, 100 * std::max(0.0, least - 0.03), 100 * (most + 0.03) };
	for (const FalloffPoint& p : points)
		if (p.state == s)
		{
			measured += fmt::format("M{:.1f} {:.1f}h0", axes.PageX(p.angle_deg), axes.PageY(100 * p.measured));
			// A ring, so that a dot in it is a patch that fits.
			model += fmt::format("M{:.1f} {:.1f}a3.2 3.2 0 1 0 6.4 0a3.2 3.2 0 1 0 -6.4 0", axes.PageX(p.angle_deg) - 3.2, axes.PageY(100 * p.model));
		}
	if (measured.empty())
		return "";
	return Open(300, "Fall-off of the light") + axes.Draw(html::RoundNumber(angle / 4), html::RoundNumber((axes.y_most - axes.y_least) / 4), true)
		+ fmt::format("<path d=\"{}\" stroke=\"#222\" stroke-width=\"0.8\" fill=\"none\"/>\n", model) + Dots(measured, "#1565c0")
		+ Text(48, 16, "light left, % of that on the lens axis") + Text(WIDTH - 12, 292, "angle from the lens axis, degrees", "end") + Text(48, 292, "● measured   ○ model") + "</svg>\n";
}

std::string CornerMap(const Calibration& c, size_t s)
{
	const std::vector<Photo>& photos = c.task.states[s].photos;
	const Frame frame(c.task);
	std::vector<std::vector<std::array<double, 4>>> arrows(photos.size());
	std::vector<double> lengths;
	for (size_t p = 0; p < photos.size(); ++p)
		for (const Corner& k : photos[p].corners)
		{
			const Point at = Reproject(c.task, c.MainGeometry(), s, p, k.column, k.row);
			const std::array<double, 4> arrow{ k.x, k.y, at[0] - k.x, at[1] - k.y };
			if (!std::isfinite(arrow[2]) || !std::isfinite(arrow[3]))
				continue;
			arrows[p].push_back(arrow);
			lengths.push_back(std::hypot(arrow[2], arrow[3]));
		}
	// Nine of ten arrows shorter than some 24 units of the drawing.
	const double factor = html::RoundNumber(std::clamp(24 / (frame.scale * std::max(Quantile(lengths, 0.9), 1e-6)), 1.0, 1e5));
	std::string out = Open(frame.height + 26, "Residuals of the corners") + frame.Draw();
	for (size_t p = 0; p < photos.size(); ++p)
	{
		std::string path;
		for (const auto& [u, v, du, dv] : arrows[p])
		{
			const double dx = frame.scale * factor * du, dy = frame.scale * factor * dv;
			// Shaft, then the head as two strokes back from the tip, at most 7 units long.
			const double head = std::min(0.25, 7 / std::max(std::hypot(dx, dy), 1e-9)), hx = head * dx, hy = head * dy;
			path += fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}l{:.1f} {:.1f}M{:.1f} {:.1f}l{:.1f} {:.1f}", frame.X(u), frame.Y(v), dx, dy, 0.5 * hy - hx, -0.5 * hx - hy,
				frame.X(u) + dx, frame.Y(v) + dy, -0.5 * hy - hx, 0.5 * hx - hy);
		}
		if (!path.empty())
			out += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"1.1\" fill=\"none\"/>\n", path, html::PhotoColour(p));
	}
	out += frame.PrincipalPoint(c.MainGeometry().states[s].principal_point);
	const double bar = html::RoundNumber(80 / (frame.scale * factor));
	out += fmt::format("<path d=\"M2 {0:.1f}v-4v8v-4h{1:.1f}v-4v8\" stroke=\"#222\" fill=\"none\"/>\n", frame.height + 15, bar * frame.scale * factor);
	out += Text(8 + bar * frame.scale * factor, frame.height + 19, fmt::format("{:g} px; arrows from measured to reprojected, {:g} times as long; + principal point", bar, factor));
	return out + "</svg>\n";
}

std::string BlurMap(const Calibration& c, size_t s, bool across_radius)
{
	const std::vector<Photo>& photos = c.task.states[s].photos;
	const Frame frame(c.task);
	struct Stroke
	{
		double x, y, nx, ny, difference;
	};
	std::vector<Stroke> strokes;
	std::vector<double> sizes;
	for (size_t p = 0; p < photos.size(); ++p)
		for (const Edge& e : photos[p].edges)
		{
			const double difference = e.blur - PredictedBlur(c, s, p, e);
			if (!std::isfinite(difference))
				continue;
			const Point normal = EdgeNormal(e);
			const Point& centre = c.MainGeometry().states[s].principal_point;
			const double x = e.x - centre[0], y = e.y - centre[1];
			sizes.push_back(std::abs(difference));
			if ((2 * std::pow(x * normal[0] + y * normal[1], 2) > x * x + y * y) == across_radius)
				strokes.push_back({ e.x, e.y, normal[0], normal[1], difference });
		}
	const double range = RoundAbove(Quantile(sizes, 0.9));
	const int steps = 10;
	std::map<int, std::string> paths;   // by colour
	for (const Stroke& k : strokes)
	{
		const int step = static_cast<int>(std::lround(steps * std::clamp(k.difference / range, -1.0, 1.0)));
		paths[step] += fmt::format("M{:.1f} {:.1f}l{:.1f} {:.1f}", frame.X(k.x) - 4.5 * k.ny, frame.Y(k.y) + 4.5 * k.nx, 9 * k.ny, -9 * k.nx);
	}
	std::string out = Open(frame.height + 26, "Residuals of the blur") + frame.Draw();
	// The pale ones first.
	std::vector<int> order;
	for (const auto& path : paths)
		order.push_back(path.first);
	std::sort(order.begin(), order.end(), [](int a, int b) { return std::abs(a) < std::abs(b) || (std::abs(a) == std::abs(b) && a < b); });
	for (const int step : order)
		out += fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"3.2\" fill=\"none\"/>\n", paths[step], SignedColour(double(step) / steps));
	out += frame.PrincipalPoint(c.MainGeometry().states[s].principal_point);
	for (int step = -steps; step <= steps; ++step)
		out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"9\" height=\"12\" fill=\"{}\"/>\n", 70 + 9.0 * (step + steps), frame.height + 9, SignedColour(double(step) / steps));
	out += Text(64, frame.height + 19, fmt::format("−{:g} px", range), "end") + Text(266, frame.height + 19, fmt::format("+{:g} px and beyond; strokes lie along the edges", range));
	return out + "</svg>\n";
}

}
