// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/report_tables.h"

#include "base/plain_text.h"
#include "model/focus_words.h"
#include "model/names.h"
#include "model/predict.h"
#include <tiltcal/calibrate.h>
#include "effects/effects.h"
#include "base/files.h"
#include "camera/state_camera.h"
#include "report/html.h"
#include "report/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

using html::Number;
using html::WithSigma;
using Rows = std::vector<std::vector<std::string>>;

const double NOT_KNOWN = std::numeric_limits<double>::quiet_NaN();

Estimate PerMetre(const Estimate& e) { return { 1000 * e.value, 1000 * e.sigma }; }

/// f/d of a state, with the two taken as independent: an upper bound where they rise and fall together.
Estimate FNumber(const StateCamera& camera)
{
	const double f = camera.focal_length_mm, d = camera.aperture_diameter_mm, N = f / d;
	return { N, std::abs(N) * std::hypot(camera.sigma.focal_length_mm / f, camera.sigma.aperture_diameter_mm / d) };
}

/// As it was fitted, whatever effects are written.
StateCamera FittedCamera(const Calibration& c, size_t s) { return CameraOfFit(c.task, c.solution, c.MainGeometry(), s); }

std::string PointText(const Point& at, const Point& sigma, const std::string& unit)
{
	return WithSigma({ at[0], sigma[0] }, "", 2) + ", " + WithSigma({ at[1], sigma[1] }, unit, 2);
}

std::string FocusText(const StateLens& lens)
{
	const std::optional<std::string> words = FocusWords(InverseFocus(lens));
	return words ? HtmlText(*words) : WithSigma(lens.focus_distance, "mm", 1);
}

double RmsBlur(const Calibration& c, size_t s, size_t p)
{
	const std::vector<Edge>& edges = c.task.states[s].photos[p].edges;
	double sum = 0;
	for (const Edge& e : edges)
		sum += std::pow(e.blur - PredictedBlur(c, s, p, e), 2);
	return edges.empty() ? NOT_KNOWN : std::sqrt(sum / double(edges.size()));
}

Rows StateRows(const Calibration& c)
{
	const Geometry& g = c.MainGeometry();
	Rows rows{ { "state", "lens tilt", "of its σ left out by the model", "direction", "plane of focus to sensor", "focus distance U", "focal length f", "f-number f/d", "principal point", "blur misfit", "photographs" } };
	if (g.shared_poses)
		rows[0].insert(rows[0].end() - 2, "lens centre moved by x, y, z");
	for (size_t s = 0; s < c.solution.states.size(); ++s)
	{
		const StateCamera camera = FittedCamera(c, s);
		const StateCameraSigma& sigma = camera.sigma;
		const bool tilted = c.task.states[s].tilted || (c.task.untilted_free && c.solution.model != Model::PAPER);
		rows.push_back({ HtmlText(camera.state), tilted ? WithSigma(c.TiltOf(s).lens_tilt, "°") : "none",
			s > 0 && tilted && c.IsJudged() ? Number(c.TiltLeftOutByModel(s), 3) + "°" : "–",
			tilted ? WithSigma(c.TiltOf(s).tilt_direction, "°") : "–",
			tilted ? WithSigma({ camera.focal_plane_tilt_deg, sigma.focal_plane_tilt_deg }, "°") : "parallel",
			FocusText(c.solution.states[s]), WithSigma({ camera.focal_length_mm, sigma.focal_length_mm }, "mm"), WithSigma(FNumber(camera), ""),
			PointText(camera.principal_point, sigma.principal_point, "px") + (g.states[s].principal_point_fixed ? " (held)" : ""), Number(c.solution.states[s].rms_blur, 3) + " px",
			std::to_string(c.task.states[s].photos.size()) });
		if (g.shared_poses)
		{
			const Vec3<double>&at = camera.lens_centre_mm, &its = sigma.lens_centre_mm;
			rows.back().insert(rows.back().end() - 2, tilted ? WithSigma({ at.x, its.x }, "") + ", " + WithSigma({ at.y, its.y }, "") + ", " + WithSigma({ at.z, its.z }, "mm") : "–");
		}
	}
	return rows;
}

/// States as columns: many numbers read better downwards.
Rows Turned(const Rows& rows)
{
	Rows turned(rows[0].size());
	for (const std::vector<std::string>& row : rows)
		for (size_t k = 0; k < row.size(); ++k)
			turned[k].push_back(row[k]);
	return turned;
}

