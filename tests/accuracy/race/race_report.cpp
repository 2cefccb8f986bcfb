// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_report.h"

#include "lens/denoise.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

// Pixels that denoise has traced over those that are judged, all of them inside the picture.
double MarginsOfDenoise(const RaceSettings& s)
{
	const double margin = 2 * tilt_lens::DenoiseReach;
	return (s.judged_width + margin) * (s.judged_height + margin) / (double(s.judged_width) * s.judged_height);
}

const char* head = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>What accuracy costs</title>
<style>
body { font: 15px/1.45 sans-serif; color: #222; max-width: 1180px; margin: 2em auto; padding: 0 1em }
table { border-collapse: collapse; margin: .6em 0 }
th, td { padding: .15em .7em; border-bottom: 1px solid #ddd; text-align: right }
th:first-child, td:first-child { text-align: left }
.scene { display: flex; flex-wrap: wrap; gap: 1.2em; align-items: flex-start; border-top: 1px solid #bbb; padding: .8em 0 }
.scene svg { max-width: 100%; height: auto }
.text { flex: 1 1 320px } .text img { image-rendering: auto; width: 320px }
.lost { background: #f8d0cc } .big { font-size: 1.25em } small { color: #555 }
</style></head><body>
)";

std::string Base64(const std::vector<unsigned char>& bytes)
{
	static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
	std::string text;
	for (std::size_t i = 0; i < bytes.size(); i += 3)
	{
		unsigned group = 0;
		for (std::size_t k = 0; k < 3; ++k)
			group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0u);
		for (std::size_t k = 0; k < 4; ++k)
			text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
	}
	return text;
}

// Display gamma, 400 pixels wide.
std::string Thumbnail(const Picture& picture)
{
	cv::Mat image(picture.height, picture.width, CV_8UC3);
	for (int i = 0; i < picture.width * picture.height; ++i)
		for (int c = 0; c < 3; ++c)
			image.data[3 * i + c] = cv::saturate_cast<unsigned char>(255 * std::pow(picture.rgb[std::size_t(3 * i + 2 - c)], 1 / 2.2));
	const double scale = 400.0 / picture.width;
	cv::resize(image, image, {}, scale, scale, scale > 1 ? cv::INTER_CUBIC : cv::INTER_AREA);
	std::vector<unsigned char> bytes;
	cv::imencode(".png", image, bytes);
	return "<img alt=\"the truth\" src=\"data:image/png;base64," + Base64(bytes) + "\">";
}

std::string Cell(const Ratio& ratio)
{
	const std::string sign = Sign(ratio), html = sign == ">" ? "&gt;&thinsp;" : sign == "<" ? "&lt;&thinsp;" : sign;
	return fmt::format("<td{}>{}{:.2f}</td>", ratio.value < 1 ? " class=\"lost\"" : "", html, ratio.value);
}

// Of a truth that is not known well enough.
const std::string NOT_TOLD = "<td>–</td>";

// Against our own without denoise, ours is denoised; against all others it runs twice.
std::vector<Side> SidesAgainst(Opponent rival)
{
	return rival == Opponent::RAW ? std::vector<Side>{Side::BEST} : std::vector<Side>{Side::RAW, Side::BEST};
}

const char* Heading(Side side)
{
	return side == Side::RAW ? "raw" : "best";
}

std::string Summary(const RaceReport& report, Opponent rival, const char* title)
{
	const std::vector<Side> sides = SidesAgainst(rival);
	const std::vector<double>& errors = report.settings.errors;
	std::string rows;
	std::vector<double> least(sides.size(), 1e9);
	std::vector<MeanRatio> columns(errors.size() * sides.size());
	int count = 0;
	for (const Contest& contest : report.contests)
	{
		if (contest.points.find(rival) == contest.points.end())
			continue;
		rows += fmt::format("<tr><td><a href=\"#{}\">{}</a></td>", contest.Name(), contest.Title());
		std::vector<MeanRatio> row(sides.size());
		for (std::size_t i = 0; i < columns.size(); ++i)
		{
			const std::size_t s = i % sides.size();
			if (!contest.Tells(errors[i / sides.size()]))
			{
				rows += NOT_TOLD;
				continue;
			}
			const Ratio ratio = RatioAt(contest, rival, errors[i / sides.size()], sides[s]);
			rows += Cell(ratio);
			row[s].Add(ratio);
			columns[i].Add(ratio);
			least[s] = std::min(least[s], ratio.value);
		}
		for (const MeanRatio& mean : row)
			rows += mean.Count() > 0 ? fmt::format("<td><b>{}</b></td>", mean.InWords()) : NOT_TOLD;
		rows += "</tr>\n";
		++count;
	}
	if (count == 0)
		return "";
	std::string text = fmt::format("<h3>{}</h3>\n<table><tr><th>scene</th>", title), means, leasts;
	for (double error : errors)
		text += fmt::format("<th colspan=\"{}\">at {:g}</th>", sides.size(), error);
	text += fmt::format("<th colspan=\"{}\">mean</th></tr>\n<tr><th></th>", sides.size());
	for (std::size_t i = 0; i < columns.size() + sides.size(); ++i)
		text += fmt::format("<th>{}</th>", rival == Opponent::RAW ? "denoised" : Heading(sides[i % sides.size()]));
	text += "</tr>\n" + rows + "<tr><th>geometric mean</th>";
	for (const MeanRatio& mean : columns)
		text += mean.Count() > 0 ? fmt::format("<th>{}</th>", mean.InWords()) : NOT_TOLD;
	for (std::size_t s = 0; s < sides.size(); ++s)
	{
		means += fmt::format("<th class=\"big\">{}</th>", MeanAgainst(report, rival, sides[s]).InWords());
		leasts += fmt::format("{}{:.2f} ({})", s > 0 ? ", " : "", least[s], rival == Opponent::RAW ? "denoised" : Heading(sides[s]));
	}
	const bool all_told = std::all_of(columns.begin(), columns.end(), [count](const MeanRatio& mean) { return mean.Count() == count; });
	return text + means + "</tr></table>\n<p>Least: " + leasts + (all_told ? "" : ". –: less than twice the error that the truth itself may have") + ".</p>\n";
}

Ratio Paid(const Contest& contest, Ratio ratio)
{
	ratio.value *= contest.pinholes_paid;
	ratio.theirs_at_floor = false; // all of it was measured
	return ratio;
}

std::string Ratios(const Contest& contest, const RaceSettings& settings)
{
	std::string text = "<table><tr><th>time, over ours</th>";
	for (double error : settings.errors)
		text += fmt::format("<th>RMS {:g}</th>", error);
	for (double error : settings.rel_mse)
		text += fmt::format("<th>relMSE {:g}</th>", error);
	text += "</tr>\n";
	const auto row = [&](const std::string& name, Opponent opponent, Side side, bool paid) {
		const auto cell = [&](const Ratio& ratio) { return Cell(paid ? Paid(contest, ratio) : ratio); };
		text += "<tr><td>" + name + "</td>";
		for (double error : settings.errors)
			text += contest.Tells(error) ? cell(RatioAt(contest, opponent, error, side)) : NOT_TOLD;
		for (double error : settings.rel_mse)
			text += cell(RelMseRatioAt(contest, opponent, error, side));
		text += "</tr>\n";
	};
	for (Opponent opponent : {contest.Rival(), Opponent::RAW, Opponent::FIXED})
	{
		const char* name = opponent == Opponent::STOCK ? "stock's best setting" : opponent == Opponent::PINHOLES ? "averaged pinholes" :
			opponent == Opponent::RAW ? "ours, no denoise" : "ours, fixed N";
		for (const Side side : SidesAgainst(opponent))
		{
			const std::string over = fmt::format(", over {}", opponent == Opponent::RAW ? "denoised" : Heading(side));
			row(name + over, opponent, side, false);
			if (opponent == Opponent::PINHOLES) // as a user pays: every frame is parsed
				row("the same, parsing not taken off" + over, opponent, side, true);
		}
	}
	return text + "</table>\n";
}

// The settings that make the hull: what a user should write.
std::string Hulls(const Contest& contest)
{
	std::string text = "<details><summary>settings on the curves</summary><table>"
		"<tr><th>blur_samples</th><th>CPU s</th><th>spread</th><th>RMS</th><th>to truth</th><th>moved truth</th><th>own limit</th><th>relMSE</th></tr>\n";
	for (Opponent opponent : {contest.Rival(), Opponent::OURS, Opponent::RAW, Opponent::FIXED})
	{
		const auto found = contest.points.find(opponent);
		if (found == contest.points.end())
			continue;
		for (const CurvePoint& on : contest.RmsHull(opponent))
			for (const RacePoint& point : found->second) // a fixed N on our best curve is listed with the fixed
				if (point.Time() == on.time && point.Rms() == on.error)
				{
					text += fmt::format("<tr><td>{}: {}</td><td>{:.3f}</td><td>{:.1f}&thinsp;%</td><td>{:.5f}</td><td>{:.5f}</td>",
						Name(opponent), Label(point.setting), point.Time(), 100 * point.Spread(), point.Rms(), point.rms_truth);
					text += opponent == Opponent::STOCK ? fmt::format("<td>{:.5f}</td><td>{:.5f}</td>", point.rms_shifted, point.rms_limit) : "<td></td><td></td>";
					text += fmt::format("<td>{:.3g}</td></tr>\n", point.rel_mse);
				}
	}
	return text + "</table></details>\n";
}

// What denoise made worse, which the RMS error of the whole picture does not say.
std::string WorseBlocks(const Contest& contest)
{
	double sum = 0, most = 0;
	int count = 0;
	std::string where;
	const auto found = contest.points.find(Opponent::OURS);
	for (const RacePoint& point : found == contest.points.end() ? std::vector<RacePoint>() : found->second)
	{
		if (point.worse_blocks < 0)
			continue;
		sum += point.worse_blocks;
		++count;
		if (where.empty() || point.worse_blocks > most)
		{
			most = point.worse_blocks;
			where = Label(point.setting);
		}
	}
	return count == 0 ? "" : fmt::format("<p>Denoised, {:.1f}&thinsp;% of the 8 x 8 blocks are more than 10&thinsp;% worse than without (mean of {} settings; "
		"at most {:.1f}&thinsp;%, at {}).</p>\n", 100 * sum / count, count, 100 * most, where);
}

std::string Section(const Contest& contest, const RaceReport& report, const fs::path& work)
{
	std::string text = fmt::format("<div class=\"scene\" id=\"{}\"><div class=\"text\"><h3>{}</h3>\n{}\n<p>{}.</p>\n", contest.Name(),
		contest.Title(), Thumbnail(contest.truth), contest.scene.shows);
	text += fmt::format("<p><small>Truth: {} samples, own RMS error {:.5f}{}",
		contest.truth_samples, contest.truth_error, contest.truth_error <= report.settings.reference_error ? "" : " (more than was asked for)");
	text += contest.pinhole_frames == 0 ? "." : fmt::format("; {:.5f} from {} averaged pinholes of stock, which should be within {:.5f}.",
		contest.pinhole_distance, contest.pinhole_frames, contest.PinholeBound());
	if (!contest.tilted)
		text += fmt::format(" Stock's own limit (own error {:.5f}) is {:.5f} from the truth, moved by ({:.3f}, {:.3f}) px.",
			contest.limit_error, contest.limit_distance, contest.stock_offset.dx, contest.stock_offset.dy);
	text += fmt::format(" Start-up taken off: {:.0f} ms ours", 1000 * contest.start_up.at(Opponent::OURS));
	if (contest.tilted)
		text += fmt::format(", {:.1f} ms a pinhole frame.", 1000 * contest.start_up.at(Opponent::PINHOLES));
	else
		text += fmt::format(", {:.0f} ms stock.", 1000 * contest.start_up.at(Opponent::STOCK));
	text += "</small></p>\n" + WorseBlocks(contest) + Hulls(contest) + "</div>\n<div>" + PlotOf(contest, false, work) + Ratios(contest, report.settings);
	return text + "<details><summary>relMSE</summary>" + PlotOf(contest, true, work) + "</details></div></div>\n";
}

std::string MeanRow(const RaceReport& report, Opponent rival, const char* name)
{
	const auto cell = [&](Side side) { return fmt::format("<td><b>{}</b></td>", MeanAgainst(report, rival, side).InWords()); };
	return fmt::format("<tr><td>{}</td>{}{}</tr>\n", name, rival == Opponent::RAW ? "<td></td>" : cell(Side::RAW), cell(Side::BEST));
}

double MedianSpread(const RaceReport& report)
{
	std::vector<double> spreads;
	for (const Contest& contest : report.contests)
		for (const auto& [opponent, list] : contest.points)
			for (const RacePoint& point : list)
				if (point.times.size() > 1)
					spreads.push_back(point.Spread());
	std::sort(spreads.begin(), spreads.end());
	return spreads.empty() ? 0 : spreads[spreads.size() / 2];
}

}

void WritePage(const RaceReport& report, const fs::path& out, const fs::path& work)
{
	std::ofstream file(out / "report.html");
	file << head << "<h1>What accuracy costs</h1>\n<p>" << report.conditions << "</p>\n";
	file << "<h2>The race</h2>\n<p class=\"big\">Time over ours at equal error, geometric mean over scenes and errors:</p>\n"
		"<table><tr><th></th><th>raw</th><th>best</th></tr>\n" << MeanRow(report, Opponent::STOCK, "stock's best setting")
		<< MeanRow(report, Opponent::PINHOLES, "averaged pinholes (tilted planes)") << MeanRow(report, Opponent::FIXED, "our own fixed N")
		<< MeanRow(report, Opponent::RAW, "our own without denoise, over denoised") << "</table>\n"
		"<p>Raw: tilt_lens without <code>denoise</code>, adaptive or fixed, which like stock and pinholes shows what it traced. Best: denoised where that is quicker. "
		"No opponent is denoised. What the signs before ratios say: <a href=\"#measured\">how it is measured</a>.</p>\n<p>Raw: " << WhereWeLose(report, Side::RAW) << "</p>\n<p>Best: " << WhereWeLose(report, Side::BEST) << "</p>\n";
	file << Summary(report, Opponent::STOCK, "Stock focal blur, best of all its settings, zero tilt")
		<< Summary(report, Opponent::PINHOLES, "Averaged pinhole renders from stock, tilted planes")
		<< Summary(report, Opponent::RAW, "tilt_lens without denoise, adaptive and fixed, over tilt_lens with it")
		<< Summary(report, Opponent::FIXED, "tilt_lens with a fixed number of samples, over all that adapts");
	file << LeversSection(report) << SizesSection(report, out);
	file << "<h3 id=\"measured\">How it is measured</h3>\n<ul>\n"
		"<li>RMS error over pixels and channels, linear light, 16 bits, clipped at 1. relMSE is mean((x &minus; t)&sup2; / (t&sup2; + 0.01)).</li>\n"
		"<li>Each stock picture is judged by the smallest of three errors: against the truth; against the truth moved by the part of a pixel that suits it best; "
		"against stock's own limit, less the limit's own noise. Its sampling errors are thus not held against it.</li>\n"
		"<li>CPU time, user and system, one thread, the least of " << report.settings.repeats << " runs"
		<< (report.settings.short_repeats > report.settings.repeats ? fmt::format(" ({} of those below {} s)", report.settings.short_repeats, report.settings.short_run) : "") << ", opponents by turns there and back"
		<< fmt::format(" (median spread {:.1f}&thinsp;%)", 100 * MedianSpread(report)) << "; the time of a run that traces one pixel of the same picture is taken off for all, "
		"for pinholes as often as there are frames, and none counts as less than a third of that, by which a machine's speed drifts.</li>\n"
		"<li>Curves are the lower left of all settings, convex in logarithms. &gt;: the opponent never got there, its last slope, or that of plain averaging "
		"if steeper, is taken on; &lt;: the same for ours, with the flatter slope; ~: both. ?: one of the two times is not longer than that third of the start-up, and may be much shorter than it counts.</li>\n"
		"<li>Truths are the mean of independent sets of tilt_lens's fixed samples"
		<< (report.settings.check_frames > 0 ? ", and are checked against averaged pinholes of stock, which share no code with them.</li>\n"
			: "; those of the small pictures (160 x 120) are checked against averaged pinholes of stock.</li>\n")
		<< (report.settings.judged_width < report.settings.width ? fmt::format("<li>Rendered, timed and judged are the {} x {} pixels in the middle. What looks at neighbours traces more of them, 24 on every side with <code>denoise</code>, "
			"which a whole picture does not need: {:.2f} times as many pixels as are judged, held against ours.</li>\n",
			report.settings.judged_width, report.settings.judged_height, MarginsOfDenoise(report.settings)) : "")
		<< (report.reused == Reuse::STOCK ? "<li><b>Stock's times come from an earlier race</b>: not interleaved.</li>\n"
			: report.reused == Reuse::ALL ? "<li>The race was stopped and gone on with: what had run by then was not run again.</li>\n" : "") << "</ul>\n";
	for (const Contest& contest : report.contests)
		file << Section(contest, report, work);
	for (const char* name : {"tiltcost.html", "gallery-seconds.html", "cost-of-nothing.html", "calibrator-cost.html", "calibrator-ablation.html"})
	{
		std::ifstream fragment(out / name);
		if (fragment)
			file << "<hr>\n" << std::string{std::istreambuf_iterator<char>(fragment), {}} << '\n';
	}
	file << "</body></html>\n";
	if (!file.flush())
		throw std::runtime_error("cannot write " + (out / "report.html").string());
}
