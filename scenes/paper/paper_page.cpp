// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_page.h"

#include "paper_brightness.h"
#include "paper_page_parts.h"
#include "paper_pictures.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "base/plain_text.h"
#include "program/gnuplot.h"
#include "report/html.h"
#include "picture/image_io.h"

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace paper
{

namespace
{

/// Widest preview, and most bytes of one.
const int PREVIEW = 900;
const size_t PREVIEW_BYTES = 220000;

const char* const HEAD = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"/><meta name="viewport" content="width=device-width"/><title>A real tilted lens: photograph and render</title>
<style>
body { font: 15px/1.5 "Helvetica Neue", Arial, sans-serif; color: #222; max-width: 1180px; margin: 0 auto; padding: 0 20px 60px }
h1 { font-size: 28px; margin: 26px 0 4px } h2 { font-size: 22px; margin: 46px 0 8px; border-bottom: 2px solid #1565c0 } h3 { font-size: 17px; margin: 26px 0 6px }
p, dl { max-width: 860px } code { background: #f2f2f2; padding: 1px 4px; overflow-wrap: anywhere } pre { background: #f2f2f2; padding: 10px; white-space: pre-wrap }
.wide { overflow-x: auto; margin: 10px 0 16px }
table { border-collapse: collapse; font-size: 14px } th, td { padding: 4px 10px; border-bottom: 1px solid #ddd; text-align: right; vertical-align: top }
td { font-variant-numeric: tabular-nums } th { font-weight: 600; background: #f6f6f6 } th:first-child { text-align: left; font-weight: 400 } tr:first-child th { vertical-align: bottom; font-weight: 600 }
dt { font-weight: 600; margin-top: 8px } dd { margin-left: 20px } small { color: #555 } figure { margin: 0 } figcaption { font-size: 13px; color: #444 }
.lead { font-size: 17px } .note { border-left: 6px solid #f9a825; background: #fff8e1; padding: 8px 14px }
.pair { display: grid; grid-template-columns: 1fr 1fr; gap: 20px; align-items: start } .pair img, .plot { width: 100%; height: auto; display: block }
.three { display: grid; grid-template-columns: 1fr 1fr 1fr; gap: 16px } .arrows { width: 100%; height: auto; display: block }
.key span { margin-right: 16px; white-space: nowrap } .bars { width: 100%; height: auto } .bars text { font: 13px "Helvetica Neue", Arial, sans-serif; fill: #222 } .bars text.head { font-weight: 600; font-size: 15px }
.tabs > input { position: absolute; opacity: 0 } .tabs > label { display: inline-block; padding: 6px 16px; border: 1px solid #bbb; border-radius: 4px 4px 0 0; cursor: pointer; margin-right: 4px }
.tabs > input:checked + label { background: #1565c0; color: #fff; border-color: #1565c0 } .tabs > input:focus-visible + label { outline: 2px solid #222 } .tabs .pane { display: none }
#tab0:checked ~ .pane0, #tab1:checked ~ .pane1, #tab2:checked ~ .pane2 { display: block }
.split { position: relative; --at: 50%; user-select: none } .split img { display: block; width: 100%; height: auto }
.split .over { position: absolute; inset: 0; clip-path: inset(0 calc(100% - var(--at)) 0 0) }
.split i { position: absolute; top: 0; bottom: 0; left: var(--at); width: 2px; margin-left: -1px; background: #fff; box-shadow: 0 0 3px #000; pointer-events: none }
.split i::after { content: "◂ ▸"; position: absolute; top: 50%; left: -21px; width: 44px; text-align: center; background: #fff; border-radius: 12px; font: 14px sans-serif; box-shadow: 0 0 3px #000 }
.split input { position: absolute; inset: 0; width: 100%; height: 100%; margin: 0; opacity: 0; cursor: ew-resize }
.split span { position: absolute; bottom: 8px; padding: 2px 8px; background: #000a; color: #fff; font-size: 13px; pointer-events: none } .split .l { left: 8px } .split .r { right: 8px }
.lined { position: relative } .lined img { display: block; width: 100%; height: auto } .lined svg { position: absolute; inset: 0; width: 100%; height: 100% }
.scale { width: 560px; max-width: 100%; height: auto } .scale text { font: 13px "Helvetica Neue", Arial, sans-serif }
td { white-space: nowrap } @media (max-width: 760px) { .pair, .three { grid-template-columns: 1fr } }
@media print { .tabs .pane { display: block } h2 { break-before: page } figure, svg { break-inside: avoid } }
</style></head><body>
)";

const char* const SCRIPT = R"(<script>
document.querySelectorAll('.split').forEach(function (split) {
	var input = split.querySelector('input');
	input.addEventListener('input', function () { split.style.setProperty('--at', input.value + '%'); });
});
</script>
)";

std::string Jpeg(const cv::Mat& picture) { return tiltcal::html::JpegUri(picture, PREVIEW, PREVIEW_BYTES); }

std::string FileUri(const std::string& file)
{
	const cv::Mat picture = cv::imread(file, cv::IMREAD_COLOR);
	if (picture.empty())
		throw tiltcal::FileError(file + ": no picture that can be read");
	return Jpeg(picture);
}

struct StateImages
{
	std::string photograph, render;   ///< data: URIs
};

StateImages Images(const Json& results, const std::string& out, const std::string& state)
{
	const cv::Mat render = tiltcal::ReadLinear(out + "/demo/render-" + state + ".exr", tiltcal::Transfer{});
	const cv::Mat shown = tiltcal::ToDisplay(render, results.at("states").at(state).at("gain"));
	tiltcal::WritePng(out + "/render-" + state + ".png", shown);
	const std::string photo = std::string(results.at("conditions").at("photos")) + "/scene/" + state + ".jpg";
	// Beside the page, as it is, so that the page's links work wherever the folder goes.
	const std::string copy = out + "/photograph-" + state + "." + std::string(results.at("conditions").at("format"));
	std::filesystem::copy_file(photo, copy, std::filesystem::copy_options::overwrite_existing);
	return { FileUri(copy), Jpeg(shown) };
}

std::string Divider(const StateImages& images, const std::string& state)
{
	return fmt::format("<div class=\"split\"><img alt=\"render, {0}\" src=\"{2}\"/><img class=\"over\" alt=\"photograph, {0}\" src=\"{1}\"/><i></i>"
		"<span class=\"l\">photograph</span><span class=\"r\">render</span><input type=\"range\" min=\"0\" max=\"100\" step=\"0.1\" value=\"50\" aria-label=\"photograph to the left of here, render to the right: {0}\"/></div>\n",
		Title(state), images.photograph, images.render);
}

std::string Dividers(const std::vector<StateImages>& images)
{
	std::string tabs, panes;
	for (size_t s = 0; s < images.size(); ++s)
	{
		tabs += fmt::format("<input type=\"radio\" name=\"tab\" id=\"tab{0}\"{1}/><label for=\"tab{0}\">{2}</label>", s, s == 1 ? " checked=\"checked\"" : "", Title(STATES[s]));
		panes += fmt::format("<div class=\"pane pane{}\">{}</div>\n", s, Divider(images[s], STATES[s]));
	}
	return "<div class=\"tabs\">" + tabs + "\n" + panes + "</div>\n";
}

std::string Lined(const std::string& uri, const std::string& alt)
{
	return fmt::format("<figure class=\"lined\"><img alt=\"{0}\" src=\"{1}\"/><svg viewBox=\"0 0 1800 1200\" aria-hidden=\"true\"><path d=\"M0 {2}H1800\" stroke=\"#e02020\" stroke-width=\"5\"/>"
		"<path d=\"M{3} 0V1200\" stroke=\"#10b040\" stroke-width=\"5\"/></svg></figure>\n", alt, uri, RED_ROW, GREEN_COLUMN);
}

/// Both lines of one state, from the CSVs of tiltcal profile.
std::string ProfilePlot(const Json& results, const std::string& out, const std::string& state)
{
	const Json& error = results.at("brightness").at(state).at("gain");
	std::string script = "set datafile separator ','\nset multiplot layout 2,1\nset yrange [0:260]\nset ylabel 'brightness'\nset grid lc rgb '#dddddd'\nset key top right horizontal\nset lmargin 8\n";
	static const struct { const char *name, *colour, *axis; int file, end; } lines[] = {
		{ "red", "#d62728", "column [px], row 660", 1, 1799 }, { "green", "#1e963c", "row [px], column 900", 2, 1199 } };
	for (const auto& line : lines)
	{
		const std::string csv = tiltcal::GnuplotString(fmt::format("{}/demo/profiles/{}-gain/profile-{}.csv", out, state, line.file));
		script += fmt::format("set xrange [0:{}]\nset xlabel '{}'\nset title '{} line: mean absolute difference {:.2f} levels'\n"
			"plot {} every ::1 using 1:4 with lines lw 2.4 lc rgb '{}' title 'photograph', {} every ::1 using 1:5 with lines lw 1 lc rgb '#101010' title 'render'\n",
			line.end, line.axis, line.name, double(error.at(line.name)), csv, line.colour, csv);
	}
	const std::string file = out + "/profile-" + state + ".svg";
	tiltcal::Plot(file, script + "unset multiplot\n", 1140, 620);
	return SvgImage(file, "Brightness along both lines, " + Title(state));
}

std::string Profiles(const Json& results, const std::string& out, const std::vector<StateImages>& images)
{
	std::string text = "<h2>Figures 11 to 15: photograph, render, and profiles along two lines</h2>\n"
		"<p>The paper’s pictures are not ours to copy, and we do not have them; its numbers stand beside ours in Table 2. Here are the same things of our scene: for each state photograph (left) and render (right) with the two lines, "
		"and the brightness along them.</p>\n";
	for (size_t s = 0; s < images.size(); ++s)
	{
		const std::string state = STATES[s];
		text += fmt::format("<h3>{}</h3>\n<div class=\"pair\">{}{}</div>\n{}", Title(state), Lined(images[s].photograph, "photograph with the lines, " + Title(state)),
			Lined(images[s].render, "render with the lines, " + Title(state)), ProfilePlot(results, out, state));
		text += fmt::format("<p><small>Full size: <a href=\"photograph-{0}.{1}\">photograph</a>, <a href=\"render-{0}.png\">render</a>.</small></p>\n", state,
			std::string(results.at("conditions").at("format")));
	}
	return text;
}

std::string Scale()
{
	std::string out = "<svg class=\"scale\" viewBox=\"0 0 560 52\" role=\"img\" aria-label=\"scale of the differences\">\n";
	for (int k = 0; k < 256; ++k)
	{
		const auto colour = DifferenceColour((k - 127.5) / 127.5);
		out += fmt::format("<rect x=\"{:.2f}\" y=\"4\" width=\"2.1\" height=\"20\" fill=\"#{:02x}{:02x}{:02x}\"/>", 24 + 2.0 * k, colour[2], colour[1], colour[0]);
	}
	for (int k = -2; k <= 2; ++k)
		out += fmt::format("<text x=\"{}\" y=\"42\" text-anchor=\"middle\">{}{}</text>", 280 + 128 * k, k > 0 ? "+" : "", tiltcal::html::Number(COLOUR_LEVELS * k / 2, 0));
	return out + "</svg>\n";
}

std::string DifferenceSection(const Json& results, const std::string& out)
{
	std::string text = "<h2>Difference pictures</h2>\n<p>Photograph − gain × render, in levels of 255: red where the photograph is brighter. Beside it what noise and compression alone would leave (the render’s own photograph − the render): "
		"the left can become like the right, but no better.</p>\n" + Scale();
	for (const std::string state : STATES)
	{
		const Json& measured = results.at("states").at(state).at("picture").at("measured");
		text += fmt::format("<h3>{0}</h3>\n<div class=\"pair\"><figure><img alt=\"difference, {0}\" src=\"{1}\"/><figcaption>photograph − render: mean {2}, RMS {3}. <a href=\"difference-{7}.png\">Full size</a></figcaption></figure>\n"
			"<figure><img alt=\"noise alone, {0}\" src=\"{4}\"/><figcaption>noise alone: mean {5}, RMS {6}. <a href=\"noise-{7}.png\">Full size</a></figcaption></figure></div>\n", Title(state),
			FileUri(out + "/difference-" + state + ".png"), tiltcal::html::Number(measured.at("gain").at("mean_abs"), 2), tiltcal::html::Number(measured.at("gain").at("rms"), 2),
			FileUri(out + "/noise-" + state + ".png"), tiltcal::html::Number(measured.at("noise").at("mean_abs"), 2), tiltcal::html::Number(measured.at("noise").at("rms"), 2), state);
	}
	return text + "<p><small>The page shows the pictures at half their size, where grain averages; the figures are of the full size.</small></p>\n";
}

/// "45 mm lens at f/2.8"
std::string Nominal(const Json& results)
{
	const Json& nominal = results.at("lens").at("nominal");
	const double f = nominal.at("focal_length_mm").at("value"), d = nominal.at("aperture_diameter_mm").at("value");
	return fmt::format("{:.0f} mm lens at f/{:.1f}", f, f / d);
}

void PlotCurve(const Json& results, const std::string& out)
{
	std::string data;
	double least_x = 1e9, most_x = 0, least_y = 1e9, most_y = 0;
	for (const Json& point : results.at("curve"))
	{
		const double x = point.at("cpu_seconds"), y = point.at("rms");
		data += fmt::format("{} {} {}\n", x, y, int(point.at("samples")));
		least_x = std::min(least_x, x);
		most_x = std::max(most_x, x);
		least_y = std::min(least_y, y);
		most_y = std::max(most_y, y);
	}
	const std::string script = fmt::format("$data << EOD\n{}EOD\nset logscale xy\nset xrange [{}:{}]\nset yrange [{}:{}]\nset xtics add ('0.5' 0.5, '2' 2, '5' 5, '20' 20, '50' 50)\n"
		"set ytics add ('0.2' 0.2, '0.5' 0.5, '2' 2, '5' 5)\nset grid lc rgb '#dddddd'\nset xlabel 'CPU seconds for a tenth of the picture'\nset ylabel 'sampling noise, RMS levels of 255'\nunset key\n"
		"plot $data using 1:2 with linespoints lw 2 pt 7 lc rgb '#1565c0', $data using 1:2:3 with labels offset 2,1\n", data, least_x / 1.5, most_x * 2, least_y / 1.5, most_y * 1.8);
	tiltcal::Plot(out + "/curve.svg", script, 560, 360);
}

}

std::string SvgImage(const std::string& file, const std::string& alt)
{
	if (!std::filesystem::exists(file))
		return "<p><small>No plot: gnuplot is not installed.</small></p>\n";
	std::string uri = "data:image/svg+xml,";
	for (const char c : tiltcal::ReadText(file, "a plot"))
	{
		const bool plain = std::isalnum(static_cast<unsigned char>(c)) || std::string("-_.!~*()/:;=@,+ ").find(c) != std::string::npos;
		uri += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
	}
	return fmt::format("<img class=\"plot\" alt=\"{}\" src=\"{}\"/>\n", tiltcal::HtmlText(alt), uri);
}

void WritePage(const std::string& out)
{
	const Json results = ReadJson(out + "/results.json");
	std::vector<StateImages> images;
	for (const char* const state : STATES)
		images.push_back(Images(results, out, state));
	PlotCurve(results, out);
	const std::string text = std::string(HEAD) + "<h1>A real tilted lens: photograph and render</h1>\n"
		"<p class=\"lead\">Left of the line a photograph through a tilted " + Nominal(results) + ", right of it the same scene rendered through the camera that <code>tiltcal</code> found from "
		+ std::to_string(int(results.at("conditions").at("board_photographs"))) + " photographs of a checkerboard. "
		"The experiment is that of Baba, Nakane and Hiura, <i>Camera Calibration and Rendering of Real Tilted Lens</i>. Drag the line.</p>\n"
		+ Dividers(images) + Headline(results) + TiltSection(results) + BrightnessSection(results) + Profiles(results, out, images) + DifferenceSection(results, out)
		+ AblationSection(results, out) + ReproduceSection(results) + SCRIPT + "</body></html>\n";
	tiltcal::WriteText(out + "/report.html", text);
}

}
