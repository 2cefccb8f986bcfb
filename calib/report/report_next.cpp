// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/report_next.h"

#include "base/plain_text.h"
#include "calibrate/coverage.h"
#include "calibrate/next_words.h"
#include "report/html.h"
#include "report/page_head.h"
#include "report/sigma_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{


const char* const NOTHING = "nothing is missing";

/// The number that another photograph would tell best, where none is needed.
std::string WhatIsLeftToGain(const NextPhotographs& next)
{
	const ExpectedSigma* best = nullptr;
	for (const ExpectedSigma& s : next.sigmas)
		if (s.now > 0 && (!best || s.then / s.now < best->then / best->now))
			best = &s;
	if (!best || next.photographs.empty())
		return "";
	return fmt::format("the best further photograph would lower the sigma of {} by {:.0f} %, of no number by more", NameForPeople(best->name), 100 * (1 - best->then / best->now));
}

std::string Path(const std::vector<Point>& outline)
{
	std::string path;
	for (const Point& p : outline)
		path += fmt::format("{}{:.0f} {:.0f} ", path.empty() ? "M" : "L", p[0], p[1]);
	return path + "Z";
}

/// First and last feature of the first and the last row; empty without corners.
std::vector<Point> OutlineOf(const Photo& photo)
{
	if (photo.corners.empty())
		return {};
	int last_row = 0;
	for (const Corner& c : photo.corners)
		last_row = std::max(last_row, c.row);
	const auto end = [&](int row, bool first)
	{
		const Corner* found = nullptr;
		for (const Corner& c : photo.corners)
			if (c.row == row && (!found || (first ? c.column < found->column : c.column > found->column)))
				found = &c;
		return found ? Point{ found->x, found->y } : Point{ 0, 0 };
	};
	return { end(0, true), end(0, false), end(last_row, false), end(last_row, true) };
}

/// The picture with the boards that were seen in it, and those to come.
std::string PictureSvg(const Task& task, const std::vector<NextPhotograph>& photographs)
{
	const double unit = task.width / 640.0;
	std::string out = fmt::format("<svg class=\"map next\" viewBox=\"{0:.0f} {0:.0f} {1:.0f} {2:.0f}\">\n<rect x=\"0\" y=\"0\" width=\"{3}\" height=\"{4}\" fill=\"#fafafa\" stroke=\"#222\" stroke-width=\"{5:.1f}\"/>\n", -4 * unit,
		task.width + 8 * unit, task.height + 8 * unit, task.width, task.height, 2 * unit);
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			if (const std::vector<Point> outline = OutlineOf(photo); !outline.empty())
				out += fmt::format("<path d=\"{}\" fill=\"#888\" fill-opacity=\"0.08\" stroke=\"#888\" stroke-width=\"{:.1f}\"/>\n", Path(outline), unit);
	for (size_t k = 0; k < photographs.size(); ++k)
	{
		const NextPhotograph& next = photographs[k];
		const std::string colour = html::PhotoColour(k);
		out += fmt::format("<path d=\"{0}\" fill=\"{1}\" fill-opacity=\"0.12\" stroke=\"{1}\" stroke-width=\"{2:.1f}\"/>\n", Path(next.outline_px), colour, 2.5 * unit);
		// At its upper left corner, clear of the others.
		const Point& corner = next.outline_px[0];
		out += fmt::format("<text class=\"number\" x=\"{:.0f}\" y=\"{:.0f}\" style=\"font-size: {:.0f}px; stroke-width: {:.1f}px\" fill=\"{}\">{}</text>\n", corner[0] + 8 * unit, corner[1] + 26 * unit, 22 * unit, 4 * unit, colour, k + 1);
	}
	return out + "</svg>\n";
}

std::string SigmaTable(const NextPhotographs& next)
{
	std::vector<std::vector<std::string>> rows{ { "one standard deviation", "wanted", "now" } };
	for (size_t k = 0; k < next.photographs.size(); ++k)
		rows[0].push_back(k == 0 ? "with 1" : fmt::format("with 1 to {}", k + 1));
	for (size_t g = 0; g < next.sigmas.size(); ++g)
	{
		const ExpectedSigma& s = next.sigmas[g];
		const auto cell = [&](double value) { return fmt::format(value > s.wanted ? "<b>{:.2g}</b>" : "{:.2g}", value); };
		rows.push_back({ HtmlText(NameForPeople(s.name) + ", " + s.unit), fmt::format("{:.2g}", s.wanted), cell(s.now) });
		for (const NextPhotograph& photograph : next.photographs)
			rows.back().push_back(cell(photograph.sigmas[g].then));
	}
	return html::Table(rows);
}

std::string List(const std::vector<std::string>& lines, const char* kind)
{
	std::string out = fmt::format("<{}>\n", kind);
	for (const std::string& line : lines)
		out += "<li>" + HtmlText(line) + "</li>\n";
	return out + fmt::format("</{}>\n", kind);
}

