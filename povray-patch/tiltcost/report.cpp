// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcost
{

namespace
{

/// Beyond this share of the error's square a row counts as extrapolated.
const double MuchExtrapolated = 0.5;

std::string RowText(const Row& row, char mark)
{
	const Prediction& p = row.predicted;
	const std::string denoised = row.denoised_error > 0 ? fmt::format("{:.5f}", row.denoised_error) : "-";
	return fmt::format("{} {:>9.5f}{}  {:>7.2f}  {:>8}  {:>8.1f}  {:>8}  {:>12}  {:>12}  {}\n", mark, p.error, p.extrapolated > MuchExtrapolated ? '~' : ' ',
		p.Levels(), denoised, row.rays_per_pixel, CountText(row.rays), DurationText(row.cpu), DurationText(row.wall), SceneText(row.setting));
}

/// How sure the predictions are, by the least sure of the rows.
std::string SpreadText(const Report& report)
{
	if (const std::string few = FewBlocksText(report); !few.empty())
		return few;
	Spread most;
	for (const Row& row : report.rows)
		most = {std::max(most.error, row.spread.error), std::max(most.denoised, row.spread.denoised), std::max(most.seconds, row.spread.seconds)};
	if (most.error <= 0 && most.seconds <= 0)
		return {};
	const std::string denoised = most.denoised > 0 ? fmt::format(", denoised ones within {:.0f} %", std::ceil(100 * most.denoised)) : "";
	return fmt::format("Predicted from a part of the picture: errors within {:.0f} %{}, times within {:.0f} % (one standard deviation, of the least sure row).\n",
		std::ceil(100 * most.error), denoised, std::ceil(100 * most.seconds));
}

std::string Quoted(const std::string& text)
{
	std::string quoted = "\"";
	for (const char c : text)
		quoted += c == '"' ? "\"\"" : std::string(1, c);
	return quoted + "\"";
}

std::string StopText(const Report& report, size_t stop)
{
	const std::string bound = fmt::format("{:.2g} of an 8-bit level", report.stop_levels);
	if (stop == report.rows.size())
		return fmt::format("No row reaches {}, where it stops paying: every row still gains.\n", bound);
	return fmt::format("* Here it stops paying: the first row whose error is below {}{}.\n"
		"  Finer rows cost time that an 8-bit picture does not show; --stop-levels sets another bound.\n",
		bound, std::abs(report.stop_levels - 0.29) < 1e-9 ? ", the RMS of rounding to 8 bits" : "");
}

}

std::string DurationText(double seconds)
{
	if (seconds < 99.95)
		return fmt::format("{:.1f} s", seconds);
	const double minutes = std::floor(seconds / 60 + 0.5 / 60);
	if (minutes < 100)
		return fmt::format("{:.0f} min {:02.0f} s", minutes, std::max(0.0, std::floor(seconds + 0.5) - 60 * minutes));
	const double whole = std::floor(seconds / 60 + 0.5);
	return fmt::format("{:.0f} h {:02.0f} min", std::floor(whole / 60), std::fmod(whole, 60));
}

std::string CountText(double count)
{
	const char* prefixes[] = {"", " k", " M", " G", " T"};
	size_t i = 0;
	for (; count >= 999.5 && i + 1 < std::size(prefixes); ++i)
		count /= 1000;
	return fmt::format("{:.3g}{}", count, prefixes[i]);
}

std::string HeaderText(const Report& report)
{
	const RenderLog& log = report.pilot.log;
	const Machine& machine = report.pilot.machine;
	std::string text = fmt::format("{}: {} x {} pixels{}, {} thread{}\n", report.scene, log.width, log.height,
		log.pixels < double(log.width) * log.height ? fmt::format(" ({} of them rendered)", CountText(log.pixels)) : "",
		machine.threads, machine.threads > 1 ? "s" : "");
	if (report.range.Count() > 1)
		text += fmt::format("A film of {} frames, {} to {}: errors are RMS over all of them, rays and times those of all together.\n", report.range.Count(),
			report.range.first, report.range.last);
	text += fmt::format("Pilot: {} blocks of {} x {} pixels, {} samples each, in {}. Before the first ray{}: {} ({} CPU).\n", report.blocks, tilt_lens::PilotBlockSize,
		tilt_lens::PilotBlockSize, report.samples,
		DurationText(report.pilot.wall), report.range.Count() > 1 ? " of each frame" : "",
		DurationText(machine.start_wall / report.range.Count()), DurationText(machine.start_cpu / report.range.Count()));
	text += SpreadText(report);
	if (log.radiosity)
		text += "Radiosity: its pretrace counts as start; what is gathered later depends on where the rays go and is predicted less well.\n";
	return text;
}

std::string TableText(const Report& report)
{
	std::string text = "  RMS error     8-bit  with de-      rays      rays      CPU time  render time  to write into the camera block\n"
		"    (of 1)     levels  noise      per pixel    in all\n";
	const size_t stop = StopsPaying(report.rows, report.stop_levels);
	bool extrapolated = false;
	for (size_t i = 0; i < report.rows.size(); ++i)
	{
		text += RowText(report.rows[i], i == stop ? '*' : ' ');
		extrapolated |= report.rows[i].predicted.extrapolated > MuchExtrapolated;
	}
	for (const Row& row : report.own)
	{
		text += RowText(row, '=');
		extrapolated |= row.predicted.extrapolated > MuchExtrapolated;
	}
	text += StopText(report, stop);
	if (!report.own.empty())
		text += "= The settings that --setting names.\n";
	text += fmt::format("With denoise: the RMS error when tilt_lens {{ denoise }} is written too; takes {} more.\n", DurationText(report.denoise_seconds));
	if (extrapolated)
		text += fmt::format("~ Extrapolated beyond the pilot's {} samples.\n", report.samples);
	return text;
}

std::string FramesText(const Report& report)
{
	if (report.frames.empty())
		return {};
	std::string text = fmt::format("Frames by themselves, {}:\n  frame   RMS error  render time\n", SceneText(report.frames[0].row.setting));
	for (const FrameRow& frame : report.frames)
		text += fmt::format("  {:>5}   {:>9.5f}  {:>11}\n", frame.frame, frame.row.denoised_error > 0 ? frame.row.denoised_error : frame.row.predicted.error,
			DurationText(frame.row.wall));
	return text;
}

std::string FewBlocksText(const Report& report)
{
	if (report.blocks >= LeastBlocksForSpread || report.blocks * std::pow(tilt_lens::PilotBlockSize, 2) >= report.pilot.machine.pixels)
		return {};
	return fmt::format("Predicted from {} blocks, too few to say how surely: a longer --pilot-time traces more.\n", report.blocks);
}

std::string AnswerText(const Row& row)
{
	const bool denoised = row.denoised_error > 0;
	std::string text = fmt::format("{}\n  RMS error {:.5f}", SceneText(row.setting), denoised ? row.denoised_error : row.predicted.error);
	if (!denoised)
		text += fmt::format("{}, {:.2f} 8-bit levels", row.predicted.extrapolated > MuchExtrapolated ? " (extrapolated)" : "", row.predicted.Levels());
	text += fmt::format("; {} rays, {:.1f} per pixel; {} ({} CPU)\n", CountText(row.rays), row.rays_per_pixel, DurationText(row.wall), DurationText(row.cpu));
	const double error = denoised ? row.spread.denoised : row.spread.error;
	if (error > 0 || row.spread.seconds > 0)
		text += fmt::format("  The error is known to {:.0f} %, the time to {:.0f} % (one standard deviation).\n", std::ceil(100 * error), std::ceil(100 * row.spread.seconds));
	return text;
}

std::string CsvText(const Report& report)
{
	std::string text = "scene,kind,rms_error,levels_8bit,rays,rays_per_pixel,cpu_s,wall_s,min,max,variance,confidence,extrapolated,denoised_rms_error,denoise_cpu_s,"
		"rms_error_sigma,denoised_rms_error_sigma,cpu_s_sigma\n"; // sigmas: relative
	const size_t stop = StopsPaying(report.rows, report.stop_levels);
	const auto add = [&](const Row& row, const char* kind)
	{
		const Prediction& p = row.predicted;
		text += fmt::format("{},{},{:.6g},{:.4g},{:.6g},{:.5g},{:.5g},{:.5g},{},{},{:.9g},{:.9g},{:.3g},{:.6g},{:.3g},{:.3g},{:.3g},{:.3g}\n", Quoted(report.scene), kind, p.error, p.Levels(), row.rays,
			row.rays_per_pixel, row.cpu, row.wall, row.setting.min, row.setting.max, row.setting.variance, row.setting.confidence, p.extrapolated, row.denoised_error, report.denoise_seconds,
			row.spread.error, row.spread.denoised, row.spread.seconds);
	};
	for (size_t i = 0; i < report.rows.size(); ++i)
		add(report.rows[i], i == stop ? "stops-paying" : "row");
	for (const Row& row : report.own)
		add(row, "own");
	return text;
}

}
