// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrator_report.h"

#include "base/files.h"
#include "program/gnuplot.h"
#include "report/write_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace calibrator_cost
{

namespace
{

/// Empty where there is nothing to say.
std::string Number(double value, int digits, bool known = true) { return known ? fmt::format("{:.{}f}", value, digits) : ""; }

std::string Csv(const std::vector<Row>& rows)
{
	std::string csv = "data,vary,photos_per_state,edges_per_photo,model,draws,answers,error_rms_deg,bias_deg,scatter_deg,"
		"detection_cpu_s,measuring_cpu_s,solving_cpu_s,total_cpu_s\n";
	for (const Row& r : rows)
	{
		const bool any = r.answers > 0;
		csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{:.3f},{:.3f},{:.3f},{:.3f}\n", tiltcal::CsvField(r.data), r.vary, r.effort.photos,
			r.effort.edges ? std::to_string(r.effort.edges) : "all", r.model, r.draws, r.answers, Number(r.rms, 5, any), Number(r.bias, 5, any),
			Number(r.scatter, 5, r.scatter >= 0), r.preparation.detection, r.preparation.measuring, r.solving, r.Seconds());
	}
	return csv;
}

std::string Html(const std::vector<Row>& rows)
{
	std::string html = "<table class=\"calibrator-cost\">\n<caption>Error of the found tilt, degrees, and what it costs: CPU seconds, states untilted, +5 and &minus;5 together. "
		"Error is RMS over draws of photographs, edges or noise; bias the mean error; scatter the standard deviation, as of new draws.</caption>\n"
		"<thead><tr><th>data</th><th>photographs per state</th><th>edges per photograph</th><th>model</th><th>answers</th><th>error</th><th>bias</th><th>scatter</th>"
		"<th>detecting s</th><th>measuring s</th><th>solving s</th><th>total s</th></tr></thead>\n<tbody>\n";
	for (const Row& r : rows)
	{
		// The row of all edges is already there as that of all photographs.
		if (r.vary == "edges" && r.effort.edges == 0)
			continue;
		const bool any = r.answers > 0;
		html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{} of {}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.2f}</td>"
			"<td>{:.2f}</td><td>{:.2f}</td></tr>\n", r.data, r.effort.photos, r.effort.edges ? std::to_string(r.effort.edges) : "all", r.model, r.answers, r.draws,
			Number(r.rms, 4, any), Number(r.bias, 4, any), Number(r.scatter, 4, r.scatter >= 0), r.preparation.detection, r.preparation.measuring, r.solving, r.Seconds());
	}
	return html + "</tbody>\n</table>\n";
}

/// A gnuplot data block: seconds, degrees and effort of one curve.
std::string Block(const std::vector<Row>& rows, const std::string& name, const std::string& data, const std::string& vary, const std::string& model, bool scatter)
{
	std::string block = "$" + name + " << EOD\n";
	int points = 0;
	for (const Row& r : rows)
	{
		const double y = scatter ? r.scatter : r.rms;
		if (r.data != data || r.vary != vary || r.model != model || r.answers == 0 || !(y > 0))
			continue;
		block += fmt::format("{:.5g} {:.5g} {}\n", r.Seconds(), y, vary == "photos" ? std::to_string(r.effort.photos) : r.effort.edges ? std::to_string(r.effort.edges) : "all");
		++points;
	}
	// gnuplot refuses to plot an empty block.
	return block + (points ? "" : "NaN NaN -\n") + "EOD\n";
}

struct Panel
{
	const char* title;
	const char* data;
	bool scatter;
	const char* seconds;
	const char* degrees;
	const char* key;
};