Rows CommonRows(const Calibration& c)
{
	const Solution& s = c.solution;
	const Geometry& g = c.MainGeometry();
	Rows rows{ { "all states", "value ± sigma", "meaning" } };
	rows.push_back({ "image distance w", WithSigma(s.w_mm, "mm"), "lens centre to sensor, along the axis" });
	rows.push_back({ "aperture diameter d", WithSigma(s.aperture_diameter, "mm"), s.stop_ratios.empty() ? "of the effective aperture" : "of the effective aperture, at the widest stop" });
	for (size_t k = 1; k < s.stop_ratios.size(); ++k)
		rows.push_back({ fmt::format("opening at f/{:g}", c.task.stops[k].f_number), WithSigma(s.stop_ratios[k], "", 4),
			fmt::format("of that at f/{:g}; the f-numbers say {:.4f}", c.task.stops[0].f_number, RatioByFNumbers(c.task.stops, k)) });
	rows.push_back({ "focal length f", WithSigma(s.focal_length, "mm"), "untilted" });
	rows.push_back({ "focus distance U", FocusText(s.states[0]), "untilted, along the axis" });
	if (s.model == Model::CURVED)
	{
		rows.push_back({ "field curvature C", WithSigma(PerMetre(s.field_curvature), "per metre"), "of the bowl that the plane of focus touches on the lens axis; mean of the two below" });
		rows.push_back({ "tangential", WithSigma(PerMetre(s.tangential_curvature), "per metre"), "seen by edges across the radius" });
		rows.push_back({ "sagittal", WithSigma(PerMetre(s.sagittal_curvature), "per metre"), "seen by edges along the radius" });
	}
	rows.push_back({ "floor", WithSigma(s.psf_floor_px, "px", 2), "the lens's own blur, added in squares" });
	const std::vector<size_t> used = g.distortion_terms >= 5 ? std::vector<size_t>{ 0, 1, 2, 3, 4 } : g.distortion_terms >= 4 ? std::vector<size_t>{ 0, 1, 2, 3 }
		: g.distortion_terms >= 2 ? std::vector<size_t>{ 0, 1 } : g.distortion_terms == 1 ? std::vector<size_t>{ 0 } : std::vector<size_t>{};
	for (const size_t k : used)
		rows.push_back({ std::string("distortion ") + DISTORTION_NAMES[k], WithSigma({ g.distortion[k], g.distortion_sigma[k] }, "", 5), "Brown–Conrady, about the lens axis, in units of w" });
	if (used.empty())
		rows.push_back({ "distortion", "none", s.model == Model::PAPER ? "the paper's model has none" : "k1 would not lower the misfit enough to be believed" });
	rows.push_back({ "reprojection", Number(g.rms, 3) + " px", "RMS" + (used.empty() ? std::string() : "; " + Number(c.pinhole.rms, 3) + " px without distortion") });
	rows.push_back({ "blur misfit", Number(s.rms_blur, 3) + " px", "RMS of measured − predicted" });
	return rows;
}

std::string TiltText(const StateLens& lens)
{
	return WithSigma(lens.lens_tilt, "°") + " towards " + WithSigma(lens.tilt_direction, "°", 2);
}

}

std::string VerdictBox(const Calibration& c)
{
	if (!c.IsJudged())
		return "<div class=\"verdict\"><b>No verdict:</b> the paper's model is not judged. Use --model auto for numbers to rely on.</div>\n";
	const Verdict& verdict = c.verdict;
	std::string remarks;
	for (const Remark& r : verdict.remarks)
		remarks += fmt::format("<li class=\"{}\"><b>{}</b> {}</li>\n", NameOf(r.grade), r.grade == Grade::GOOD ? "note:" : r.grade == Grade::FAIR ? "fair:" : "poor:", HtmlText(r.text));
	if (!remarks.empty())
		remarks = "<ul>\n" + remarks + "</ul>\n";
	return fmt::format("<div class=\"verdict {0}\"><b>Verdict: {0}</b>\n{1}</div>\n", NameOf(verdict.grade), remarks);
}

std::string NumbersTables(const Calibration& c)
{
	return html::Table(Turned(StateRows(c))) + "<div class=\"common\">" + html::Table(CommonRows(c)) + "</div>\n";
}

