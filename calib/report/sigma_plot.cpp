// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/sigma_plot.h"

#include "base/plain_text.h"
#include "calibrate/next_words.h"
#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tiltcal
{

namespace
{

const double WIDTH = 860, HEIGHT = 380, LEFT = 60, RIGHT = 300, TOP = 16, BOTTOM = 44;

struct Axes
{
	double first, last, low, high;   ///< photographs; decades

	double X(double photographs) const { return LEFT + (WIDTH - LEFT - RIGHT) * (last > first ? (photographs - first) / (last - first) : 0.5); }
	double Y(double ratio) const { return TOP + (HEIGHT - TOP - BOTTOM) * (high - std::log10(ratio)) / (high - low); }
};

double Ratio(const ExpectedSigma& s) { return std::clamp(s.now / s.wanted, 1e-3, 1e3); }

Axes AxesOf(const std::vector<SigmasOfMany>& history)
{
	Axes a{ HUGE_VAL, -HUGE_VAL, 0, 0 };
	for (const SigmasOfMany& h : history)
	{
		a.first = std::min(a.first, double(h.photographs));
		a.last = std::max(a.last, double(h.photographs));
		for (const ExpectedSigma& s : h.sigmas)
		{
			a.low = std::min(a.low, std::floor(std::log10(Ratio(s))));
			a.high = std::max(a.high, std::ceil(std::log10(Ratio(s))));
		}
	}
	if (a.high == a.low)
		a.high += 1;
	return a;
}

std::string Grid(const Axes& a)
{
	std::string out;
	for (double decade = a.low; decade <= a.high; decade += 1)
	{
		const double y = a.Y(std::pow(10, decade));
		out += fmt::format("<line x1=\"{0:.0f}\" y1=\"{1:.1f}\" x2=\"{2:.0f}\" y2=\"{1:.1f}\" stroke=\"{3}\"/><text x=\"{4:.0f}\" y=\"{5:.1f}\" text-anchor=\"end\">{6:g}</text>\n", LEFT, y, WIDTH - RIGHT,
			decade == 0 ? "#222" : "#ddd", LEFT - 8, y + 4, std::pow(10, decade));
	}
	const int step = std::max(1, int((a.last - a.first) / 12));
	for (int n = int(a.first); n <= int(a.last); n += step)
		out += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n", a.X(n), HEIGHT - BOTTOM + 20, n);
	return out + fmt::format("<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">photographs</text>\n", 0.5 * (LEFT + WIDTH - RIGHT), HEIGHT - 4);
}

}

std::string SigmaPlot(const std::vector<SigmasOfMany>& history)
{
	if (history.empty())
		return "";
	const Axes a = AxesOf(history);
	std::string out = fmt::format("<svg class=\"map\" viewBox=\"0 0 {:.0f} {:.0f}\" style=\"max-width: {:.0f}px\">\n", WIDTH, HEIGHT, WIDTH) + Grid(a);
	// Labels at the lines' ends, moved apart.
	std::vector<std::pair<double, std::string>> labels;
	const std::vector<ExpectedSigma>& last = history.back().sigmas;
	for (size_t k = 0; k < last.size(); ++k)
	{
		std::string path;
		for (const SigmasOfMany& h : history)
			for (const ExpectedSigma& s : h.sigmas)
				if (s.name == last[k].name)
					path += fmt::format("{}{:.1f} {:.1f} ", path.empty() ? "M" : "L", a.X(double(h.photographs)), a.Y(Ratio(s)));
		out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path, html::PhotoColour(k));
		labels.emplace_back(a.Y(Ratio(last[k])), fmt::format("fill=\"{}\">{}", html::PhotoColour(k), HtmlText(NameForPeople(last[k].name))));
	}
	std::sort(labels.begin(), labels.end());
	double above = TOP - 10;
	for (const auto& [y, text] : labels)
	{
		above = std::max(above + 15, std::min(y + 4, HEIGHT - 15 * double(labels.size())));
		out += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" {}</text>\n", WIDTH - RIGHT + 10, above, text);
	}
	return out + "</svg>\n";
}

}
