// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/measure_all.h"

#include "calibrate/exif_check.h"
#include "calibrate/in_order.h"
#include "calibrate/quiet.h"
#include "calibrate/stops_of_photographs.h"
#include "calibrate/use_threads.h"
#include "measure/bright_patches.h"
#include "measure/measure.h"
#include "model/state_names.h"
#include "picture/image_io.h"
#include "solve/least_squares.h"
#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>
#include <utility>

namespace tiltcal
{

namespace
{

void LogPhoto(const Photo& photo, size_t number, size_t total, const Log& log)
{
	double least = photo.edges.empty() ? 0 : 1e9, most = 0;
	for (const Edge& e : photo.edges)
	{
		least = std::min(least, e.blur);
		most = std::max(most, e.blur);
	}
	log.Info(fmt::format("[{}/{}] {}: {}, blur {:.1f} to {:.1f} px; {}", number, total, photo.file,
		CountText(photo), least, most, RatioText(photo)));
	WarnOfEdges(photo, log);
}

size_t HashOf(const cv::Mat& grey)
{
	size_t hash = 0;
	for (int y = 0; y < grey.rows; ++y)
		hash = 31 * hash + std::hash<std::string_view>()({ grey.ptr<char>(y), size_t(grey.cols) * grey.elemSize() });
	return hash;
}

/// All pictures come from one sensor.
void CheckSize(Task& task, const Photo& photo)
{
	if (task.width == 0)
	{
		task.width = photo.width;
		task.height = photo.height;
	}
	if (photo.width != task.width || photo.height != task.height)
		throw Refused(fmt::format("{}: is {}x{} pixels, the photographs before it are {}x{}; all must come from the same camera, uncropped and not turned",
			photo.file, photo.width, photo.height, task.width, task.height));
}

/// Where a name comes first. Twice without an f-number it is two states', which may not be.
size_t FirstOf(const std::vector<StateFiles>& states, size_t k)
{
	for (size_t i = 0; i < k; ++i)
		if (states[i].name == states[k].name && (states[i].f_number || states[k].f_number))
			return i;
	return k;
}

}

void WarnOfEdges(const Photo& photo, const Log& log)
{
	if (photo.edges_dropped > 0)
		log.Warn(fmt::format("{}: {} of {} edges left out, too blurred or too noisy", photo.file, photo.edges_dropped,
			photo.edges_dropped + int(photo.edges.size())));
	if (photo.saturated_share > 0.05)
		log.Warn(fmt::format("{}: {:.0f} % of the edges have a clipped bright side, which narrows their blur: expose less", photo.file, 100 * photo.saturated_share));
}

void CheckPitch(double pitch_mm)
{
	if (!(pitch_mm > 0 && pitch_mm < 1))
		throw UsageError(fmt::format("`pitch` {}: give the distance of pixel centres on the sensor in mm, such as 0.00655", pitch_mm));
}

void CheckEdgesPerPhoto(int edges_per_photo)
{
	// Six edges of each direction reach all quarters of the board (test_spread_order.cpp).
	const int fewest = 12;
	if (edges_per_photo != 0 && edges_per_photo < fewest)
		throw UsageError(fmt::format("`edges_per_photo` {}: give 0 for all edges, or at least {}", edges_per_photo, fewest));
}

Task MeasureAll(const std::vector<StateFiles>& states, const Board& board, double pitch_mm, const MeasureOptions& options)
{
	return MeasureAll(states, board, pitch_mm, options, {});
}

MeasuredPhotograph MeasureOne(const std::string& file, const Board& board, const MeasureOptions& o, cv::Mat& grey)
{
	MeasuredPhotograph out;
	out.photo = MeasurePhoto(file, board, o.transfer, { o.any_orientation }, { o.edges_per_photo, o.edge_phase }, &grey);
	out.hash = HashOf(grey);
	return out;
}

TaskOfPhotographs::TaskOfPhotographs(const std::vector<StateFiles>& states, const Board& board, double pitch_mm)
{
	CheckPitch(pitch_mm);
	std::vector<std::string> names;
	for (size_t k = 0; k < states.size(); ++k)
	{
		if (states[k].f_number && !(*states[k].f_number > 0 && std::isfinite(*states[k].f_number)))
			throw UsageError(fmt::format("state {}: f_number {:g} is no number above 0", states[k].name, *states[k].f_number));
		const size_t first = FirstOf(states, k);
		sets.push_back({ first == k ? names.size() : sets[first].state, states[k].f_number });
		if (first == k)
			names.push_back(states[k].name);
	}
	CheckStateNames(names);
	task.board = board;
	task.pitch_mm = pitch_mm;
	for (const std::string& name : names)
		task.states.push_back({ name, !task.states.empty(), {} });
}

void TaskOfPhotographs::Add(size_t set, MeasuredPhotograph one)
{
	CheckSize(task, one.photo);
	// By their pixels: a copy under another name or in another lossless format is none the newer.
	const auto [at, is_new] = seen.emplace(one.hash, one.photo.file);
	if (!is_new)
		throw Refused(fmt::format("{}: has the pixels of {}: the same photograph twice makes sigmas too small, and in two states one of them is wrong; leave one out", one.photo.file, at->second));
	one.photo.f_number = sets[set].f_number;
	task.states[sets[set].state].photos.push_back(std::move(one.photo));
}

Task MeasureAll(const std::vector<StateFiles>& states, const Board& board, double pitch_mm, const MeasureOptions& o, const SeePicture& see)
{
	const QuietLibraries quiet;
	const UseThreads threads(o.threads);
	CheckEdgesPerPhoto(o.edges_per_photo);
	TaskOfPhotographs photographs(states, board, pitch_mm);
	std::vector<std::pair<size_t, std::string>> files;    // of `states`, file
	for (size_t s = 0; s < states.size(); ++s)
		for (const std::string& file : states[s].files)
			files.emplace_back(s, file);
	std::vector<MeasuredPhotograph> measured(files.size());
	InOrder(files.size(), AllThreads(), [&](size_t k)
	{
		cv::Mat grey;
		measured[k] = MeasureOne(files[k].second, board, o, grey);
		if (see)
			see(k, grey);
	}, [&](size_t k)
	{
		LogPhoto(measured[k].photo, k + 1, files.size(), o.log);
		photographs.Add(files[k].first, std::move(measured[k]));
	});
	Task task = photographs.Get();
	SetStops(task, o.log);
	LogFacts(task, o.log);
	return task;
}

void AddFlatField(Task& task, size_t state, const std::string& file, const MeasureOptions& o)
{
	const QuietLibraries quiet;
	if (state >= task.states.size())
		throw UsageError(fmt::format("`flat_field` {}: there is no state {}; the task has {}, counted from 0", file, state, task.states.size()));
	PhotographFacts facts;
	const cv::Mat picture = ReadLinear(file, o.transfer, &facts);
	if (picture.cols != task.width || picture.rows != task.height)
		throw Refused(fmt::format("`flat_field` {}: is {}x{} pixels, the photographs of the board are {}x{}; all must come from the same camera, uncropped and not turned",
			file, picture.cols, picture.rows, task.width, task.height));
	task.flat_fields.push_back({ state, file, MeasureFlatField(picture, file, facts.floating_point) });
	WarnOfOtherSetting(task, file, facts, o.log);
	o.log.Info(fmt::format("{}: flat field of state {}, {} cells", file, task.states[state].name, task.flat_fields.back().patches.size()));
}

}