std::string EvidenceTable(const Calibration& c)
{
	// The paper's model has blur only.
	if (c.solution.states.size() < 2 || c.blur_alone.empty())
		return "";
	Rows rows{ { "lens tilt told by" } };
	for (size_t s = 1; s < c.solution.states.size(); ++s)
		rows[0].push_back(HtmlText(c.task.states[s].name));
	const auto add = [&](const char* name, const std::vector<StateLens>& states)
	{
		rows.push_back({ name });
		for (size_t s = 1; s < c.solution.states.size(); ++s)
			rows.back().push_back(s < states.size() ? TiltText(states[s]) : "tells nothing");
	};
	add("blur alone", c.blur_alone);
	add("geometry alone", c.geometry_alone.states);
	add("jointly", c.solution.states);
	if (c.RealLensIsUsed())
	{
		std::vector<StateLens> states;
		for (const RealLensState& state : c.real_lens->states)
			states.push_back(state.lens);
		add("a real lens", states);
	}
	std::string out = html::Table(rows);
	if (!c.geometry_alone.states.empty())
		out += "<p>Geometry alone sees a pupil magnification of " + WithSigma(c.geometry_alone.pupil_magnification, "") + ".</p>\n";
	return out;
}

std::string EffectsTable(const Calibration& c)
{
	if (c.effects.empty())
		return "";
	Rows rows{ { "effect", "value ± sigma", "significance", "error without", "with it", "of", "written", "why" } };
	for (const Effect& e : c.effects)
	{
		const bool known = e.failure.empty();
		std::string values;
		for (const auto& [name, value] : e.values)
			values += (values.empty() ? "" : "<br/>") + HtmlText(name) + " " + (value.sigma > 0 ? WithSigma(value, "") : fmt::format("{:g}", value.value));
		rows.push_back({ NameOf(e.id), known && !values.empty() ? values : "–", known && e.sigmas > 0 ? Number(e.sigmas, 1) + " sigma" : "–",
			known && e.held_out_without > 0 ? fmt::format("{:.3g}", e.held_out_without) : "–", known && e.held_out_with > 0 ? fmt::format("{:.3g}", e.held_out_with) : "–",
			known && e.held_out_with > 0 ? HtmlText(e.unit) : "–", e.used ? "<b>yes</b>" : "no", HtmlText(e.why) + (e.note.empty() ? "" : "<br/>" + HtmlText(e.note)) });
	}
	return "<div class=\"wide effects\">" + html::Table(rows) + "</div>\n";
}

std::string ModelsTable(const Calibration& c)
{
	if (!c.compared)
		return "";
	Rows rows{ { "model", "blur of photographs left out, RMS" } };
	for (size_t s = 1; s < c.task.states.size(); ++s)
		rows[0].push_back(HtmlText(c.task.states[s].name));
	rows[0].push_back("seconds");
	const auto add = [&](const std::string& model, const std::string& failure, const std::string& held_out, double seconds, const auto& lens)
	{
		rows.push_back({ model });
		if (!failure.empty())
			rows.back().push_back("no answer: " + HtmlText(failure));
		else
		{
			rows.back().push_back(held_out);
			for (size_t k = 1; k < c.task.states.size(); ++k)
				rows.back().push_back(TiltText(lens(k)));
			rows.back().push_back(seconds > 0 ? Number(seconds, 1) : "–");
		}
		rows.back().resize(rows[0].size(), "–");
	};
	const auto named = [&](Model model) { return std::string(NameOf(model)) + (model == c.Answer() ? " (taken)" : ""); };
	const auto add_thin = [&](const Solution& s)
	{
		add(named(s.model), s.failure, s.held_out_px > 0 ? Number(s.held_out_px, 3) + " px" : s.model == Model::PAPER ? "–" : "cannot be said of one photograph a state", s.seconds, [&](size_t k) { return s.states[k]; });
	};
	add_thin(c.paper);
	for (const Solution* s : c.compared->All())
		add_thin(*s);
	if (!c.real_lens)
		return html::Table(rows);
	const auto told = [](const RealLens& lens) { return lens.held_out > 0 && lens.held_out_thin > 0; };
	const auto add_real = [&](const std::string& model, const RealLens& lens, const std::string& than)
	{
		add(model, lens.failure, told(lens) ? Number(lens.held_out / lens.held_out_thin, 2) + " of " + than : "cannot be said", lens.seconds, [&](size_t k) { return lens.states[k].lens; });
	};
	add_real(named(Model::LENS), *c.real_lens, NameOf(c.solution.model));
	if (c.scene_lens)
		add_real(std::string("lens, fifth order") + (c.scene_lens->used ? " (for scenes)" : ""), *c.scene_lens, NameOf(Model::LENS));
	return html::Table(rows) + (told(*c.real_lens) ? std::string("<p><small>Of lens: places and blurs of the edges of photographs left out, each in what is usual of it, against the same of ") + NameOf(c.solution.model) +
		" after its last refinement.</small></p>\n" : "");
}