/// "[a:b]" around the panel's points: whole decades would waste most of it.
std::pair<std::string, std::string> Ranges(const std::vector<Row>& rows, const Panel& panel)
{
	double x0 = 1e30, x1 = 0, y0 = 1e30, y1 = 0;
	for (const Row& r : rows)
	{
		const double y = panel.scatter ? r.scatter : r.rms;
		if (r.data != panel.data || r.answers == 0 || !(y > 0))
			continue;
		x0 = std::min(x0, r.Seconds());
		x1 = std::max(x1, r.Seconds());
		y0 = std::min(y0, y);
		y1 = std::max(y1, y);
	}
	const auto range = [](double least, double most, double margin)
	{
		return least <= most ? fmt::format("[{:.4g}:{:.4g}]", least / margin, most * margin) : std::string("[*:*]");
	};
	return { range(x0, x1, 1.4), range(y0, y1, 1.6) };
}

std::string PanelScript(const std::vector<Row>& rows, const Panel& panel, size_t number)
{
	// Labels above or below the points, away from the curve nearby: rigid has less error, and more scatter.
	const double side = panel.scatter ? 0.8 : -0.8;
	const struct { const char* model; const char* colour; double label; } models[] = { { "paper", "#d55e00", 0.8 }, { "rigid", "#009e73", side }, { "plane", "#0072b2", -side }, { "curved", "#cc79a7", -side } };
	std::string blocks, curves, labels;
	for (const auto& m : models)
		for (const char* const vary : { "photos", "edges" })
		{
			const bool by_photos = vary == std::string("photos");
			const std::string name = fmt::format("{}_{}_{}", m.model, vary, number);
			blocks += Block(rows, name, panel.data, vary, m.model, panel.scatter);
			curves += fmt::format("{}${} using 1:2 with linespoints lc rgb '{}' lw 2 dt {} pt {} ps 0.7 title '{}: {}'", curves.empty() ? "" : ", ", name, m.colour,
				by_photos ? "1" : "'-'", by_photos ? 7 : 6, m.model, by_photos ? "photographs per state (numbers)" : "edges per photograph, 12 to all");
			if (by_photos)
				labels += fmt::format(", ${} using 1:2:3 with labels offset 0,{} font 'Sans,9' tc rgb '{}' notitle", name, m.label, m.colour);
		}
	const auto [x, y] = Ranges(rows, panel);
	return blocks + fmt::format("set title {}\nset xlabel {}\nset ylabel {}\nset xrange {}\nset yrange {}\n{}\nplot {}{}\n", tiltcal::GnuplotString(panel.title),
		tiltcal::GnuplotString(panel.seconds), tiltcal::GnuplotString(panel.degrees), x, y, panel.key, curves, labels);
}

std::string PlotScript(const std::vector<Row>& rows)
{
	// The thin lens leaves its upper right corner free in every run: the paper's model is quick and far off.
	const Panel panels[] = {
		{ "Photographs: error", "photographs", false, "CPU seconds: detecting, measuring, solving", "RMS error of the tilt [degrees]", "unset key" },
		{ "Photographs: scatter alone", "photographs", true, "CPU seconds: detecting, measuring, solving", "standard deviation of the tilt [degrees]", "unset key" },
		{ "Exact thin lens, 0.06 px noise: error", "thin lens", false, "CPU seconds: solving", "RMS error of the tilt [degrees]",
			"set key top right samplen 3 spacing 1.1 font 'Sans,9'" },
	};
	std::string script = "set logscale xy\nset grid xtics ytics mytics lt 1 lc rgb '#cccccc', lt 1 lc rgb '#eeeeee'\n"
		"set xtics (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200)\n"
		"set ytics (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10)\nset multiplot layout 1,3\n";
	for (size_t k = 0; k < std::size(panels); ++k)
		script += PanelScript(rows, panels[k], k);
	return script + "unset multiplot\n";
}

}

void WriteReport(const std::vector<Row>& rows, const std::string& folder)
{
	tiltcal::WriteText(tiltcal::Join(folder, "calibrator-cost.csv"), Csv(rows));
	tiltcal::WriteText(tiltcal::Join(folder, "calibrator-cost.html"), Html(rows));
	tiltcal::Plot(tiltcal::Join(folder, "calibrator-cost.svg"), PlotScript(rows), 1500, 560);
}

}
