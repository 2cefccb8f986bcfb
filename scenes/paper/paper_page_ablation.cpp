// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_page_parts.h"

#include "report/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paper
{

namespace
{

using tiltcal::html::Number;
using Rows = std::vector<std::vector<std::string>>;

const struct { const char *key, *title; } AREAS[] = { { "red", "red line" }, { "green", "green line" }, { "picture", "whole picture" } };

/// The parts that the whole's square is the sum of. `measured`: the difference that it was found by directly, where there is one.
const struct { const char *key, *measured, *title, *colour; } PARTS[] = {
	{ "noise", "noise", "noise of the photograph", "#9e9e9e" },
	{ "sampling", "sampling", "sampling noise of the render", "#d0d0d0" },
	{ "calibration", "", "calibration error", "#e6a100" },
	{ "brightness", "", "model: smooth brightness", "#8fc98f" },
	{ "displacement", "", "model: smooth displacement", "#2b7bba" },
	{ "sharpness", "", "model: smooth change of blur", "#8e63b5" },
	{ "rest", "", "model: shape of the blur, outliers", "#c4443c" } };

/// The root with the square's sign: small parts may come out below zero.
std::string Root(double square) { return Number(square < 0 ? -std::sqrt(-square) : std::sqrt(square), 2); }

std::string Share(double part, double whole) { return Number(100 * part / whole, 1) + " %"; }

/// Every bar's length is a sum of squares; all on one scale.
std::string Bars(const Json& states)
{
	double most = 0;
	for (const char* const state : STATES)
		for (const auto& area : AREAS)
		{
			const Json& squares = states.at(state).at(area.key).at("squares");
			double drawn = 0;
			for (const auto& part : PARTS)
				drawn += std::max(0.0, double(squares.at(part.key)));
			most = std::max({ most, drawn, double(squares.at("whole")) });
		}
	const double left = 110, width = 900, height = 20;
	double y = 0;
	std::string bars;
	for (const auto& area : AREAS)
	{
		y += 26;
		bars += fmt::format("<text class=\"head\" x=\"0\" y=\"{:.0f}\">{}</text>\n", y, area.title);
		y += 8;
		for (const char* const state : STATES)
		{
			const Json& squares = states.at(state).at(area.key).at("squares");
			bars += fmt::format("<text x=\"0\" y=\"{:.0f}\">{}</text>\n", y + 15, Title(state));
			double x = left;
			for (const auto& part : PARTS)
			{
				const double w = std::max(0.0, double(squares.at(part.key))) / most * width;
				bars += fmt::format("<rect x=\"{:.2f}\" y=\"{:.0f}\" width=\"{:.2f}\" height=\"{:.0f}\" fill=\"{}\"><title>{}, {}: {}: RMS {}</title></rect>\n", x, y, w, height, part.colour,
					Title(state), area.title, part.title, Root(squares.at(part.key)));
				x += w;
			}
			bars += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\">{} = {}²</text>\n", x + 8, y + 15, Number(squares.at("whole"), 1), Root(squares.at("whole")));
			y += height + 6;
		}
	}
	std::string key = "<p class=\"key\">";
	for (const auto& part : PARTS)
		key += fmt::format("<span><i style=\"color:{}\">■</i> {}</span> ", part.colour, part.title);
	return key + fmt::format("</p>\n<svg class=\"bars\" viewBox=\"0 0 1130 {:.0f}\" role=\"img\" aria-label=\"Squared errors, by state and part\">\n", y + 6) + bars
		+ "</svg>\n<p><small>Squared error, levels² of 255; what bars show are the table’s squares. A part below zero is drawn as nothing; a bar longer than its sum has a closed loop that scatters by more than photograph and render differ.</small></p>\n";
}

std::string PartsTable(const Json& state)
{
	Rows rows{ { "part", "red: mean", "RMS", "green: mean", "RMS", "picture: mean", "RMS", "share of the picture’s squares" } };
	const auto row = [&](const std::string& title, const std::string& key, const std::string& measured)
	{
		std::vector<std::string> cells{ title };
		for (const auto& area : AREAS)
		{
			const Json& part = state.at(area.key);
			cells.push_back(measured.empty() ? "" : Number(part.at("measured").at(measured).at("mean_abs"), 2));
			cells.push_back(Root(part.at("squares").at(key)));
		}
		const Json& squares = state.at("picture").at("squares");
		cells.push_back(Share(squares.at(key), squares.at("whole")));
		rows.push_back(cells);
	};
	row("<b>photograph − render</b>", "whole", "gain");
	for (const auto& part : PARTS)
	{
		if (std::string(part.key) == "brightness")
			row("<b>model error</b>: what is left", "model", "");
		row(fmt::format("<i style=\"color:{}\">■</i> {}", part.colour, part.title), part.key, part.measured);
	}
	return tiltcal::html::Table(rows);
}

std::string FitsTable(const Json& states)
{
	Rows rows{ { "mean error after fitting", "untilted: red / green / picture", "+5°", "−5°", "displacement, px RMS" } };
	static const struct { const char *key, *title; } fits[] = { { "gain", "one gain" }, { "shading", "and a smooth shading" }, { "moved", "and a smooth displacement" },
		{ "sharpened", "and a smooth change of blur" } };
	for (const auto& [key, title] : fits)
	{
		std::vector<std::string> cells{ title };
		for (const char* const state : STATES)
		{
			const auto mean = [&](const char* area) { return Number(states.at(state).at(area).at("measured").at(key).at("mean_abs"), 2); };
			cells.push_back(mean("red") + " / " + mean("green") + " / " + mean("picture"));
		}
		std::string moved;
		if (std::string(key) == "moved")
			for (const char* const state : STATES)
				moved += (moved.empty() ? "" : " / ") + Number(states.at(state).at("displacement").at("rms_px"), 2);
		cells.push_back(moved);
		rows.push_back(cells);
	}
	return tiltcal::html::Table(rows);
}

/// The displacement fitted, as arrows 40 times as long, on the picture's outline.
std::string Arrows(const Json& displacement, const std::string& title)
{
	const double times = 40;
	std::string out = fmt::format("<svg class=\"arrows\" viewBox=\"0 0 1800 1200\" role=\"img\" aria-label=\"displacement, {}\"><rect x=\"2\" y=\"2\" width=\"1796\" height=\"1196\" fill=\"none\" stroke=\"#999\" stroke-width=\"4\"/>\n", title);
	for (const Json& place : displacement.at("field"))
	{
		const double x = place.at(0), y = place.at(1), to_x = x + times * double(place.at(2)), to_y = y + times * double(place.at(3));
		out += fmt::format("<path d=\"M{:.0f} {:.0f}L{:.1f} {:.1f}\" stroke=\"#2b7bba\" stroke-width=\"8\"/><circle cx=\"{:.0f}\" cy=\"{:.0f}\" r=\"9\" fill=\"#2b7bba\"/>\n", x, y, to_x, to_y, x, y);
	}
	return "<figure>" + out + "</svg><figcaption>" + fmt::format("{}: {} px RMS over the edges, mean {} px right, {} px down", title, Number(displacement.at("rms_px"), 2),
		Number(displacement.at("mean_x_px"), 2), Number(displacement.at("mean_y_px"), 2)) + "</figcaption></figure>\n";
}

std::string HowSeparated(const Json& results)
{
	const Json& states = results.at("states");
	const auto closed = [&](const char* state, const char* what)
	{
		const Json& picture = states.at(state).at("picture");
		if (std::string(what) == "predicted")
			return std::hypot(double(picture.at("measured").at("noise").at("rms")), double(picture.at("measured").at("closed_gain").at("rms")));
		return double(picture.at("measured").at("closed_photograph").at("rms"));
	};
	std::string check;
	for (const char* const state : STATES)
		check += fmt::format("{}{} against {} ({})", check.empty() ? "" : ", ", Number(closed(state, "predicted"), 2), Number(closed(state, "measured"), 2), Title(state));
	const Json& conditions = results.at("conditions");
	const std::string electrons = Number(conditions.at("full_well_electrons"), 0) + " electrons at full scale, " + Number(conditions.at("read_noise_electrons"), 0) + " of read noise";
	return "<h3>How each part was separated</h3>\n<dl>\n"
		"<dt>noise of the photograph</dt><dd>The render, times the gain, is given the sensor’s noise (" + electrons + ": <code>camera.json</code>), rounded to 8 bits and "
		"compressed with the photograph’s own quantisation tables; its difference to the render itself is what the photograph’s file alone does (the mean of two seeds is taken, so that compression finds little grain to take off). Legitimate because noise and compression do not know what lens made the picture.</dd>\n"
		"<dt>sampling noise of the render</dt><dd>Two renders that differ in nothing but the seed, both denoised, as the demo’s are; each has half the square of their difference. What denoising takes off the scene is the same in both, and counts as model error.</dd>\n"
		"<dt>calibration error</dt><dd>A closed loop: the calibrated camera itself photographs board and boxes (noise, 8 bits, compression), <code>tiltcal</code> calibrates from these pictures as it does from the photographs, "
		"and the boxes are rendered through what it finds. Start and result differ by the calibration’s error and by the renders’ sampling noise, which is taken off. Lens and model are the same here, so that no error of the model is in it. "
		"It is one draw: another one’s noise would give another error of this size.</dd>\n"
		"<dt>model error</dt><dd>What is left of the squares. The parts add in squares because they have no part in common: noise, grain and the closed loop’s draw are zero in the mean wherever the model is wrong. "
		"<b>Check</b>: in the closed loop, where the model is right, noise and calibration in squares predict the RMS difference of its own photograph and render over the picture: " + check + ". A little too much is predicted, because compression takes off some of the render’s own grain.</dd>\n"
		"<dt>smooth brightness, displacement, change of blur</dt><dd>Fitted to the difference one after the other over the whole picture, robustly: the shading of <code>tiltcal profile</code>, a displacement that is a cubic polynomial in x and y, "
		"and a cubic polynomial times the picture’s change under a Gaussian of 1 px. Each counts with what it takes away from the model’s error: the closed loop is fitted in the same way and taken off after every step, so that calibration error is not counted twice, "
		"and two seeds’ grain is taken through the same steps, so that grain which they smooth is not counted as model. The displacement holds an error of the camera’s place too, if there is one. "
		"The order matters a little: what two of them could explain is counted with the first.</dd>\n"
		"<dt>shape of the blur, outliers</dt><dd>The rest: discs that are not evenly bright, and what the camera leaves of the lens’s aberrations: all beyond a paraboloid of focus for a thin lens, the seventh order for a real one.</dd>\n</dl>\n";
}

std::string ClosedLoop(const Json& closed)
{
	Rows rows{ { "", "the camera", "found", "error", "in σ" } };
	for (const Json& n : closed.at("numbers"))
	{
		const double truth = n.at("true"), found = n.at("found"), sigma = n.at("sigma");
		const bool curvature = n.at("unit") == "_per_mm";
		const double scale = curvature ? 1e6 : 1;
		const std::string unit = n.at("unit") == "_deg" ? "°" : curvature ? "× 10⁻⁶/mm" : n.at("unit") == "_mm" ? "mm" : "";
		const int digits = curvature ? 1 : 4;
		rows.push_back({ n.at("what"), Number(truth * scale, digits) + (unit == "°" || unit.empty() ? unit : " " + unit), tiltcal::html::WithSigma({ found * scale, sigma * scale }, unit),
			Number((found - truth) * scale, digits), Number((found - truth) / sigma, 1) });
	}
	return "<h3>Table 1 of the closed loop</h3>\n<p>The same calibration where the truth is known in every number, because the pictures were made by this camera model. "
		"What is wrong here is <code>tiltcal</code>’s measuring and its noise, not the model: an error of many σ is a bias of the measuring, small as it is.</p>\n" + tiltcal::html::Table(rows);
}

std::string Curve(const Json& results, const std::string& out)
{
	Rows rows{ { "samples a pixel", "mean", "RMS", "CPU seconds for a tenth of the picture" } };
	for (const Json& point : results.at("curve"))
		rows.push_back({ std::to_string(int(point.at("samples"))), Number(point.at("mean_abs"), 3), Number(point.at("rms"), 3), Number(point.at("cpu_seconds"), 1) });
	return "<h3>Sampling noise is a matter of time</h3>\n<p>State +5°, the 120 rows about the red line, two seeds at every number of samples, not denoised.</p>\n<div class=\"pair\"><div>"
		+ SvgImage(out + "/curve.svg", "Sampling noise over CPU seconds") + "</div><div>" + tiltcal::html::Table(rows) + "</div></div>\n";
}

std::string Numbers3(const Json& estimate)
{
	std::string out;
	for (size_t k = 0; k < 3; ++k)
		out += (k ? ", " : "") + tiltcal::html::WithSigma({ estimate.at("value").at(k), estimate.at("sigma").at(k) }, "");
	return out;
}

std::string Pupils(const Json& pupils)
{
	Rows rows{ { "what", "measured", "prescription" } };
	const Json prescription = pupils.value("prescription", Json::object());
	for (const char* const state : { "plus5", "minus5" })
	{
		std::string known = "–";
		if (prescription.contains("lens_centre_mm"))
		{
			const Json& p = prescription.at("lens_centre_mm").at(state);
			known = Number(p.at(0), 3) + ", " + Number(p.at(1), 3) + ", " + Number(p.at(2), 3) + " mm";
		}
		rows.push_back({ "the perspective centre moves, " + Title(state) + " (right, up, forward)", Numbers3(pupils.at("lens_centre_mm").at(state)) + " mm", known });
	}
	if (pupils.contains("pupil_magnification"))
		rows.push_back({ "exit pupil over entrance pupil", WithSigma(pupils.at("pupil_magnification"), "", 3),
			prescription.contains("pupil_magnification") ? Number(prescription.at("pupil_magnification"), 3) : "–" });
	for (const Json& rim : pupils.value("rims", Json::array()))
		rows.push_back({ "a rim that cuts oblique light: radius; distance before the lens", WithSigma(rim.at("radius"), "mm", 2) + "; " + WithSigma(rim.at("distance"), "mm", 1), "rims on both sides" });
	const auto curvature = [&](const char* key, const char* title)
	{
		if (!pupils.contains(key))
			return;
		const Json& e = pupils.at(key);
		rows.push_back({ title, tiltcal::html::WithSigma({ 1e6 * double(e.at("value")), e.at("sigma").is_null() ? 0 : 1e6 * double(e.at("sigma")) }, "× 10⁻⁶/mm", 1), "–" });
	};
	curvature("field_curvature", "field curvature that is rendered");
	curvature("tangential_curvature", "of edges across the radius (tangential)");
	curvature("sagittal_curvature", "of edges along the radius (sagittal)");
	rows.push_back({ "the lens’s own blur, not rendered", WithSigma(pupils.at("psf_floor_px"), "px", 2), "–" });
	if (prescription.empty())
		for (std::vector<std::string>& row : rows)
			row.pop_back();
	return "<h3>Pupils and curvature</h3>\n<p>A thin lens has one pupil, at the lens, and one bowl of focus. This one has not. The entrance pupil wanders as the lens turns about its pivot, the two pupils differ in size, "
		"rims before and behind the stop cut the light of oblique bundles, and edges of two directions focus on two different bowls. Of these a thin camera renders the mean, and it has one pupil that stays; "
		"a real lens’s sixteen numbers hold both bowls, and how its pupils wander and change with the angle of the ray. What is left of it is in the last part of the ablation.</p>\n" + tiltcal::html::Table(rows);
}

std::string Effects(const Json& results)
{
	Rows rows{ { "camera", "untilted: red / green", "+5°", "−5°" } };
	for (const Json& row : results.at("effects"))
	{
		std::vector<std::string> cells{ row.at("title") };
		for (const char* const state : STATES)
			cells.push_back(Number(row.at("states").at(state).at("red"), 2) + " / " + Number(row.at("states").at(state).at("green"), 2));
		rows.push_back(cells);
	}
	return "<h3>What a thin lens with w, U, d and a tilt cannot know</h3>\n<p>Table 2 once more with one gain, through cameras that know less; each was calibrated as such, so that what it can it makes up for. "
		+ fmt::format("{} samples a pixel; the last row’s camera is Table 2’s.</p>\n", int(results.at("conditions").at("effect_samples"))) + tiltcal::html::Table(rows) + Pupils(results.at("pupils"));
}

}

std::string AblationSection(const Json& results, const std::string& out)
{
	const Json& states = results.at("states");
	std::string text = "<h2>What the difference is made of</h2>\n<p>Photograph − render, taken apart. <i>Mean</i> is the mean absolute difference, as in Table 2; <i>RMS</i> is its quadratic cousin, "
		"given because squares add: the bars’ lengths are squares, and their parts make up the whole.</p>\n" + Bars(states);
	for (const char* const state : STATES)
		text += "<h3>" + Title(state) + "</h3>\n" + PartsTable(states.at(state));
	text += "<p><small>Levels of 255. Parts without a mean were found by subtraction of squares, which means do not allow. A minus before a root: the square came out below zero, by chance.</small></p>\n";
	std::string arrows = "<p>The smooth displacement, from dots to where the photograph has what the render has at the dot, 40 times as long:</p>\n<div class=\"three\">";
	for (const char* const state : STATES)
		arrows += Arrows(states.at(state).at("displacement"), Title(state));
	arrows += "</div>\n";
	return text + HowSeparated(results) + "<h3>What smooth corrections would bring</h3>\n" + FitsTable(states) + arrows + ClosedLoop(results.at("closed_loop")) + Curve(results, out) + Effects(results);
}

}