std::string Events(const WatchNotes& notes)
{
	std::string out = "<h3>What happened</h3>\n<pre>";
	const size_t most = 40, first = notes.events.size() > most ? notes.events.size() - most : 0;
	for (size_t k = notes.events.size(); k > first; --k)
		out += HtmlText(notes.events[k - 1]) + "\n";
	return out + "</pre>\n";
}

/// Every photograph and how the board stands in it.
std::string SeenTable(const Task& task)
{
	std::vector<std::vector<std::string>> rows{ { "photograph", "state", "board", "of the picture's width", "blur, px" } };
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
		{
			const Stance s = StanceOf(photo);
			rows.push_back({ HtmlText(photo.file), HtmlText(state.name), HtmlText(StanceWords(s)), fmt::format("{:.0f} %", 100 * s.share_of_width), fmt::format("{:.1f} to {:.1f}", s.least_blur, s.most_blur) });
		}
	return rows.size() > 1 ? html::Table(rows) : "<p>No photograph of the board yet.</p>\n";
}

}

std::string NextText(const Calibration& c)
{
	if (!c.next.known)
		return "";
	std::string out = "\nwhat is missing:\n";
	for (const std::string& line : c.next.missing)
		out += "  " + line + "\n";
	if (c.next.missing.empty())
	{
		const std::string gain = WhatIsLeftToGain(c.next);
		return out + "  " + NOTHING + (gain.empty() ? "" : "; " + gain) + "\n";
	}
	if (!c.next.photographs.empty())
		out += "what to photograph next:\n";
	for (size_t k = 0; k < c.next.photographs.size(); ++k)
	{
		const NextPhotograph& next = c.next.photographs[k];
		out += fmt::format("  {}. {}\n", k + 1, next.text);
		std::string sigmas;
		for (size_t g = 0; g < next.sigmas.size(); ++g)
			if (const ExpectedSigma& s = next.sigmas[g]; s.now > s.wanted)
				sigmas += fmt::format("{}{} {:.2g} to {:.2g} {}", sigmas.empty() ? "" : "; ", NameForPeople(s.name), k == 0 ? s.now : c.next.photographs[k - 1].sigmas[g].then, s.then, s.unit);
		if (!sigmas.empty())
			out += fmt::format("     expected: sigma of {}\n", sigmas);
	}
	return out;
}

std::string NextSection(const Calibration& c)
{
	if (!c.next.known)
		return "";
	std::string out = "<h2>What to photograph next</h2>\n";
	if (c.next.missing.empty())
		out += fmt::format("<p><b>Nothing is missing</b>{}.</p>\n", c.next.photographs.empty() ? "" : ": " + HtmlText(WhatIsLeftToGain(c.next)));
	else
		out += "<p>Missing:</p>\n" + List(c.next.missing, "ul");
	if (c.next.photographs.empty())
		return out;
	out += "<div class=\"pair\">\n<div>" + PictureSvg(c.task, c.next.photographs) + "<p><small>Grey: where the board was. In colour: where it would tell most, as the viewfinder shows it.</small></p></div>\n<div>";
	std::vector<std::string> lines;
	for (const NextPhotograph& next : c.next.photographs)
		lines.push_back(next.text);
	return out + List(lines, "ol") + SigmaTable(c.next) + "<p><small>Bold: more than wanted. What a photograph will say is computed from where its edges would lie and how well edges as blurred are measured.</small></p></div>\n</div>\n";
}

std::string WatchSection(const WatchNotes& notes)
{
	if (!notes.on && notes.history.empty())
		return "";
	std::string out;
	if (notes.history.size() > 1)
		out += "<h2>How the sigmas fall</h2>\n<p>Each line is one number's standard deviation over what is wanted of it; below 1 nothing is missing.</p>\n" + SigmaPlot(notes.history);
	return out + Events(notes);
}

std::string WaitingPage(const Task& task, const WatchNotes& notes, const std::string& date)
{
	size_t photographs = 0;
	for (const State& state : task.states)
		photographs += state.photos.size();
	std::string out = PageHead(notes.on) + "<h1>Calibration of a tilted lens</h1>\n<div class=\"verdict poor\"><b>No calibration yet</b>";
	out += photographs || !notes.waiting.empty() ? ": " + HtmlText(notes.waiting) : std::string(": waiting for the first photograph.");
	out += "</div>\n";
	if (notes.beside_earlier)
		out += "<p>The other files of this folder are of an earlier calibration: the next one replaces them.</p>\n";
	if (!notes.lacking.empty())
		out += "<h2>What to photograph next</h2>\n" + List(notes.lacking, "ul");
	out += "<h2>What was seen</h2>\n";
	if (task.width > 0)
		out += "<div class=\"pair\">\n<div>" + PictureSvg(task, {}) + "</div>\n<div>" + SeenTable(task) + "</div>\n</div>\n";
	else
		out += SeenTable(task);
	return out + Events(notes) + "<p><small>tiltcal " TILTCAL_VERSION ", " + HtmlText(date) + "</small></p>\n</body></html>\n";
}

}
