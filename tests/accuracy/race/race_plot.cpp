// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

struct Style
{
	Opponent opponent;
	const char* title;
	const char* colour;
	int point;
};

const Style styles[] = {
	{Opponent::STOCK, "stock focal blur", "#c0392b", 4},
	{Opponent::PINHOLES, "averaged pinholes", "#8e44ad", 8},
	{Opponent::FIXED, "tilt_lens, fixed N", "#7f8c8d", 2},
	{Opponent::RAW, "tilt_lens, adaptive", "#27ae60", 6},
	{Opponent::OURS, "tilt_lens with denoise", "#1f6fb2", 7},
};

}

std::string PlotOf(const Contest& contest, bool rel_mse, const fs::path& work)
{
	const std::string name = contest.Name() + (rel_mse ? "-relmse" : "-rms");
	const fs::path svg = work / (name + ".svg"), script = work / (name + ".gnuplot");
	std::string id = name; // gnuplot allows no hyphen here
	std::replace(id.begin(), id.end(), '-', '_');
	std::ofstream file(script);
	file << "set terminal svg size 560,400 dynamic noenhanced font 'sans-serif,12' name '" << id << "'\nset output '" << svg.string() << "'\n"
		"set logscale xy\nset grid lc rgb '#dddddd'\nset key top right samplen 2\nset border 3 lc rgb '#666666'\nset tics nomirror\n"
		"set format x '%g'\nset format y '%g'\nset xlabel 'CPU time less start-up, s'\nset ylabel '"
		<< (rel_mse ? "root of relMSE" : "RMS error, linear light") << "'\n";
	std::string plots;
	for (const Style& style : styles)
	{
		const auto found = contest.points.find(style.opponent);
		if (found == contest.points.end() || found->second.empty())
			continue;
		const std::string block = fmt::format("$p{}", int(style.opponent));
		file << block << " << EOD\n";
		for (const RacePoint& point : found->second)
			file << point.Time() << ' ' << (rel_mse ? std::sqrt(point.rel_mse) : point.Rms()) << '\n';
		file << "EOD\n$h" << int(style.opponent) << " << EOD\n";
		for (const CurvePoint& point : rel_mse ? contest.RelMseHull(style.opponent) : contest.RmsHull(style.opponent))
			file << point.time << ' ' << point.error << '\n';
		file << "EOD\n";
		plots += fmt::format("{} with points pt {} ps 0.6 lc rgb '{}' notitle, $h{} with lines lw 2 lc rgb '{}' title '{}', ", block,
			style.point, style.colour, int(style.opponent), style.colour, style.title);
	}
	file << "plot " << plots << "NaN notitle\n";
	file.close();
	RunMeasured({"gnuplot", script.string()}, work, work / "gnuplot.log");
	std::ifstream result(svg);
	const std::string text{std::istreambuf_iterator<char>(result), {}};
	const std::size_t start = text.find("<svg");
	if (start == std::string::npos)
		throw std::runtime_error("gnuplot made no picture from " + script.string());
	return text.substr(start);
}