std::string PhotographsTable(const Calibration& c)
{
	const Geometry& g = c.MainGeometry();
	Rows rows{ { "photograph", "state", "corners, px", "blur misfit, px", "edges", "left out", "blur radius / square: least", "median", "most", "tilt change without it", "its blur then, px" } };
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
		{
			const Photo& photo = c.task.states[s].photos[p];
			const BlurRatios ratios = RatiosOf(photo);
			const auto left = std::find_if(c.solution.left_out.begin(), c.solution.left_out.end(), [&](const LeftOut& l) { return l.state == s && l.photo == p; });
			const bool known = left != c.solution.left_out.end();
			const auto check = std::find_if(c.photographs.begin(), c.photographs.end(), [&](const PhotographCheck& k) { return k.state == s && k.photo == p; });
			const bool odd_places = check != c.photographs.end() && check->odd_places, odd_blur = check != c.photographs.end() && check->odd_blur;
			const auto mark = [](const std::string& text, bool odd) { return odd ? "<b>" + text + " stands out</b>" : text; };
			rows.push_back({ fmt::format("<i style=\"color:{}\">■</i> {} {}", html::PhotoColour(p), p + 1, HtmlText(BaseName(photo.file))), HtmlText(c.task.states[s].name), mark(Number(g.states[s].photo_rms[p], 3), odd_places),
				mark(Number(RmsBlur(c, s, p), 3), odd_blur), std::to_string(photo.edges.size()), std::to_string(photo.edges_dropped), Number(ratios.least, 3), Number(ratios.median, 3), Number(ratios.most, 3),
				known ? Number(left->tilt_change, 3) + "°" : "–", known ? Number(left->rms_blur, 3) : "–" });
		}
	return "<div class=\"files\">" + html::Table(rows) + "</div>\n";
}

std::string CorrelationTable(const Calibration& c)
{
	std::vector<std::string> names;
	const auto add = [&](const std::string& name)
	{
		if (std::find(names.begin(), names.end(), name) == names.end())
			names.push_back(name);
	};
	for (const Correlation& r : c.solution.correlations)
		add(r.first);
	for (const Correlation& r : c.solution.correlations)
		add(r.second);
	if (names.empty())
		return "";
	std::string out = "<div class=\"wide\"><table class=\"correlation\">\n<tr><th></th>";
	for (const std::string& name : names)
		out += "<th>" + HtmlText(name) + "</th>";
	out += "</tr>\n";
	for (const std::string& row : names)
	{
		out += "<tr><th>" + HtmlText(row) + "</th>";
		for (const std::string& column : names)
		{
			const auto found = std::find_if(c.solution.correlations.begin(), c.solution.correlations.end(),
				[&](const Correlation& r) { return (r.first == row && r.second == column) || (r.first == column && r.second == row); });
			const bool known = found != c.solution.correlations.end() && std::isfinite(found->value);
			// White at 0; red with the positive, blue with the negative.
			const double a = known ? std::min(1.0, std::abs(found->value)) : 0;
			out += row == column ? "<td>1</td>" : !known ? "<td class=\"none\"></td>"
				: fmt::format("<td style=\"background:rgba({},{:.2f})\">{}</td>", found->value > 0 ? "200,30,30" : "20,70,190", 0.75 * a, Number(found->value, 2));
		}
		out += "</tr>\n";
	}
	return out + "</table></div>\n";
}

std::string PriorsTable(const Calibration& c)
{
	if (c.task.priors.empty())
		return "<p>No priors: nothing was given by <code>--fix</code> or <code>--prior</code>; every number comes from the photographs, the board's size and the pitch.</p>\n";
	Rows rows{ { "prior", "given", "found" } };
	const Solution& s = c.solution;
	for (const Prior& prior : c.task.priors)
	{
		Estimate found;
		switch (prior.quantity)
		{
		case Quantity::FOCAL_LENGTH: found = s.focal_length; break;
		case Quantity::F_NUMBER: found = FNumber(FittedCamera(c, 0)); break;
		case Quantity::IMAGE_DISTANCE: found = s.w_mm; break;
		case Quantity::FOCUS_DISTANCE: found = s.focus_distance; break;
		case Quantity::APERTURE_DIAMETER: found = s.aperture_diameter; break;
		}
		rows.push_back({ prior.Name(), prior.sigma > 2e-6 * std::abs(prior.value) ? WithSigma({ prior.value, prior.sigma }, "") : fmt::format("{:g}, fixed", prior.value),
			prior.quantity == Quantity::FOCUS_DISTANCE ? HtmlText(FocusWords(InverseFocus(s.states[0])).value_or(WithSigma(found, ""))) : WithSigma(found, "") });
	}
	return html::Table(rows);
}

}
