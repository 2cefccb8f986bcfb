// SPDX-License-Identifier: AGPL-3.0-or-later

#include "closed_loop.h"

#include "model/tilt_angles.h"
#include "support/traced_picture.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <tuple>

namespace cameras
{

namespace
{

using tiltcal::Calibration;

Deviation Of(const std::string& name, double truth, const tiltcal::Estimate& found) { return { name, truth, found.value, found.sigma }; }

/// Tilts as vectors: along the true one, and across it.
void AddTilt(const Calibration& c, size_t s, const std::pair<double, double>& truth, Answer& a)
{
	const tiltcal::StateLens& lens = c.TiltOf(s);
	const double phi = truth.second * M_PI / 180;
	const Eigen::Vector2d along(std::cos(phi), std::sin(phi)), across(-along.y(), along.x());
	const double found_phi = lens.tilt_direction.value * M_PI / 180;
	const Eigen::Vector2d found = lens.lens_tilt.value * Eigen::Vector2d(std::cos(found_phi), std::sin(found_phi));
	const std::string state = " " + c.task.states[s].name;
	// A small tilt's direction is uncertain, its vector is not.
	a.deviations.push_back({ "tilt along" + state, truth.first, found.dot(along), lens.lens_tilt.sigma });
	a.deviations.push_back({ "tilt across" + state, 0, found.dot(across), lens.tilt_direction.sigma * M_PI / 180 * std::abs(lens.lens_tilt.value) });
	a.tilt_error = std::max(a.tilt_error, (found - truth.first * along).norm());
}

/// The prescription, scaled to the focal length and stopped to the f-number.
tiltcal::Prescription GlassOf(const Camera& camera)
{
	const tiltcal::Prescription printed = tiltcal::ReadPrescription(camera.glass);
	return tiltcal::StoppedTo(printed.Scaled(camera.focal_length / tiltcal::ParaxialOf(printed).focal_length), camera.f_number);
}

/// Moves the board aside until the glass sees its middle where the thin lens does, as one aims a camera anew: tilted about its stop, a telephoto turns its picture
/// out of the frame.
void AimAtBoard(const Camera& camera, const synthetic::Scene& thin, synthetic::TracedScene& traced)
{
	const Eigen::Vector2d middle = MiddleOf(camera.board), wanted = synthetic::PixelOf(thin, middle.x(), middle.y());
	for (int step = 0; step < 4; ++step)
	{
		const Eigen::Vector2d off = synthetic::TracedPixelOf(traced, middle.x(), middle.y()) - wanted;
		traced.origin.head<2>() -= off * camera.pitch * traced.origin.z() / camera.ImageDistance();
	}
}

/// What a pattern is behind the glass, where the thin lens's scene stands.
synthetic::TracedScene ThroughGlass(const Camera& camera, size_t state, const synthetic::Scene& scene)
{
	synthetic::TracedScene traced;
	traced.glass = GlassOf(camera);
	traced.sensor = { camera.width, camera.height, camera.pitch };
	if (state > 0)
		std::tie(traced.state.tilt_deg, traced.state.direction_deg) = camera.tilts[state - 1];
	traced.state.back_distance = tiltcal::FocusedBackDistance(traced.glass, tiltcal::ParaxialOf(traced.glass), camera.focus_distance);
	traced.state.pivot = traced.glass.StopHeight();
	traced.camera_from_board = scene.camera_from_board;
	traced.origin = scene.origin;
	traced.rays = 400;
	if (state > 0 && !camera.shared_poses)
		AimAtBoard(camera, scene, traced);
	return traced;
}

/// Of real glass the tilts are what can be told, and what it does near its axis: f, w by which it projects from the entrance pupil (the exit
/// pupil's distance over the pupil magnification), and d of the pupil.
void CompareThroughGlass(const Camera& camera, const Calibration& c, Answer& a)
{
	const tiltcal::Prescription glass = GlassOf(camera);
	const tiltcal::Paraxial p = tiltcal::ParaxialOf(glass);
	const double back = tiltcal::FocusedBackDistance(glass, p, camera.focus_distance);
	a.deviations.push_back(Of("w", (p.exit_pupil - p.last_vertex + back) / p.pupil_magnification, c.solution.w_mm));
	a.deviations.push_back(Of("f", camera.focal_length, c.solution.focal_length));
	a.deviations.push_back(Of("d", camera.Aperture(), c.solution.aperture_diameter));
	for (size_t s = 1; s < c.solution.states.size(); ++s)
		AddTilt(c, s, camera.tilts[s - 1], a);
}

void Compare(const Camera& camera, const Calibration& c, Answer& a)
{
	if (c.StopRatios().size() > 1)
		a.deviations.push_back(Of("stop", camera.f_number / camera.stopped_to, c.StopRatios()[1]));
	if (!camera.glass.empty())
		return CompareThroughGlass(camera, c, a);
	a.deviations.push_back(Of("w", camera.ImageDistance(), c.solution.w_mm));
	a.deviations.push_back(Of("f", camera.focal_length, c.solution.focal_length));
	a.deviations.push_back(Of("d", camera.Aperture(), c.solution.aperture_diameter));
	if (std::isfinite(camera.focus_distance) && camera.focus_distance > 0)
		a.deviations.push_back(Of("U", camera.focus_distance, c.solution.focus_distance));
	else
		a.deviations.push_back({ "1/U[1/m]", 1000 / camera.focus_distance, 1000 * c.solution.states[0].q.z, 1000 * c.solution.states[0].q_sigma.z });
	for (size_t s = 1; s < c.solution.states.size(); ++s)
		AddTilt(c, s, camera.tilts[s - 1], a);
	for (size_t s = 0; s < c.geometry.states.size(); ++s)
	{
		const tiltcal::StateGeometry& g = c.geometry.states[s];
		if (g.principal_point_fixed)
		{
			a.not_told.push_back("principal point " + c.task.states[s].name + ": held at the picture's centre");
			continue;
		}
		a.deviations.push_back({ "cx " + c.task.states[s].name, 0.5 * (camera.width - 1), g.principal_point[0], g.principal_point_sigma[0] });
		a.deviations.push_back({ "cy " + c.task.states[s].name, 0.5 * (camera.height - 1), g.principal_point[1], g.principal_point_sigma[1] });
	}
	if (c.geometry.distortion_terms > 0)
		a.deviations.push_back({ "k1", camera.k1, c.geometry.distortion[0], c.geometry.distortion_sigma[0] });
	else
		a.not_told.push_back(fmt::format("k1: not significant, taken to be 0 where {:.5f} is true", camera.k1));
}

}

double Deviation::InSigmas() const
{
	if (std::isfinite(found) && sigma > 0 && std::isfinite(sigma))
		return (found - truth) / sigma;
	return sigma == 0 && found == truth ? 0 : found < truth ? -HUGE_VAL : HUGE_VAL;
}

/// A print a tenth smaller, about its middle: what fills the thin lens's picture may be larger than glass's, whose distortion and keystone are its own.
void LeaveRoom(Camera& camera, std::vector<std::vector<synthetic::Scene>>& states)
{
	const Eigen::Vector2d before = MiddleOf(camera.board);
	camera.board.square_mm *= 0.9;
	camera.board.circle_diameter_mm *= 0.9;
	const Eigen::Vector2d aside = before - MiddleOf(camera.board);
	for (std::vector<synthetic::Scene>& scenes : states)
		for (synthetic::Scene& scene : scenes)
			scene.origin += scene.camera_from_board * Eigen::Vector3d(aside.x(), aside.y(), 0);
}

std::vector<std::vector<cv::Mat>> TakeAll(const Camera& camera, const std::vector<std::vector<synthetic::Scene>>& states, const synthetic::Pattern& pattern)
{
	std::vector<std::vector<cv::Mat>> pictures;
	for (size_t s = 0; s < states.size(); ++s)
	{
		pictures.emplace_back();
		for (const synthetic::Scene& scene : states[s])
			pictures.back().push_back(camera.glass.empty() ? synthetic::TakePicture(scene, pattern) : synthetic::TakeTracedPicture(ThroughGlass(camera, s, scene), pattern));
	}
	return pictures;
}

Negatives Photograph(const Camera& camera, unsigned seed)
{
	Negatives n{ camera, {}, {} };
	std::vector<std::vector<synthetic::Scene>> states = PhotographAll(n.camera, seed);
	if (!camera.glass.empty())
		LeaveRoom(n.camera, states);
	const tiltcal::Board& b = n.camera.board;
	const synthetic::Pattern pattern = b.IsCheckerboard() ? synthetic::Checkerboard(b.columns, b.rows, b.square_mm)
		: synthetic::Circles(b.columns, b.rows, b.square_mm, b.circle_diameter_mm, b.kind == tiltcal::TargetKind::ASYMMETRIC_CIRCLES);
	n.pictures = TakeAll(n.camera, states, pattern);
	if (camera.stopped_to > 0)
	{
		Camera stopped = n.camera;
		stopped.f_number = camera.stopped_to;
		for (std::vector<synthetic::Scene>& scenes : states)
			for (synthetic::Scene& scene : scenes)
				scene.aperture = stopped.Aperture();
		n.stopped = TakeAll(stopped, states, pattern);
	}
	return n;
}

std::vector<tiltcal::StateFiles> DevelopAll(const Negatives& n, const Light& light, unsigned seed, const std::string& folder)
{
	std::filesystem::create_directories(folder);
	std::vector<tiltcal::StateFiles> states;
	const auto develop = [&](size_t s, const std::vector<cv::Mat>& pictures, unsigned first, const std::string& end, std::optional<double> f_number)
	{
		states.push_back({ s ? "tilted" + std::to_string(s) : "untilted", {}, f_number });
		for (size_t p = 0; p < pictures.size(); ++p)
			states.back().files.push_back(Develop(pictures[p], light, unsigned(first + 100 * s + p), folder + "/" + states.back().name + "-" + std::to_string(p) + end));
	};
	const bool stops = !n.stopped.empty();
	for (size_t s = 0; s < n.pictures.size(); ++s)
	{
		develop(s, n.pictures[s], seed * 1000, "", stops ? std::optional(n.camera.f_number) : std::nullopt);
		if (stops)
			develop(s, n.stopped[s], seed * 1000 + 50, "-stopped", n.camera.stopped_to);
	}
	return states;
}

Answer CalibrateFiles(const Negatives& n, const Light& light, const std::vector<tiltcal::StateFiles>& files, tiltcal::MeasureOptions measure, const tiltcal::CalibrateOptions& choice)
{
	Answer a;
	try
	{
		measure.transfer.kind = light.srgb ? tiltcal::Transfer::SRGB : tiltcal::Transfer::LINEAR;
		a.calibration = tiltcal::Calibrate(tiltcal::MeasureAll(files, n.camera.board, n.camera.pitch, measure), choice);
		Compare(n.camera, a.calibration, a);
	}
	catch (const tiltcal::Error& e)
	{
		a.refusal = e.what();
	}
	return a;
}

Answer CloseTheLoop(const Negatives& n, const Light& light, unsigned seed, const std::string& folder, const tiltcal::CalibrateOptions& choice)
{
	return CalibrateFiles(n, light, DevelopAll(n, light, seed, folder), {}, choice);
}

}
