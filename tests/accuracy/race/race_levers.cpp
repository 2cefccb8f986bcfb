// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What each lever is worth alone, and what a larger picture is worth, from points that were raced.

#include "race_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace
{

using Chosen = std::function<bool(const Setting&)>;

std::vector<CurvePoint> HullWhere(const Contest& contest, const Chosen& chosen)
{
	std::vector<CurvePoint> points;
	for (const auto& [opponent, list] : contest.points)
		for (const RacePoint& point : list)
			if (chosen(point.setting))
				points.push_back({point.Time(), point.Rms()});
	return Hull(points);
}

bool StocksFixed(const Setting& s) { return s.opponent == Opponent::STOCK && s.variance == 0; }
bool Grid(const Setting& s) { return s.opponent == Opponent::GRID; }
bool Ours(const Setting& s) { return s.opponent != Opponent::STOCK && s.opponent != Opponent::PINHOLES && !s.grid; }
bool Fixed(const Setting& s) { return Ours(s) && s.variance == 0 && !s.denoise; }
bool NotDenoised(const Setting& s) { return Ours(s) && !s.denoise; }
bool NotAdaptive(const Setting& s) { return Ours(s) && s.variance == 0; }

Lever Worth(const RaceReport& report, const char* title, const Chosen& without, const Chosen& with)
{
	Lever lever;
	lever.title = title;
	const std::vector<double>& errors = report.settings.errors;
	lever.at.assign(errors.size(), 0.0);
	std::vector<int> told(errors.size(), 0);
	for (const Contest& contest : report.contests)
	{
		const std::vector<CurvePoint> slow = HullWhere(contest, without), fast = HullWhere(contest, with);
		if (slow.empty() || fast.empty())
			continue;
		double sum = 0;
		int count = 0;
		for (std::size_t i = 0; i < errors.size(); ++i)
		{
			if (!contest.Tells(errors[i]))
				continue;
			const double gain = std::log(TimeToReach(slow, errors[i], true).time / TimeToReach(fast, errors[i], false).time);
			lever.at[i] += gain;
			++told[i];
			sum += gain;
			++count;
		}
		if (count == 0)
			continue;
		const double gain = std::exp(sum / count);
		if (lever.contests == 0 || gain < lever.least)
		{
			lever.least = gain;
			lever.least_in = contest.Title();
		}
		if (lever.contests == 0 || gain > lever.most)
		{
			lever.most = gain;
			lever.most_in = contest.Title();
		}
		++lever.contests;
	}
	double sum = 0;
	int count = 0;
	for (std::size_t i = 0; i < errors.size(); ++i)
	{
		sum += lever.at[i];
		count += told[i];
		lever.at[i] = std::exp(lever.at[i] / std::max(1, told[i]));
	}
	lever.mean = std::exp(sum / std::max(1, count));
	return lever;
}

std::vector<std::string> Fields(const std::string& line)
{
	std::vector<std::string> fields;
	std::istringstream in(line);
	for (std::string field; std::getline(in, field, ',');)
		fields.push_back(field);
	return fields;
}

struct Means
{
	double raw = 0, best = 0;
};

// Geometric means over errors against stock, by contest, of a race's ratios.csv; empty where there is none.
std::map<std::string, Means> MeansOf(const fs::path& ratios)
{
	std::ifstream in(ratios);
	std::map<std::string, Means> sums;
	std::map<std::string, int> counts;
	for (std::string line; std::getline(in, line);)
	{
		const std::vector<std::string> f = Fields(line);
		if (f.size() < 7 || f[1] != "stock" || f[2] != "rms")
			continue;
		sums[f[0]].raw += std::log(std::stod(f[4]));
		sums[f[0]].best += std::log(std::stod(f[6]));
		++counts[f[0]];
	}
	for (auto& [name, means] : sums)
		means = {std::exp(means.raw / counts[name]), std::exp(means.best / counts[name])};
	return sums;
}

std::optional<Means> MeanOf(const std::map<std::string, Means>& scenes)
{
	if (scenes.empty())
		return {};
	Means sum;
	for (const auto& [name, means] : scenes)
	{
		sum.raw += std::log(means.raw) / double(scenes.size());
		sum.best += std::log(means.best) / double(scenes.size());
	}
	return Means{std::exp(sum.raw), std::exp(sum.best)};
}

}

