// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The files of `tiltcal profile`: CSV, plot, pictures side by side.

#include "profile/profile.h"

#include "base/file_set.h"
#include "base/files.h"
#include "program/gnuplot.h"
#include "picture/image_io.h"

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include <filesystem>
#include <fstream>

namespace tiltcal
{

namespace
{

/// As in the paper: first line red, second green; then on.
const struct { const char* name; int r, g, b; } COLOURS[] = {
	{ "red", 214, 39, 40 }, { "green", 30, 150, 60 }, { "blue", 40, 100, 220 }, { "orange", 240, 140, 20 }, { "violet", 140, 70, 190 }
};
const size_t COLOUR_COUNT = sizeof(COLOURS) / sizeof(COLOURS[0]);

std::string CsvName(const std::string& folder, size_t k) { return Join(folder, fmt::format("profile-{}.csv", k + 1)); }

const std::string CSV_HEADER = "position_px,x_px,y_px,a,b";

/// Whether an earlier run wrote it: what is somebody else's is not removed.
bool IsOwnCsv(const std::string& file)
{
	std::ifstream in(file);
	std::string line;
	return std::getline(in, line) && line == CSV_HEADER;
}

std::string Csv(const LineProfile& p)
{
	std::string csv = CSV_HEADER + "\n";
	for (const ProfileSample& s : p.samples)
		csv += fmt::format("{:.3f},{:.3f},{:.3f},{:.4f},{:.4f}\n", s.position, s.x, s.y, s.a, s.b);
	return csv;
}

/// `data`: the files of the lines.
void PlotProfiles(const Comparison& c, const ComparedFiles& files, const std::vector<std::string>& data, const std::string& folder, FileSet& set)
{
	const std::string title_a = GnuplotString("A: " + std::filesystem::path(files.a).filename().string());
	const std::string title_b = GnuplotString("B: " + std::filesystem::path(files.b).filename().string() + (c.match == Match::NONE ? "" : ", matched"));
	std::string script = fmt::format("set datafile separator ','\nset multiplot layout {},1\nset yrange [0:260]\nset ylabel 'brightness'\n"
		"set grid lc rgb '#dddddd'\nset key bottom right horizontal\nset lmargin 8\n", c.lines.size());
	for (size_t k = 0; k < c.lines.size(); ++k)
	{
		const auto& colour = COLOURS[k % COLOUR_COUNT];
		const std::string file = GnuplotString(data[k]);
		script += fmt::format("set title {}\nset xlabel 'position on the line [px]'\n"
			"plot {} every ::1 using 1:4 with lines lw 2 lc rgb '#{:02x}{:02x}{:02x}' title {}, {} every ::1 using 1:5 with lines lw 1.2 lc rgb '#202020' title {}\n",
			GnuplotString(fmt::format("{} line {}: mean absolute error {:.2f}", colour.name, c.lines[k].line.text, c.lines[k].mean_abs_error)),
			file, colour.r, colour.g, colour.b, title_a, file, title_b);
	}
	script += "unset multiplot\n";
	Plot(set, Join(folder, "profile.png"), script, 1100, 80 + 330 * static_cast<int>(c.lines.size()));
}

cv::Mat WithLines(const cv::Mat& linear, double gain, const Comparison& c)
{
	cv::Mat picture;
	cv::Mat display = ToDisplay(linear, gain);
	if (display.channels() == 1)
		cv::cvtColor(display, picture, cv::COLOR_GRAY2BGR);
	else
		picture = display;
	const int thickness = std::max(1, picture.cols / 600);
	for (size_t k = 0; k < c.lines.size(); ++k)
	{
		const Line& l = c.lines[k].line;
		const auto& colour = COLOURS[k % COLOUR_COUNT];
		cv::line(picture, cv::Point(cvRound(l.x0), cvRound(l.y0)), cv::Point(cvRound(l.x1), cvRound(l.y1)),
			cv::Scalar(colour.b, colour.g, colour.r), thickness, cv::LINE_AA);
	}
	return picture;
}

}

void WriteComparison(const Comparison& c, const cv::Mat& a, const ComparedFiles& files, const std::string& folder, FileSet& set)
{
	const bool plotted = IsOwnCsv(CsvName(folder, 0));   // a plot is written with its first line's file
	std::vector<std::string> data;
	for (size_t k = 0; k < c.lines.size(); ++k)
		data.push_back(set.Text(CsvName(folder, k), Csv(c.lines[k])));
	// Those of an earlier run with more lines.
	for (size_t k = c.lines.size(); IsOwnCsv(CsvName(folder, k)); ++k)
		set.Remove(CsvName(folder, k));
	if (!c.lines.empty())
		PlotProfiles(c, files, data, folder, set);
	else if (plotted)
		set.Remove(Join(folder, "profile.png"));
	cv::Mat both;
	const cv::Mat gap(a.rows, std::max(4, a.cols / 100), CV_8UC3, cv::Scalar::all(255));
	// One gain: what is brighter looks so.
	const cv::Mat as_compared = c.gain * Luminance(a);
	const double gain = DisplayGain(as_compared);
	cv::hconcat(std::vector<cv::Mat>{ WithLines(as_compared, gain, c), gap, WithLines(c.matched, gain, c) }, both);
	set.Text(Join(folder, "side-by-side.png"), PngOf(both));
}

}
