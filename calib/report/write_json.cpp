// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/write_json.h"

#include "report/effects_json.h"
#include "report/json_parts.h"
#include "report/next_json.h"
#include "model/focus_words.h"
#include "model/names.h"
#include "lens/angles.h"
#include "model/projection.h"
#include <tiltcal/calibrate.h>
#include "calibrate/exif_check.h"
#include "effects/fixed_blades.h"
#include "camera/state_camera.h"

#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

const double DEGREES = tilt_lens::DegreesPerRadian;

Json RotationRows(const Pose& pose)
{
	double columns[9];
	ceres::AngleAxisToRotationMatrix(pose.data(), columns);   // column-major
	Json rows = Json::array();
	for (int r = 0; r < 3; ++r)
		rows.push_back({ columns[r], columns[r + 3], columns[r + 6] });
	return rows;
}

Json PhotoJson(const std::vector<Stop>& stops, const Photo& photo, const Geometry& g, size_t s, size_t p)
{
	Json json;
	const Pose& pose = g.states[s].poses[p];
	const Pose& sigma = g.states[s].pose_sigmas[p];
	json["file"] = photo.file;
	if (!stops.empty())
		json["f_number"] = stops[photo.stop].f_number;
	json["rotation"] = RotationRows(pose);
	json["rotation_sigma_deg"] = { sigma[0] * DEGREES, sigma[1] * DEGREES, sigma[2] * DEGREES };
	json["translation_mm"] = { pose[3], pose[4], pose[5] };
	json["translation_sigma_mm"] = { sigma[3], sigma[4], sigma[5] };
	json["rms_reprojection_px"] = g.states[s].photo_rms[p];
	json["edges"] = photo.edges.size();
	json["edges_dropped"] = photo.edges_dropped;
	return json;
}

/// name_unit and name_sigma_unit of a place in the picture.
void PutPrincipalPoint(Json& json, const StateCamera& camera)
{
	json["principal_point_px"] = camera.principal_point;
	json["principal_point_sigma_px"] = camera.sigma.principal_point;
}

/// What cannot be told from infinity has no distance; its 1/U is in inverse_focus_per_mm.
void PutFocus(Json& json, const StateLens& lens)
{
	const double none = std::numeric_limits<double>::quiet_NaN();
	const bool told = FocusPlaceOf(InverseFocus(lens)) != FocusPlace::AT_INFINITY;
	Put(json, "focus_distance", "_mm", told ? lens.focus_distance : Estimate{ none, none });
}

Json StateJson(const Calibration& c, const Solution& solution, const Geometry& g, size_t s)
{
	const StateCamera camera = CameraOfFit(c.task, solution, g, s);
	const StateLens& lens = solution.states[s];
	const State& state = c.task.states[s];
	const auto vector = [](const Vec3<double>& v) { return Json{ v.x, v.y, v.z }; };
	Json json;
	json["name"] = camera.state;
	Put(json, "lens_tilt", "_deg", { camera.lens_tilt_deg, camera.sigma.lens_tilt_deg });
	Put(json, "tilt_direction", "_deg", { camera.tilt_direction_deg, camera.sigma.tilt_direction_deg });
	Put(json, "focal_plane_tilt", "_deg", { camera.focal_plane_tilt_deg, camera.sigma.focal_plane_tilt_deg });
	PutFocus(json, lens);
	Put(json, "focal_length", "_mm", { camera.focal_length_mm, camera.sigma.focal_length_mm });
	PutPrincipalPoint(json, camera);
	json["principal_point_fixed"] = g.states[s].principal_point_fixed;
	json["lens_centre_mm"] = vector(camera.lens_centre_mm);
	json["lens_centre_sigma_mm"] = vector(camera.sigma.lens_centre_mm);
	json["inverse_focus_per_mm"] = vector(lens.q);
	json["inverse_focus_sigma_per_mm"] = vector(lens.q_sigma);
	json["rms_blur_px"] = lens.rms_blur;
	json["chosen_by_power"] = lens.chosen_by_power;
	json["photos"] = Json::array();
	for (size_t p = 0; p < state.photos.size(); ++p)
		json["photos"].push_back(PhotoJson(c.task.stops, state.photos[p], g, s, p));
	return json;
}

