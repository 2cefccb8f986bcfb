// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_page_parts.h"

#include "base/plain_text.h"
#include "report/html.h"

#include <fmt/format.h>

#include <cmath>

namespace paper
{

namespace
{

using tiltcal::html::Number;
using Rows = std::vector<std::vector<std::string>>;

std::string Cell(const Json& row, const char* name, const std::string& unit, int digits)
{
	return row.contains(name) ? WithSigma(row.at(name), unit, digits) : "–";
}

std::string TwoLines(const Json& errors) { return Number(errors.at("red"), 2) + " / " + Number(errors.at("green"), 2); }

const char* MethodName(const std::string& name)
{
	return name == "published" ? "the paper, its lens and photographs" : name == "paper" ? "the paper’s method on our photographs"
		: name == "rigid" ? "<code>rigid</code>: exact blur, the lens only turns" : name == "plane" ? "<code>plane</code>: exact blur, a free plane of focus"
		: name == "curved" ? "<code>curved</code>: and a bowl of focus" : name == "photometric" ? "<code>curved</code>, photometric refinement"
		: name == "default" ? "<b><code>lens</code>, the default: and six aberrations</b>" : name == "scene_lens" ? "the lens for scenes: sixteen (found in the same run)"
		: "for comparison: places of edges alone, no blur";
}

}

std::string WithSigma(const Json& estimate, const std::string& unit, int digits)
{
	if (estimate.at("value").is_null())
		return "–";
	return tiltcal::html::WithSigma({ estimate.at("value"), estimate.at("sigma").is_null() ? 0.0 : double(estimate.at("sigma")) }, unit, digits);
}

std::string Title(const std::string& state)
{
	return state == "plus5" ? "tilted +5°" : state == "minus5" ? "tilted −5°" : "untilted";
}

std::string Headline(const Json& results)
{
	const Json& methods = results.at("tilt").at("methods");
	const auto of = [&](const char* name) -> const Json&
	{
		for (const Json& method : methods)
			if (method.at("name") == name)
				return method.at("states");
		return methods.at(0).at("states");
	};
	Rows tilt{ { "lens tilt", "true", "the paper", "ours" } };
	for (const char* const state : { "plus5", "minus5" })
		tilt.push_back({ Title(state), Number(results.at("tilt").at("true").at(state), 0) + "°", WithSigma(of("published").at(state), "°", 3),
			"<b>" + WithSigma(of("default").at(state), "°", 3) + "</b>" });
	Rows brightness{ { "brightness error of 255, red / green line", "the paper", "ours" } };
	for (const char* const state : STATES)
	{
		const Json& row = results.at("brightness").at(state);
		brightness.push_back({ Title(state), TwoLines(row.at("published")), "<b>" + TwoLines(row.at("gain")) + "</b>" });
	}
	return "<div class=\"pair\"><div>" + tiltcal::html::Table(tilt) + "</div><div>" + tiltcal::html::Table(brightness) + "</div></div>\n";
}

std::string TiltSection(const Json& results)
{
	const Json& tilt = results.at("tilt");
	Rows rows{ { "", "+5°", "error", "−5°", "error", "seconds" } };
	for (const Json& method : tilt.at("methods"))
	{
		std::vector<std::string> row{ MethodName(method.at("name")) };
		for (const char* const state : { "plus5", "minus5" })
		{
			const Json& found = method.at("states").at(state);
			row.push_back(WithSigma(found, "°", 3));
			row.push_back(Number(double(found.at("value")) - double(tilt.at("true").at(state)), 3) + "°");
		}
		row.push_back(method.contains("seconds") ? Number(method.at("seconds"), 0) : "–");
		rows.push_back(row);
	}
	std::string out = "<h2>Table 1: the tilt of the lens</h2>\n<p>The true tilts are those of <code>camera.json</code>: the lens is traced, so that they are known and not measured. "
		"± is one standard deviation as the method itself gives it: it holds noise; of what the model leaves out the thin models hold only what scatters, the last two also how far parts of the edges and both lenses put the tilt apart. "
		"Seconds are of the whole run, by the clock; detecting the board and measuring its edges is the same in all.</p>\n" + tiltcal::html::Table(rows);
	out += "<p class=\"note\"><b>Not the same lens.</b> The paper photographed with a Canon TS-E 45 mm f/2.8. Ours are photographs through another 45 mm f/2.8 design, traced ray by ray "
		"through all surfaces of its prescription (<code>scenes/boxes/photos/README.md</code>), with noise, 8 bits and compression. "
		"What can be compared is the size of the errors, and the paper’s method against ours on the same photographs.</p>\n";
	const Json& lens = results.at("lens");
	Rows numbers{ { "", "image distance w", "aperture d", "focus distance U", "focal length f" } };
	static const struct { const char *key, *title; } lenses[] = { { "published", "the paper’s lens, published" }, { "paper", "ours, by the paper’s method" },
		{ "default", "<b>ours, default</b>" }, { "nominal", "ours, nominal (<code>camera.json</code>)" }, { "prescription", "ours, prescription (<code>truth.json</code>)" } };
	for (const auto& [key, title] : lenses)
		if (lens.contains(key))
			numbers.push_back({ title, Cell(lens.at(key), "image_distance_mm", "mm", 2), Cell(lens.at(key), "aperture_diameter_mm", "mm", 2),
				Cell(lens.at(key), "focus_distance_mm", "mm", 1), Cell(lens.at(key), "focal_length_mm", "mm", 2) });
	return out + "<h3>The lens</h3>\n" + tiltcal::html::Table(numbers)
		+ "<p><small>Nominal d is f over the f-number. Nothing is known beforehand of w and U without tracing the lens; f of ours is that of the thin lens with this w and U.</small></p>\n";
}

std::string BrightnessSection(const Json& results)
{
	Rows rows{ { "state", "the paper: red", "green", "ours, one gain: red", "green", "whole picture", "ours, smooth shading: red", "green", "whole picture" } };
	for (const char* const state : STATES)
	{
		const Json& row = results.at("brightness").at(state);
		std::vector<std::string> cells{ Title(state) };
		for (const char* const which : { "published", "gain", "shading" })
			for (const char* const line : { "red", "green", "picture" })
				if (row.at(which).contains(line))
					cells.push_back((std::string(which) == "gain" ? "<b>" : "") + Number(row.at(which).at(line), 2) + (std::string(which) == "gain" ? "</b>" : ""));
		rows.push_back(cells);
	}
	return "<h2>Table 2: brightness of photograph against render</h2>\n<p>Mean absolute difference in levels of 255 (sRGB code of the luminance). Red: row 660; green: column 900. "
		"<i>One gain</i> brings the render to the photograph’s exposure and does nothing else; <i>smooth shading</i> also divides out a polynomial of fourth order, which is what a calibration "
		"without vignetting would need.</p>\n" + tiltcal::html::Table(rows)
		+ "<p><small>The paper’s lines lie in another scene, of another contrast: its numbers show the size of its errors.</small></p>\n";
}

std::string ReproduceSection(const Json& results)
{
	const Json& c = results.at("conditions");
	double total = 0;
	Rows rows{ { "step", "seconds" } };
	for (const Json& step : results.at("steps"))
	{
		total += double(step.at("seconds"));
		rows.push_back({ tiltcal::HtmlText(step.at("text")), Number(step.at("seconds"), 0) });
	}
	rows.push_back({ "all", Number(total, 0) });
	return "<h2>How to reproduce this page</h2>\n<pre>sh cmake/setup.sh\ncmake --preset release &amp;&amp; cmake --build --preset release &amp;&amp; cmake --build --preset paper</pre>\n"
		+ fmt::format("<p>Made {} with tiltcal {} and POV-Ray {} (patched), {} threads, {}. Photographs: <code>{}</code> ({}). Samples a pixel: {} for the boxes, {} for the closed loop’s boards, "
			"{} in the table of effects. Every number on this page is in <code>results.json</code> beside it, computed in this run; only the paper’s own are typed in "
			"(<code>scenes/paper/paper_published.h</code>). Another set of photographs: <code>-DTILT_LENS_PHOTOS=DIR</code>; more samples: <code>-DTILT_LENS_DEMO_SAMPLES=512</code>.</p>\n",
			tiltcal::HtmlText(c.at("date")), tiltcal::HtmlText(c.at("tiltcal")), tiltcal::HtmlText(c.at("povray")), int(c.at("threads")),
			tiltcal::HtmlText(c.at("processor")), tiltcal::HtmlText(c.at("photos")), tiltcal::HtmlText(c.at("format")), int(c.at("samples")),
			int(c.at("board_samples")), int(c.at("effect_samples")))
		+ tiltcal::html::Table(rows) + "<p><small>The step that was under way when these were written, the measuring itself, is not among them.</small></p>\n";
}

}