std::vector<Lever> Levers(const RaceReport& report)
{
	std::vector<Lever> levers;
	const auto add = [&](const char* title, const Chosen& without, const Chosen& with) {
		const Lever lever = Worth(report, title, without, with);
		if (lever.contests > 0)
			levers.push_back(lever);
	};
	add("Sobol' points in four dimensions, over stock's fixed settings", StocksFixed, Fixed);
	add("one light sample a lens sample, over stock's grids (scenes with area lights)", Grid, Fixed);
	add("adaptive samples", Fixed, NotDenoised);
	add("denoise", Fixed, NotAdaptive);
	add("adaptive samples and denoise", Fixed, Ours);
	return levers;
}

std::string LeversSection(const RaceReport& report)
{
	const std::vector<Lever> levers = Levers(report);
	if (levers.empty())
		return "";
	std::string text = "<h3>What each lever is worth alone</h3>\n<p>Time without it over time with it, where it is quicker, at equal error; geometric means over scenes. "
		"The last three over our own fixed samples.</p>\n<table><tr><th></th>";
	for (double error : report.settings.errors)
		text += fmt::format("<th>at {:g}</th>", error);
	text += "<th>mean</th><th>least</th><th>most</th></tr>\n";
	for (const Lever& lever : levers)
	{
		text += "<tr><td>" + lever.title + "</td>";
		for (double gain : lever.at)
			text += fmt::format("<td>{:.2f}</td>", gain);
		text += fmt::format("<td><b>{:.2f}</b></td><td>{:.2f}, {}</td><td>{:.2f}, {}</td></tr>\n", lever.mean, lever.least, lever.least_in, lever.most, lever.most_in);
	}
	return text + "</table>\n";
}

std::string SizesSection(const RaceReport& report, const fs::path& out)
{
	std::vector<std::pair<std::string, std::map<std::string, Means>>> sizes = {{fmt::format("{} x {}", report.settings.width, report.settings.height), MeansOf(out / "ratios.csv")}};
	for (const char* size : {"640x360", "1920x1080"})
	{
		const auto means = MeansOf(out / size / "ratios.csv");
		if (!means.empty())
			sizes.emplace_back(fmt::format("<a href=\"{0}/report.html\">{0}</a>", size), means);
	}
	if (sizes.size() < 2)
		return "";
	std::string text = "<h3>Larger pictures</h3>\n<p>Time of stock's best setting over ours, raw / best, geometric means over the errors above. Larger pictures of a scene have less in a pixel, "
		"so that the same error takes fewer samples; below stock's least setting nothing can be gained. The sizes are not of one region: the whole picture at 160 x 120 and 640 x 360, "
		"the middle quarter each way at 1920 x 1080, where denoise has the pixels around it to trace too (how many: that page). Means are of the scenes that a size has. Curves: the pages behind the sizes.</p>\n<table><tr><th>scene</th>";
	for (const auto& size : sizes)
		text += "<th>" + size.first + "</th>";
	text += "</tr>\n";
	std::set<std::string> names;
	for (std::size_t i = 1; i < sizes.size(); ++i)
		for (const auto& [name, means] : sizes[i].second)
			names.insert(name);
	const auto row = [&](const std::string& title, const auto& means_of) {
		text += "<tr><td>" + title + "</td>";
		for (const auto& size : sizes)
		{
			const std::optional<Means> means = means_of(size.second);
			text += means ? fmt::format("<td>{:.2f} / {:.2f}</td>", means->raw, means->best) : "<td>-</td>";
		}
		text += "</tr>\n";
	};
	for (const std::string& name : names)
		row(name, [&](const std::map<std::string, Means>& size) {
			const auto found = size.find(name);
			return found == size.end() ? std::nullopt : std::make_optional(found->second);
		});
	row("geometric mean", [](const std::map<std::string, Means>& size) { return MeanOf(size); });
	return text + "</table>\n";
}