/// The tilts by blur alone and by geometry alone.
Json EvidenceJson(const Calibration& c)
{
	Json json = Json::object();
	const auto add = [&](const char* evidence, const std::vector<StateLens>& states)
	{
		for (size_t s = 1; s < states.size(); ++s)
		{
			Json& state = json[evidence][c.task.states[s].name];
			PutTilt(state, states[s]);
		}
	};
	add("blur_alone", c.blur_alone);
	add("geometry_alone", c.geometry_alone.states);
	if (!c.geometry_alone.states.empty())
		Put(json["geometry_alone"], "pupil_magnification", "", c.geometry_alone.pupil_magnification);
	return json;
}

Json SolutionJson(const Calibration& c, const Solution& solution, const Geometry& g)
{
	const StateCamera camera = CameraOfFit(c.task, solution, g, 0);
	Json json;
	json["model"] = camera.model;
	Put(json, "image_distance", "_mm", { camera.image_distance_mm, camera.sigma.image_distance_mm });
	Put(json, "focal_length", "_mm", solution.focal_length);
	PutFocus(json, solution.states[0]);
	Put(json, "aperture_diameter", "_mm", { camera.aperture_diameter_mm, camera.sigma.aperture_diameter_mm });
	if (!solution.stop_ratios.empty())
		json["stops"] = StopsJson(c.task.stops, solution.stop_ratios, camera.aperture_diameter_mm);
	PutPrincipalPoint(json, camera);
	for (size_t k = 0; k < 5; ++k)
	{
		json["distortion"][DISTORTION_NAMES[k]] = camera.distortion[k];
		json["distortion"][std::string(DISTORTION_NAMES[k]) + "_sigma"] = camera.sigma.distortion[k];
	}
	json["distortion_terms"] = g.distortion_terms;
	json["distortion_axis"] = "lens axis";
	json["shared_poses"] = g.shared_poses;
	Put(json, "field_curvature", "_per_mm", { camera.field_curvature_per_mm, camera.sigma.field_curvature_per_mm });
	if (solution.model == Model::CURVED)
	{
		Put(json, "tangential_curvature", "_per_mm", solution.tangential_curvature);
		Put(json, "sagittal_curvature", "_per_mm", solution.sagittal_curvature);
	}
	Put(json, "psf_floor", "_px", { camera.psf_floor_px, camera.sigma.psf_floor_px });
	json["rms_reprojection_px"] = g.rms;
	json["rms_blur_px"] = solution.rms_blur;
	json["states"] = Json::array();
	for (size_t s = 0; s < solution.states.size(); ++s)
		json["states"].push_back(StateJson(c, solution, g, s));
	return json;
}

/// Each against the others, as the verdict judges them.
Json PhotographsJson(const Calibration& c)
{
	Json list = Json::array();
	for (const PhotographCheck& p : c.photographs)
	{
		Json entry{ { "state", c.task.states[p.state].name }, { "file", c.task.states[p.state].photos[p.photo].file }, { "edges", p.edges }, { "rms_reprojection_px", p.rms_places },
			{ "rms_reprojection_others_px", p.places_typical }, { "rms_blur_px", p.rms_blur }, { "rms_blur_others_px", p.blur_typical }, { "stands_out", p.odd_places || p.odd_blur } };
		if (p.fits_state)
			entry["fits_state"] = c.task.states[*p.fits_state].name;
		if (p.same_as)
			entry["same_as"] = c.task.states[p.same_as->first].photos[p.same_as->second].file;
		list.push_back(entry);
	}
	return list;
}

