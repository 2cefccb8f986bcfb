// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;

const char* Sign(const Ratio& ratio)
{
	if (ratio.AtFloor())
		return "?";
	return ratio.at_least && !ratio.at_most ? ">" : ratio.at_most && !ratio.at_least ? "<" : ratio.at_least ? "~" : "";
}

// Against our own without denoise there is no ratio without denoise.
static std::string Both(const Ratio& raw, const Ratio& best, Opponent opponent)
{
	return (opponent == Opponent::RAW ? "," : fmt::format("{:.4f},{}", raw.value, Sign(raw))) + fmt::format(",{:.4f},{}", best.value, Sign(best));
}

static std::ofstream Open(const fs::path& path, const char* head)
{
	std::ofstream file(path);
	if (!file)
		throw std::runtime_error("cannot write " + path.string());
	file << head << '\n';
	return file;
}

void WriteTables(const RaceReport& report, const fs::path& out)
{
	std::ofstream points = Open(out / "points.csv",
		"contest,opponent,setting,cpu_s,spread,rms,rms_truth,rms_shifted,rms_limit,rel_mse,max_rss_mib,worse_blocks");
	std::ofstream ratios = Open(out / "ratios.csv", "contest,opponent,measure,error,raw_ratio,raw_sign,best_ratio,best_sign");
	std::ofstream truths = Open(out / "truths.csv",
		"contest,samples,own_error,pinholes,pinhole_distance,pinhole_error,stock_limit_distance,stock_limit_error,stock_dx,stock_dy");
	for (const Contest& contest : report.contests)
	{
		for (const auto& [opponent, list] : contest.points)
			for (const RacePoint& point : list)
				points << fmt::format("{},{},\"{}\",{:.4f},{:.4f},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.1f},{}\n", contest.Name(),
					Name(opponent), Label(point.setting), point.Time(), point.Spread(), point.Rms(), point.rms_truth,
					point.rms_shifted, point.rms_limit, point.rel_mse, point.rss,
					point.worse_blocks < 0 ? "" : fmt::format("{:.4f}", point.worse_blocks));
		for (Opponent opponent : {contest.Rival(), Opponent::RAW, Opponent::FIXED})
		{
			for (double error : contest.Told(report.settings.errors))
			{
				ratios << fmt::format("{},{},rms,{:g},{}\n", contest.Name(), Name(opponent), error,
					Both(RatioAt(contest, opponent, error, Side::RAW), RatioAt(contest, opponent, error, Side::BEST), opponent));
			}
			for (double error : report.settings.rel_mse)
			{
				ratios << fmt::format("{},{},relmse,{:g},{}\n", contest.Name(), Name(opponent), error,
					Both(RelMseRatioAt(contest, opponent, error, Side::RAW), RelMseRatioAt(contest, opponent, error, Side::BEST), opponent));
			}
		}
		truths << fmt::format("{},{},{:.3g},{},{:.3g},{:.3g},{:.3g},{:.3g},{:.4f},{:.4f}\n", contest.Name(), contest.truth_samples,
			contest.truth_error, contest.pinhole_frames, contest.pinhole_distance, contest.pinhole_error, contest.limit_distance,
			contest.limit_error, contest.stock_offset.dx, contest.stock_offset.dy);
	}
}

void MeanRatio::Add(const Ratio& ratio)
{
	log_sum += std::log(ratio.value);
	++count;
	at_floor = at_floor || ratio.AtFloor();
}

double MeanRatio::Value() const
{
	return count > 0 ? std::exp(log_sum / count) : 0;
}

std::string MeanRatio::InWords() const
{
	return fmt::format("{}{:.2f}", at_floor ? "?" : "", Value());
}

MeanRatio MeanAgainst(const RaceReport& report, Opponent rival, Side side)
{
	MeanRatio mean;
	for (const Contest& contest : report.contests)
		if (contest.points.find(rival) != contest.points.end())
			for (double error : contest.Told(report.settings.errors))
				mean.Add(RatioAt(contest, rival, error, side));
	return mean;
}

double GeometricMean(const RaceReport& report, Opponent rival, Side side)
{
	return MeanAgainst(report, rival, side).Value();
}

std::string RatiosInWords(const RaceReport& report)
{
	std::string text = fmt::format("{:<22}", "raw / best, at");
	for (double error : report.settings.errors)
		text += fmt::format("{:>18g}", error);
	text += '\n';
	for (const Contest& contest : report.contests)
	{
		text += fmt::format("{:<22}", contest.Name());
		for (double error : report.settings.errors)
		{
			const auto one = [&](Side side) {
				if (!contest.Tells(error))
					return std::string("-");
				const Ratio ratio = RatioAt(contest, contest.Rival(), error, side);
				return fmt::format("{}{:.2f}", Sign(ratio), ratio.value);
			};
			text += fmt::format("{:>10} /{:>6}", one(Side::RAW), one(Side::BEST));
		}
		text += '\n';
	}
	return text;
}

std::string WhereWeLose(const RaceReport& report, Side side)
{
	struct Cell
	{
		std::string where;
		double value;
	};
	std::string text;
	for (Opponent rival : {Opponent::STOCK, Opponent::PINHOLES, Opponent::FIXED})
	{
		std::vector<Cell> cells;
		for (const Contest& contest : report.contests)
			if (contest.points.find(rival) != contest.points.end())
				for (double error : contest.Told(report.settings.errors))
				{
					const Ratio ratio = RatioAt(contest, rival, error, side);
					cells.push_back({fmt::format("{} at {:g} ({}{:.2f})", contest.Title(), error, Sign(ratio), ratio.value), ratio.value});
				}
		if (cells.empty())
			continue;
		std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.value < b.value; });
		const char* name = rival == Opponent::STOCK ? "Stock focal blur" : rival == Opponent::PINHOLES ? "Averaged pinholes" : "Our own fixed N";
		std::string lost;
		for (const Cell& cell : cells)
			if (cell.value < 1)
				lost += (lost.empty() ? "" : "; ") + cell.where;
		if (!lost.empty())
			text += fmt::format("{}: <b>we lose</b> in {}. ", name, lost);
		else
		{
			text += fmt::format("{}: we lose nowhere; the least gain is {}", name, cells[0].where);
			for (std::size_t i = 1; i < std::min<std::size_t>(3, cells.size()); ++i)
				text += "; " + cells[i].where;
			text += ". ";
		}
	}
	return text;
}
