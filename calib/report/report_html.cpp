// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/report_html.h"

#include <tiltcal/calibrate.h>
#include "base/plain_text.h"
#include "effects/effects.h"
#include "model/names.h"
#include "base/files.h"
#include "plane_page/plane_page.h"
#include "report/html.h"
#include "report/page_head.h"
#include "report/report_lens.h"
#include "report/report_maps.h"
#include "report/report_scene.h"
#include "report/report_tables.h"

#include <fmt/format.h>

#include <algorithm>

namespace tiltcal
{

namespace
{


/// Photographs by state: "untilted 6, plus5 6".
std::string Counts(const Task& task)
{
	size_t all = 0;
	std::string each;
	for (const State& state : task.states)
	{
		all += state.photos.size();
		each += (each.empty() ? "" : ", ") + HtmlText(state.name) + " " + std::to_string(state.photos.size());
	}
	return fmt::format("{} ({})", all, each);
}

std::string BoardText(const Board& board)
{
	if (board.IsCheckerboard())
		return fmt::format("{} × {} squares of {:g} mm", board.columns, board.rows, board.square_mm);
	return fmt::format("{} × {} circles of {:g} mm, {}, {:g} mm apart", board.columns, board.rows, board.circle_diameter_mm, NameOf(board.kind), board.square_mm);
}

std::string Summary(const Calibration& c, const RunNotes& notes)
{
	const Task& task = c.task;
	std::string out = "<h1>Calibration of a tilted lens</h1>\n";
	std::vector<std::vector<std::string>> rows{ { "run", "" } };
	rows.push_back({ "photographs", Counts(task) });
	rows.push_back({ "picture", fmt::format("{} × {} px, pitch {:g} mm: a sensor of {:.2f} × {:.2f} mm", task.width, task.height, task.pitch_mm, task.width * task.pitch_mm, task.height * task.pitch_mm) });
	rows.push_back({ "board", fmt::format("{}; its poses are {} the states", BoardText(task.board), c.MainGeometry().shared_poses ? "shared by" : "free in all") });
	rows.push_back({ "model", HtmlText(std::string(NameOf(c.Answer())) + ": " + MeaningOf(c.Answer())) });
	rows.push_back({ "refinement", c.solution.model == Model::PAPER ? "none" : HtmlText(notes.refinement) });
	rows.push_back({ "program", "tiltcal " TILTCAL_VERSION ", " + HtmlText(notes.date) });
	if (!notes.command_line.empty())
		rows.push_back({ "command", "<code>" + HtmlText(notes.command_line) + "</code>" });
	out += VerdictBox(c) + NextSection(c) + WatchSection(notes.watch) + "<h2>The run</h2>\n<div class=\"run\">" + html::Table(rows) + "</div>\n";
	return out + "<h2>Numbers</h2>\n" + NumbersTables(c) + "<p><small>± is one standard deviation; f-number: those of f and d taken as independent. Directions: 0° up, 90° right. Pixel centres lie at integers, (0, 0) top left.</small></p>\n";
}

std::string Tilt(const Calibration& c)
{
	std::string out = "<h2>Tilt, models, photographs</h2>\n";
	const std::string evidence = EvidenceTable(c), models = ModelsTable(c);
	out += c.task.states.size() < 2 ? "<p>No tilted state was photographed.</p>\n" : evidence;
	if (!models.empty())
		out += "<h3>Models</h3>\n<p>Each model was fitted without one photograph after the other and asked for that photograph's blur. The difference of an edge counts up to a bound, so that one bad edge does not decide.</p>\n" + models;
	return out + "<h3>Photographs</h3>\n" + PhotographsTable(c) + "<p><small>Blur misfit counts every edge in full. The last two columns are of fits without the photograph; there the difference of an edge counts up to a bound only, so that the last column may be the smaller one.</small></p>\n";
}

std::string Effects(const Calibration& c)
{
	const std::string table = EffectsTable(c);
	if (table.empty())
		return "";
	std::string out = "<h2>Effects</h2>\n<p>What the camera blocks simulate. A scene pays only for what is written.</p>\n" + table;
	if (!c.vignetting.failure.empty())
		return out;
	out += "<h3>Fall-off of the light</h3>\n<p>Each dot is an evenly bright patch, its exposure and the gradient of its lighting taken out; the ring is what the model says of it. Patches at one angle differ "
		"where rims cut a lens that is tilted or focused obliquely.</p>\n<div class=\"pair\">\n";
	for (size_t s = 0; s < c.task.states.size(); ++s)
	{
		const std::string plot = FalloffPlot(c, s);
		if (!plot.empty())
			out += "<div><h4>" + HtmlText(c.task.states[s].name) + "</h4>\n" + plot + "</div>\n";
	}
	return out + "</div>\n<p><small>" + fmt::format("The model leaves {:.2f} % RMS over.", 100 * FalloffOf(c).rms) + "</small></p>\n";
}

std::string Sketches(const Calibration& c)
{
	std::string out = "<h2>Camera, boards and plane of focus</h2>\n<p>To scale, in millimetres, in the camera's frame: origin at the lens centre, x right, y up, z forward. "
		"Boards are numbered and coloured by photograph. Blue: the surface of focus inside the picture; dashed: the plane that touches it on the lens axis. "
		"On the screen each sketch can be turned, the lens tilted, focused and stopped down, and its <code>tilt_lens</code> block copied.</p>\n";
	for (size_t s = 0; s < c.task.states.size(); ++s)
		out += "<h3>" + HtmlText(c.task.states[s].name) + "</h3>\n" + PlanePart(LensOfState(c, s)) + "<div class=\"plane-still\">" + SceneSvg(c, s) + "</div>\n";
	return out;
}

std::string PhotoKey(const State& state)
{
	std::string out = "<p class=\"key\">";
	for (size_t p = 0; p < state.photos.size(); ++p)
		out += fmt::format("<span><i style=\"color:{}\">■</i> {} {}</span> ", html::PhotoColour(p), p + 1, HtmlText(BaseName(state.photos[p].file)));
	return out + "</p>\n";
}

std::string Residuals(const Calibration& c)
{
	std::string out = "<h2>What the model leaves over</h2>\n<p>Noise has no pattern. Arrows that turn or spread, and strokes whose colour changes with their place or their direction, are aberrations that the model does not have.</p>\n";
	for (size_t s = 0; s < c.task.states.size(); ++s)
	{
		out += "<h3>" + HtmlText(c.task.states[s].name) + "</h3>\n" + PhotoKey(c.task.states[s]);
		out += "<div class=\"pair\">\n<div><h4>Blur width of every edge</h4>" + BlurPlot(c, s) + "</div>\n<div><h4>Corners: reprojected − measured</h4>" + CornerMap(c, s) + "</div>\n";
		out += "<div><h4>Blur of edges across the radius (tangential focus): measured − predicted</h4>" + BlurMap(c, s, true) + "</div>\n"
			"<div><h4>Blur of edges along the radius (sagittal focus): measured − predicted</h4>" + BlurMap(c, s, false) + "</div>\n</div>\n";
	}
	return out;
}

std::string Overlays(const Calibration& c, const ReportPictures& pictures)
{
	std::string out = "<h2>Photographs with what was measured and predicted</h2>\n<p class=\"key\"><span>green cross: measured corner</span><span>magenta: its error, 20 times as long</span>"
		"<span>thick ring: measured blur disc (yellow as predicted, red larger, blue smaller)</span><span>thin blue ring: predicted</span></p>\n<p><small>Click a picture to enlarge it, and again to shrink it. "
		"The full pictures are the files <code>overlay-STATE-N.png</code> beside this page.</small></p>\n";
	size_t n = 0;
	for (const State& state : c.task.states)
	{
		out += "<h3>" + HtmlText(state.name) + "</h3>\n<div class=\"photos\">\n";
		for (size_t p = 0; p < state.photos.size(); ++p, ++n)
		{
			const std::string name = HtmlText(BaseName(state.photos[p].file)), uri = pictures.Uri(n);
			out += "<figure>";
			if (!uri.empty())
				out += fmt::format("<label><input type=\"checkbox\" aria-label=\"enlarge {0}\"/><img alt=\"{0}\" src=\"{1}\"/></label>", name, uri);
			out += fmt::format("<figcaption><i style=\"color:{}\">■</i> {} {}</figcaption></figure>\n", html::PhotoColour(p), p + 1, name);
		}
		out += "</div>\n";
	}
	return out;
}

/// Where the photographs say more of a number's uncertainty than its edges.
std::string SigmasByPhotographs(const Calibration& calibration)
{
	const NamedCovariance& c = calibration.solution.covariance;
	if (!calibration.jointly)
		return "Geometry and blur were not refined together: these are the edges' own sigmas, of the blur with the places held. ";
	if (c.by_photographs.empty())
		return "There are too few photographs to judge them by what they say against each other. ";
	double most = 0;
	size_t at = 0;
	for (size_t i = 0; i < c.names.size(); ++i)
		if (const double ratio = c.by_photographs[i] / std::sqrt(c.matrix[i * (c.names.size() + 1)]); ratio > most)
		{
			most = ratio;
			at = i;
		}
	return fmt::format("A model's error is common to all edges of a photograph; so each photograph was left out in turn, and where the answers scatter more than the edges alone would let them, that scatter is the sigma: "
		"here up to {:.1f} times the edges' own ({}). ", most, HtmlText(c.names[at]));
}

/// Of the sentence on the sigmas.
std::string BoardInSigmas(const Board& board)
{
	const double relative = board.square_sigma_mm / board.square_mm;
	return relative > 0 ? fmt::format("The board's size is taken to be known to {:.2g} %, which is in the sigmas of all lengths that grow with it. ", 100 * relative)
		: std::string("The board's size is taken to be exact: an error of it scales every length that grows with it (<code>--square VALUE:SIGMA</code> puts it into the sigmas). ");
}

std::string Fine(const Calibration& c)
{
	std::string out = "<h2>Correlations, priors, and how to use the result</h2>\n";
	const std::string correlations = CorrelationTable(c);
	out += correlations.empty() ? "<p>This model gives no correlations.</p>\n"
		: "<p>Correlations of the estimates (q is the inverse-focus vector; its x and y are the tilt). Above some 0.97 two numbers can hardly be told apart.</p>\n" + correlations;
	out += "<h3>Priors</h3>\n" + PriorsTable(c);
	out += "<h3>What the sigmas hold</h3>\n<p>They come from the covariance of the fit, rescaled by its residuals: the noise of the measured corners and edges, and as much of the model's error as scatters like noise. "
		+ SigmasByPhotographs(c) +
		"Where another answer of this calibration (of a part of the edges, of the other lens) lies farther off, they hold that. " + BoardInSigmas(c.task.board) +
		"They do not hold an error of the pitch, nor an aberration that none of these answers has. "
		"The table of what leaving a photograph out changes, and the maps above, are the check.</p>\n";
	const std::string& name = c.task.states.back().name;
	out += fmt::format("<h3>In POV-Ray</h3>\n<p>Each state has a file <code>camera-STATE.inc</code>; the world's unit is 1 mm. With the patched POV-Ray:</p>\n<pre>#include &quot;camera-{0}.inc&quot;\n"
		"TiltCal_{0}(&lt;0, 0, -1000&gt;, &lt;0, 0, 0&gt;, y)   // location, look_at, sky\n// or the camera of a photograph, the board's first inner corner at the origin:\nTiltCal_{0}_Pose(1)</pre>\n"
		"<p>{1}All numbers, with their sigmas, are in <code>calibration.json</code>.</p>\n", HtmlText(name),
		c.SceneLensIsUsed() ? "The cameras are the real lens's; <code>#declare TiltCal_Real_Lens = 0;</code> before the include takes the thin one's. " :
		c.RealLensIsUsed() ? "<code>#declare TiltCal_Real_Lens = 1;</code> before the include takes the real lens, else the cameras are the thin one's. " :
		c.MainGeometry().distortion_terms ? "<code>#declare TiltCal_Distortion = 0;</code> before the include takes the camera that was fitted without distortion. " : "");
	return out;
}

}

ReportPictures::ReportPictures(const Task& task) : height(task.height)
{
	size_t photos = 0;
	for (const State& state : task.states)
		photos += state.photos.size();
	// base64 makes 4 bytes of 3.
	bytes_each = std::min<size_t>(600000, 10500000 / std::max<size_t>(photos, 1));
}

void ReportPictures::Add(const cv::Mat& overlay)
{
	uris.push_back(html::JpegUri(overlay.rowRange(0, std::min(height, overlay.rows)), 1200, bytes_each));
}

std::string ReportHtml(const Calibration& c, const RunNotes& notes, const ReportPictures& pictures)
{
	return PageHead(notes.watch.on, PlaneStyle()) + Summary(c, notes) + Tilt(c) + Effects(c) + Sketches(c) + Residuals(c) + Overlays(c, pictures) + Fine(c) +
		"<script>\n" + PlaneScript() + "</script></body></html>\n";
}

}