Json BoardCheckJson(const BoardCheck& b)
{
	Json json;
	Put(json, "widening", "", b.widening);
	Put(json, "bend_along_columns", "_mm", b.bend_along_columns);
	Put(json, "bend_along_rows", "_mm", b.bend_along_rows);
	Put(json, "twist", "_mm", b.twist);
	json["rms_as_told_px"] = b.rms_flat;
	json["rms_px"] = b.rms_free;
	json["image_distance_change_mm"] = b.w_change;
	return json;
}

/// The tilts are the real lens's, where that is the answer; what the thin lens has in their place stays beside them, for all else is of one camera with it.
void PutAnswer(const Calibration& c, Json& json)
{
	if (!c.RealLensIsUsed())
		return;
	json["model"] = NameOf(c.Answer());
	json["thin_model"] = NameOf(c.solution.model);
	for (size_t s = 0; s < c.solution.states.size(); ++s)
	{
		Json& state = json["states"][s];
		PutTilt(state["thin"], c.solution.states[s]);
		PutTilt(state, c.TiltOf(s));
	}
}

Json VerdictJson(const Verdict& verdict)
{
	Json json{ { "grade", NameOf(verdict.grade) }, { "remarks", Json::array() } };
	for (const Remark& remark : verdict.remarks)
		json["remarks"].push_back({ { "grade", NameOf(remark.grade) }, { "text", remark.text } });
	return json;
}

/// What --board, --target, --square and --circle-diameter said.
Json BoardJson(const Board& board)
{
	if (board.IsCheckerboard())
		return { { "kind", NameOf(board.kind) }, { "squares", { board.columns, board.rows } }, { "square_mm", board.square_mm }, { "square_sigma_mm", board.square_sigma_mm } };
	return { { "kind", NameOf(board.kind) }, { "circles", { board.columns, board.rows } }, { "spacing_mm", board.square_mm }, { "spacing_sigma_mm", board.square_sigma_mm },
		{ "circle_diameter_mm", board.circle_diameter_mm } };
}

Json BladesJson(const Calibration& c)
{
	const FixedBlades& blades = c.task.blades;
	return { { "count", blades.count }, { "rotation_deg", blades.rotation_deg }, { "curvature", blades.curvature },
		{ "aperture_diameter_mm", c.solution.aperture_diameter.value * WideningForBlades(blades) } };
}

/// What each model predicts of edges that were held out; null: it does not.
Json HeldOutJson(const ModelComparison& compared)
{
	Json json;
	for (const Solution* s : compared.All())
		json[NameOf(s->model)] = s->failure.empty() && s->held_out_px > 0 ? Json(s->held_out_px) : Json();
	return json;
}

Json UntiltedCheckJson(const Calibration& c)
{
	Json json;
	Put(json, "lens_tilt", "_deg", c.untilted_check.lens_tilt);
	Put(json, "tilt_direction", "_deg", c.untilted_check.tilt_direction);
	if (c.untilted_check.by_places)
		PutTilt(json["by_places"], *c.untilted_check.by_places);
	return json;
}

Json LeftOutJson(const Calibration& c)
{
	Json json = Json::array();
	for (const LeftOut& l : c.solution.left_out)
		json.push_back({ { "state", c.task.states[l.state].name }, { "file", c.task.states[l.state].photos[l.photo].file },
			{ "tilt_change_deg", l.tilt_change }, { "aperture_change_mm", l.aperture_change }, { "inverse_focus_change_per_mm", l.inverse_focus_change }, { "rms_blur_px", l.rms_blur } });
	return json;
}

