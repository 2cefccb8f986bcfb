// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/write_report.h"

#include "model/focus_words.h"
#include "model/predict.h"
#include <tiltcal/calibrate.h>
#include "effects/effects.h"
#include "base/file_set.h"
#include "base/files.h"
#include "program/gnuplot.h"
#include "picture/image_io.h"
#include "report/old_set.h"
#include "report/overlay.h"
#include "report/report_html.h"
#include "calibrate/verdict.h"
#include "report/write_csv.h"
#include "camera/write_inc.h"
#include "lens/words.h"
#include "report/write_json.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace tiltcal
{

namespace
{

std::string PlusMinus(const Estimate& e, int digits) { return fmt::format("{:.{}f} +- {:.{}f}", e.value, digits, e.sigma, digits); }

/// A state's row for one model.
std::string StateRow(const State& state, Model model, const std::string& tilt, const std::string& direction, const std::string& plane, const std::string& focus, double corners, double blur)
{
	return fmt::format("{:<12} {:<6} {:>6} {:>16} {:>14} {:>16} {:>16} {:>9.3f} {:>8.3f}\n", state.name, NameOf(model), state.photos.size(), tilt, direction, plane, focus, corners, blur);
}

/// One row per state for one model.
std::string StateRows(const Calibration& c, const Solution& solution, const Geometry& g)
{
	std::string rows;
	for (size_t s = 0; s < solution.states.size(); ++s)
	{
		const StateLens& l = solution.states[s];
		const bool tilted = c.task.states[s].tilted || (c.task.untilted_free && solution.model != Model::PAPER);
		double squares = 0;
		for (const double r : g.states[s].photo_rms)
			squares += r * r;
		rows += StateRow(c.task.states[s], solution.model, tilted ? PlusMinus(l.lens_tilt, 3) : "0", tilted ? PlusMinus(l.tilt_direction, 2) : "-",
			tilted ? PlusMinus(l.focal_plane_tilt, 2) : "0", FocusInShort(InverseFocus(l)).value_or(PlusMinus(l.focus_distance, 1)),
			std::sqrt(squares / double(g.states[s].photo_rms.size())), l.rms_blur);
	}
	return rows;
}

/// The same of the real lens; its plane of focus is not a plane.
std::string RealLensRows(const Calibration& c)
{
	std::string rows;
	for (size_t s = 0; s < c.task.states.size(); ++s)
	{
		const RealLensState& state = c.real_lens->states[s];
		const bool tilted = c.task.states[s].tilted || c.task.untilted_free;
		rows += StateRow(c.task.states[s], Model::LENS, tilted ? PlusMinus(state.lens.lens_tilt, 3) : "0", tilted ? PlusMinus(state.lens.tilt_direction, 2) : "-", "-", "-", c.real_lens->rms_place, c.real_lens->rms_blur);
	}
	return rows;
}

std::string LeftOutByModel(const Calibration& c)
{
	std::string out = "of the sigmas of the tilts, what the model leaves out (more photographs do not lower it):";
	for (size_t s = 1; s < c.task.states.size(); ++s)
		out += fmt::format("{} {} {:.3f}", s > 1 ? "," : "", c.task.states[s].name, c.TiltLeftOutByModel(s));
	return out + " deg\n";
}

std::string ModelLine(const Solution& s)
{
	if (!s.failure.empty())
		return fmt::format("{:<6} no answer: {}\n", NameOf(s.model), s.failure);
	return fmt::format("{:<6} w {} mm   d {} mm   U {}   f {} mm   floor {:.2f} px\n", NameOf(s.model), PlusMinus(s.w_mm, 3),
		PlusMinus(s.aperture_diameter, 3), FocusWords(InverseFocus(s.states[0])).value_or(PlusMinus(s.focus_distance, 1) + " mm"), PlusMinus(s.focal_length, 3), s.psf_floor_px.value);
}

/// A line for each stop; of the answer.
std::string StopLines(const Calibration& c)
{
	const std::vector<Estimate>& ratios = c.StopRatios();
	std::string out = ratios.empty() ? "" : "\nstops, of one lens:\n";
	for (size_t k = 0; k < ratios.size(); ++k)
		out += fmt::format("  f/{:<4g} {:.3f} mm{}\n", c.task.stops[k].f_number, ratios[k].value * c.ApertureOfStops().value,
			k ? fmt::format(", {} of f/{:g}; the f-numbers say {:.4f}", PlusMinus(ratios[k], 4), c.task.stops[0].f_number, RatioByFNumbers(c.task.stops, k)) : "");
	return out;
}

std::string PerMetre(const Estimate& e) { return fmt::format("{:.3f} +- {:.3f}", 1000 * e.value, 1000 * e.sigma); }

std::string CurvatureLine(const Solution& s)
{
	return fmt::format("\nfield curvature {} per metre (tangential {}, sagittal {}): the plane of focus is the one that touches the bowl on the lens axis\n",
		PerMetre(s.field_curvature), PerMetre(s.tangential_curvature), PerMetre(s.sagittal_curvature));
}

/// How well each model predicts the blur of photographs that it was not fitted to, and the tilts it finds.
std::string Comparison(const Calibration& c)
{
	std::string out = "\nblur of photographs left out, in turn, of the fit:\n";
	const Solution* best = nullptr;
	for (const Solution* each : c.compared->All())
	{
		const Solution& s = *each;
		if (!s.failure.empty())
		{
			out += fmt::format("  {:<6} no answer: {}\n", NameOf(s.model), s.failure);
			continue;
		}
		out += fmt::format("  {:<6} {}", NameOf(s.model), s.held_out_px > 0 ? fmt::format("{:.3f} px", s.held_out_px) : "cannot be said of one photograph a state");
		for (size_t k = 1; k < s.states.size(); ++k)
			out += fmt::format("   {} {:.3f} deg towards {:.2f}", c.task.states[k].name, s.states[k].lens_tilt.value, s.states[k].tilt_direction.value);
		out += "\n";
		if (s.held_out_px > 0 && (!best || s.held_out_px < best->held_out_px))
			best = &s;
	}
	if (best)
		out += fmt::format("  {} predicts them best{}\n", NameOf(best->model), best->model == c.solution.model ? c.RealLensIsUsed() ? "; from there the real lens goes on" : ", and was taken"
			: fmt::format("; {} was taken, see --help. The difference is small when their tilts agree", NameOf(c.solution.model)));
	return out;
}

/// The tilts by blur alone, by geometry alone and by both.
std::string Evidence(const Calibration& c)
{
	std::string out = "\nwhat tells the tilt:\n";
	const auto row = [&](const char* name, const std::vector<StateLens>& states)
	{
		out += fmt::format("  {:<14}", name);
		for (size_t s = 1; s < states.size(); ++s)
			out += fmt::format("   {} {} deg towards {}", c.task.states[s].name, PlusMinus(states[s].lens_tilt, 3), PlusMinus(states[s].tilt_direction, 2));
		out += states.empty() ? "   nothing\n" : "\n";
	};
	row("blur alone", c.blur_alone);
	row("geometry alone", c.geometry_alone.states);
	row("jointly", c.solution.states);
	if (!c.geometry_alone.states.empty())
		out += fmt::format("  geometry alone sees a pupil magnification of {}\n", PlusMinus(c.geometry_alone.pupil_magnification, 3));
	for (size_t s = 1; c.geometry.shared_poses && s < c.geometry.states.size(); ++s)
	{
		const Vec3<double>&at = c.geometry.states[s].lens_centre, &sigma = c.geometry.states[s].lens_centre_sigma;
		out += fmt::format("  the lens centre moved by ({:.3f}, {:.3f}, {:.3f}) +- ({:.3f}, {:.3f}, {:.3f}) mm in {}\n", at.x, at.y, at.z, sigma.x, sigma.y, sigma.z, c.task.states[s].name);
	}
	return out;
}

std::string GlassText(const RealLens& lens)
{
	return fmt::format("focal length {} mm, aperture {} mm{}, pupil magnification {}\n", PlusMinus(lens.focal_length_mm, 3), PlusMinus(lens.aperture_diameter_mm, 3),
		lens.RimHoldsBackTheAxis() ? fmt::format(" (of which a rim leaves {} on the axis)", PlusMinus(lens.opening_on_axis_mm, 3)) : "", PlusMinus(lens.pupil_magnification, 4));
}

std::string RealLensText(const Calibration& c)
{
	const RealLens& lens = *c.real_lens;
	if (!lens.failure.empty())
		return fmt::format("\nreal lens: no answer: {}\n", lens.failure);
	std::string out = "\nreal lens, one for all states: " + GlassText(lens);
	out += "  thousandths of the focal length:";
	for (size_t k = 0; k < tilt_lens::ThirdOrderTerms; ++k)
		out += fmt::format(" {} {}{}", tilt_lens::AberrationWords[k], PlusMinus(lens.PerMille(k), 3), k + 1 < tilt_lens::ThirdOrderTerms ? "," : "\n");
	for (size_t s = 1; s < lens.states.size(); ++s)
		out += fmt::format("  {}: tilt {} degrees towards {}\n", c.task.states[s].name, PlusMinus(lens.states[s].lens.lens_tilt, 3), PlusMinus(lens.states[s].lens.tilt_direction, 2));
	out += fmt::format("  places of edges fit to {:.3f} px, their blurs to {:.3f} px\n", lens.rms_place, lens.rms_blur);
	if (lens.held_out > 0 && lens.held_out_thin > 0)
		out += fmt::format("  photographs left out are predicted to {:.2f} of what is usual by it, to {:.2f} by {}\n", lens.held_out, lens.held_out_thin, NameOf(c.solution.model));
	if (!lens.used)
		return out + "  it was not taken\n";
	return out + (c.SceneLensIsUsed() ? "  it was taken: the tilts are its own\n" : "  it was taken: the tilts are its own; the .inc files have it where TiltCal_Real_Lens is 1\n");
}

/// With the fifth order.
std::string SceneLensText(const Calibration& c)
{
	const RealLens& lens = *c.scene_lens;
	std::string out = fmt::format("  fifth order {} for scenes: places of edges fit to {:.3f} px, their blurs to {:.3f} px", lens.used ? "taken" : "not taken", lens.rms_place, lens.rms_blur);
	if (lens.rms_shape)
		out += fmt::format(", their shapes to {:.1f} % of the light", 100 * std::max((*lens.rms_shape)[0], (*lens.rms_shape)[1]));
	if (lens.held_out > 0 && lens.held_out_thin > 0)
		out += fmt::format(", photographs left out to {:.2f} of what is usual (six: {:.2f})", lens.held_out, lens.held_out_thin);
	out += "\n    " + GlassText(lens);
	if (lens.used)
		out += "    the .inc files have it unless TiltCal_Real_Lens is 0\n";
	for (const RimEstimate& rim : lens.rims)
		out += fmt::format("    rim: radius {} mm, {} mm {}\n", PlusMinus(rim.radius_mm, 2), PlusMinus({ std::abs(rim.distance_mm.value), rim.distance_mm.sigma }, 2),
			rim.distance_mm.value > 0 ? "before the entrance pupil" : "behind the exit pupil");
	return out;
}

std::string VerdictText(const Verdict& verdict)
{
	std::string out = fmt::format("\nverdict: {}\n", NameOf(verdict.grade));
	for (const Remark& r : verdict.remarks)
		out += fmt::format("  {} {}\n", r.grade == Grade::GOOD ? "note:" : r.grade == Grade::FAIR ? "fair:" : "POOR:", r.text);
	return out;
}

/// One row per edge: what the plot shows, and what a reader needs to look further.
std::string BlurCsv(const Calibration& c, size_t s)
{
	std::string csv = "photo,x_px,y_px,along_columns,measured_px,sigma_px,predicted_px\n";
	for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
		for (const Edge& e : c.task.states[s].photos[p].edges)
			csv += fmt::format("{},{:.2f},{:.2f},{},{:.4f},{:.4f},{:.4f}\n", p + 1, e.x, e.y, int(e.along_columns), e.blur, e.blur_sigma,
				PredictedBlur(c, s, p, e));
	return csv;
}

void PlotBlur(const Calibration& c, size_t s, const std::string& folder, FileSet& set)
{
	const std::string& name = c.task.states[s].name;
	const std::string data = set.Text(Join(folder, "blur-" + name + ".csv"), BlurCsv(c, s));
	double most = 1;
	for (const Photo& photo : c.task.states[s].photos)
		for (const Edge& e : photo.edges)
			most = std::max(most, e.blur);
	const size_t photos = c.task.states[s].photos.size();
	// One colour per photograph; below, the difference, where the model's errors show.
	const std::string script = fmt::format(
		"set datafile separator ','\nset multiplot layout 2,1 title {0}\nset grid lc rgb '#dddddd'\nset key outside right title 'photo'\n"
		"set xrange [0:{1:.3f}]\nset yrange [0:{1:.3f}]\nset ylabel 'measured blur [px]'\n"
		"plot x with lines lc rgb '#888888' notitle, for [i=1:{2}] {3} every ::1 using ($1==i?$7:1/0):5 with points pt 7 ps 0.5 lc i title sprintf('%d',i)\n"
		"set yrange [-3:3]\nset ylabel 'measured - predicted [px]'\nset xlabel 'predicted blur [px]'\n"
		"plot 0 with lines lc rgb '#888888' notitle, for [i=1:{2}] {3} every ::1 using ($1==i?$7:1/0):($5-$7) with points pt 7 ps 0.5 lc i title sprintf('%d',i)\n"
		"unset multiplot\n",
		GnuplotString(fmt::format("Blur width, state {} (model {}, {:.2f} px RMS)", name, NameOf(c.solution.model), c.solution.states[s].rms_blur)),
		1.05 * most, photos, GnuplotString(data));
	Plot(set, Join(folder, "blur-" + name + ".png"), script, 900, 900);
}

}

std::string SummaryTable(const Calibration& c)
{
	std::string out = ModelLine(c.solution);
	const bool compare = c.solution.model != Model::PAPER;
	if (compare)
		out += ModelLine(c.paper);
	out += fmt::format("\n{:<12} {:<6} {:>6} {:>16} {:>14} {:>16} {:>16} {:>9} {:>8}\n", "state", "model", "photos", "lens tilt deg", "direction deg",
		"plane tilt deg", "focus mm", "corner px", "blur px");
	if (c.RealLensIsUsed())
		out += RealLensRows(c);
	out += StateRows(c, c.solution, c.MainGeometry());
	if (compare && c.paper.failure.empty())
		out += StateRows(c, c.paper, c.paper_geometry);
	if (c.IsJudged() && c.task.states.size() > 1)
		out += LeftOutByModel(c);
	const Geometry& g = c.MainGeometry();
	out += fmt::format("\nreprojection {:.3f} px RMS", g.rms);
	if (g.distortion_terms)
		out += fmt::format(" (k1 {:.4f}, k2 {:.4f}, p1 {:.5f}, p2 {:.5f}, k3 {:.4f}, about the lens axis); {:.3f} px without distortion", g.distortion[0],
			g.distortion[1], g.distortion[2], g.distortion[3], g.distortion[4], c.pinhole.rms);
	out += fmt::format("; blur {:.3f} px RMS\n", c.solution.rms_blur);
	if (c.solution.model == Model::CURVED)
		out += CurvatureLine(c.solution);
	out += StopLines(c);
	if (!c.effects.empty())
		out += EffectsText(c);
	if (!c.blur_alone.empty() && c.task.states.size() > 1)
		out += Evidence(c);
	if (c.compared)
		out += Comparison(c);
	if (c.real_lens)
		out += RealLensText(c);
	if (c.scene_lens)
		out += SceneLensText(c);
	if (c.IsJudged())
		out += VerdictText(c.verdict) + NextText(c);
	return out;
}

void WriteEverything(const Calibration& c, const RunNotes& notes, const ReadGrey& read, const std::string& folder)
{
	ReportPictures pictures(c.task);
	FileSet set;
	for (size_t s = 0; s < c.task.states.size(); ++s)
	{
		spdlog::info("state {}: drawing overlays and plot", c.task.states[s].name);
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
		{
			const cv::Mat overlay = DrawOverlay(read(s, p), c, s, p);
			set.Text(Join(folder, fmt::format("overlay-{}-{}.png", c.task.states[s].name, p + 1)), PngOf(overlay));
			pictures.Add(overlay);
		}
		PlotBlur(c, s, folder, set);
		set.Text(Join(folder, "camera-" + c.task.states[s].name + ".inc"), CameraInc(c, s));
	}
	set.Text(Join(folder, "photographs.csv"), PhotographsCsv(c));
	set.Text(Join(folder, "report.txt"), SummaryTable(c));
	spdlog::info("writing report.html");
	set.Text(Join(folder, "report.html"), ReportHtml(c, notes, pictures));
	RemoveOldSet(folder, c, set);
	// Last: what is read as the calibration is there when all the rest is.
	set.Text(Join(folder, "calibration.json"), CalibrationJson(c));
	set.Commit();
}

}
