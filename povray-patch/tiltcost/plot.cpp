// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/report.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "program/gnuplot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcost
{

namespace
{

/// Tics where a reader looks for them: seconds, minutes, hours.
std::string TimeTics(double least, double greatest)
{
	std::string tics;
	const std::pair<double, const char*> all[] = {{0.1, "0.1 s"}, {0.2, "0.2 s"}, {0.5, "0.5 s"}, {1, "1 s"}, {2, "2 s"}, {5, "5 s"}, {10, "10 s"},
		{20, "20 s"}, {30, "30 s"}, {60, "1 min"}, {120, "2 min"}, {300, "5 min"}, {600, "10 min"}, {1200, "20 min"}, {1800, "30 min"}, {3600, "1 h"},
		{7200, "2 h"}, {18000, "5 h"}, {36000, "10 h"}, {86400, "1 day"}, {172800, "2 days"}, {604800, "1 week"}};
	for (const auto& [seconds, name] : all)
		if (seconds >= least && seconds <= greatest)
			tics += fmt::format("{}'{}' {:g}", tics.empty() ? "" : ", ", name, seconds);
	return tics;
}

std::string Points(const std::vector<Row>& rows, double least_error)
{
	std::string text;
	for (const Row& row : rows)
	{
		const Setting& s = row.setting;
		const std::string samples = s.min > 0 ? fmt::format("{}, {}", s.min, s.max) : fmt::format("{}", s.max);
		if (row.predicted.error >= least_error)
			text += fmt::format("{:.6g} {:.6g} \"{}; {:g}\"\n", row.predicted.error, row.wall, samples, s.variance);
	}
	return text + "e\n";
}

/// RMS levels are not proportional to RMS errors: an axis of tics at the rows themselves.
std::string LevelTics(const std::vector<Row>& rows)
{
	std::string tics;
	double last = 0;
	for (const Row& row : rows)
	{
		// Closer ones would run into each other.
		if (last > 0 && row.predicted.error > last / 1.3)
			continue;
		last = row.predicted.error;
		const double levels = row.predicted.Levels();
		tics += fmt::format("{}'{}' {:.6g}", tics.empty() ? "" : ", ", levels < 10 ? fmt::format("{:.2g}", levels) : fmt::format("{:.0f}", levels), row.predicted.error);
	}
	return tics;
}

}

void WritePlot(const Report& report, const std::string& file)
{
	double least_error = 1e9, greatest_error = 0, least = 1e9, greatest = 0;
	for (const auto* rows : {&report.rows, &report.own})
		for (const Row& row : *rows)
		{
			if (!(row.predicted.error > 0))
				continue;
			least_error = std::min(least_error, row.predicted.error);
			greatest_error = std::max(greatest_error, row.predicted.error);
			least = std::min(least, row.wall);
			greatest = std::max(greatest, row.wall);
		}
	if (greatest_error == 0)
		throw tiltcal::Refused(fmt::format("{}: not plotted, the picture has no error to plot", file));
	// Room for the words to the right of the points.
	least_error /= 2.2;
	greatest_error *= 1.3;
	least /= 1.5;
	greatest *= 1.5;

	const size_t stop = StopsPaying(report.rows, report.stop_levels);
	std::string script = fmt::format("set title {}\n", tiltcal::GnuplotString(fmt::format("{}: what accuracy costs at {} x {} pixels on {} thread{}",
		tiltcal::BaseName(report.scene), report.pilot.log.width, report.pilot.log.height, report.pilot.machine.threads, report.pilot.machine.threads > 1 ? "s" : "")));
	script += fmt::format("set logscale xy\nset xrange [{:g}:{:g}]\nset yrange [{:g}:{:g}]\n", greatest_error, least_error, least, greatest);
	script += "set xlabel 'RMS error of the picture (linear, white = 1), finer to the right'\nset ylabel 'render time'\n"
		"set x2label 'RMS error in levels of an 8-bit picture'\nset grid xtics ytics lt 1 lc rgb '#dddddd'\nset key top left reverse Left\nset bmargin 4\n";
	script += fmt::format("set xtics nomirror (0.1, 0.05, 0.03, 0.02, 0.01, 0.005, 0.003, 0.002, 0.001, 0.0005, 0.0003, 0.0002, 0.0001)\n"
		"set ytics ({})\nset logscale x2\nset x2range [{:g}:{:g}]\nset x2tics ({})\n", TimeTics(least, greatest), greatest_error, least_error, LevelTics(report.rows));
	std::string plots = "plot '-' using 1:2 with lines lw 2 lc rgb '#9db9d9' title 'best settings'", data = Points(report.best, least_error);
	const auto add = [&](const std::vector<Row>& rows, const char* style)
	{
		plots += std::string(", '-' using ") + style;
		data += Points(rows, least_error);
	};
	add(report.rows, "1:2 with points pt 7 ps 0.9 lc rgb '#1f5fa8' title 'the table (blur_samples; variance)'");
	add(report.rows, "1:2:3 with labels left offset 1,-0.6 font ',9' tc rgb '#444444' notitle");
	if (stop < report.rows.size())
		add({report.rows[stop]}, "1:2 with points pt 6 ps 2.4 lw 2 lc rgb '#d05a00' title 'here it stops paying'");
	if (!report.own.empty())
		add(report.own, "1:2 with points pt 2 ps 1.4 lw 2 lc rgb '#2a8a3a' title 'the settings asked for'");
	script += plots + "\n" + data;
	if (!tiltcal::Plot(file, script, 860, 560))
		throw tiltcal::FileError(fmt::format("{}: not plotted; gnuplot failed", file));
}

}