Json LightJson(const Calibration& c)
{
	Json json;
	json["clipped_edges_share"] = c.light.clipped_share;
	Put(json, "sharpening", "_px2", c.light.sharpening);
	Put(json, "overshoot", "", c.light.overshoot);
	Put(json, "bend", "", c.light.bend);
	Json& states = json["bend_of_states"] = Json::array();
	for (size_t s = 0; s < c.light.bend_of_states.size(); ++s)
	{
		states.push_back({ { "state", c.task.states[s].name } });
		Put(states.back(), "bend", "", c.light.bend_of_states[s]);
	}
	const double unknown = std::numeric_limits<double>::quiet_NaN();
	Put(json, "exponent", "", c.light.exponent.value_or(Estimate{ unknown, unknown }));
	return json;
}

/// What is told where the calibration was checked against itself.
void PutChecks(const Calibration& c, Json& json)
{
	if (c.board_check.known)
		json["board_check"] = BoardCheckJson(c.board_check);
	if (c.focus_check.known)
		json["focus_check"] = { { "rms_together_px", c.focus_check.rms_together }, { "rms_apart_px", c.focus_check.rms_apart } };
	if (c.untilted_check.known)
		json["untilted_check"] = UntiltedCheckJson(c);
	json["converged"] = c.refined;
	json["left_out"] = LeftOutJson(c);
	if (c.solution.model != Model::PAPER)
		json["light"] = LightJson(c);
	if (c.IsJudged())
		json["verdict"] = VerdictJson(c.verdict);
}

}

std::string CalibrationJson(const Calibration& c)
{
	Json json = SolutionJson(c, c.solution, c.MainGeometry());
	PutAnswer(c, json);
	for (size_t s = 1; s < c.solution.states.size() && c.IsJudged(); ++s)
		json["states"][s]["lens_tilt_model_sigma_deg"] = c.TiltLeftOutByModel(s);
	json["image_size_px"] = { c.task.width, c.task.height };
	json["pixel_pitch_mm"] = c.task.pitch_mm;
	json["exif"] = ExifJson(c.task);
	json["board"] = BoardJson(c.task.board);
	json["frames"] = "camera: x right, y up, z forward; board: origin at the first inner corner or circle's centre, x along the columns, y up the rows, z into it; "
		"X_camera = rotation X_board + translation_mm; pixel centres at integers, (0, 0) top left";
	json["effects"] = EffectsJson(c);
	json["vignetting"] = VignettingJson(c);
	json["chromatic"] = ChromaticJson(c);
	if (c.task.blades.count)
		json["blades"] = BladesJson(c);
	if (c.paper.failure.empty())
		json["comparison"]["paper"] = SolutionJson(c, c.paper, c.paper_geometry);
	else
		json["comparison"]["paper"] = { { "failure", c.paper.failure } };
	if (c.compared)
		json["held_out_blur_px"] = HeldOutJson(*c.compared);
	for (const Prior& prior : c.task.priors)
		json["priors"][prior.Name()] = { { "value", prior.value }, { "sigma", prior.sigma } };
	for (const Correlation& r : c.solution.correlations)
		json["correlations"][r.first][r.second] = r.value;
	json["tilt_told_by"] = EvidenceJson(c);
	if (c.real_lens)
		json["real_lens"] = RealLensJson(c, *c.real_lens);
	if (c.scene_lens)
		json["scene_lens"] = RealLensJson(c, *c.scene_lens);
	if (!c.solution.covariance.names.empty())
	{
		json["covariance"] = CovarianceJson(c.solution.covariance);
		json["sigma_by_photographs"] = SigmasByPhotographs(c.solution.covariance);
	}
	if (!c.photographs.empty())
		json["photographs"] = PhotographsJson(c);
	PutChecks(c, json);
	if (c.next.known)
		json["next_photographs"] = NextPhotographsJson(c);
	json["render"] = SolutionJson(c, c.render, c.RenderGeometry());
	json["render"]["note"] = "the camera without distortion that the .inc files take where TiltCal_Distortion is set to 0, or where this lens needs no distortion";
	json["program"] = "tiltcal " TILTCAL_VERSION;
	// A file name may be in another encoding than JSON's.
	return json.dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

}
