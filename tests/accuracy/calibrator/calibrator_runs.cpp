// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrator_runs.h"

#include "support/synthetic_lens.h"
#include <tiltcal/error.h>
#include "base/files.h"
#include "picture/image_io.h"
#include "measure/measure.h"
#include "measure/spread_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <tuple>

namespace calibrator_cost
{

namespace
{

const std::array<const char*, 3> STATES{ "untilted", "plus5", "minus5" };

class PhotographSource : public Source
{
public:
	explicit PhotographSource(const std::string& folder) : board(tiltcal::ParseBoard("12x9", 25))
	{
		const bool png = std::filesystem::exists(tiltcal::Join(folder, "untilted-1.png"));
		for (const char* const state : STATES)
		{
			shots.emplace_back();
			for (const std::string& file : tiltcal::ExpandGlobs({ tiltcal::Join(folder, std::string(state) + (png ? "-*.png" : "-*.jpg")) }, "--photos"))
				shots.back().push_back(Detect(file));
			if (shots.back().size() != shots.front().size())
				throw tiltcal::FileError(folder + ": the states have different numbers of photographs");
		}
	}

	int Photos() const override { return static_cast<int>(shots.front().size()); }

	// Of all photographs and all edges there is one choice; of some edges, one per phase.
	int Draws(const Effort& e, int wanted) const override
	{
		return e.edges ? std::min(wanted, 3) : std::min(wanted, static_cast<int>(Choices(Photos(), e.photos)));
	}

	double ShareUsed(const Effort& e) const override { return e.edges ? std::min(1.0, e.edges / double(tiltcal::SpreadOrder(board, 0).size())) : double(e.photos) / Photos(); }
	double DrawsExisting(const Effort& e) const override { return e.edges ? 0 : Choices(Photos(), e.photos); }

	tiltcal::Task Draw(const Effort& effort, int k, int draws, Preparation& preparation) override
	{
		tiltcal::Task task;
		task.board = board;
		task.pitch_mm = 0.02;
		const double phase = effort.edges ? double(k) / draws : 0;
		const std::vector<int> poses = Choice(Photos(), effort.photos, effort.edges ? 0 : k, effort.edges ? 1 : draws);
		for (size_t s = 0; s < STATES.size(); ++s)
		{
			task.states.push_back({ STATES[s], s > 0, {} });
			for (const int pose : poses)
			{
				Shot& shot = shots[s][size_t(pose)];
				const Measured& m = Measure(shot, effort.edges, phase);
				preparation.detection += shot.seconds;
				preparation.measuring += m.seconds;
				task.states[s].photos.push_back(m.photo);
			}
		}
		task.width = task.states[0].photos[0].width;
		task.height = task.states[0].photos[0].height;
		return task;
	}

private:
	struct Measured
	{
		tiltcal::Photo photo;
		double seconds;
	};

	struct Shot
	{
		cv::Mat grey;
		tiltcal::Photo photo;    // corners only
		double seconds;          // reading and detecting
		std::map<std::pair<int, double>, Measured> measured;
	};

	Shot Detect(const std::string& file) const
	{
		const double start = CpuSeconds();
		Shot shot;
		shot.grey = tiltcal::Luminance(tiltcal::ReadLinear(file, tiltcal::ParseTransfer("srgb")));
		shot.photo.file = file;
		shot.photo.width = shot.grey.cols;
		shot.photo.height = shot.grey.rows;
		shot.photo.corners = tiltcal::DetectCorners(shot.grey, board, {}, file);
		shot.seconds = CpuSeconds() - start;
		return shot;
	}

	const Measured& Measure(Shot& shot, int edges, double phase) const
	{
		const auto key = std::pair(edges, phase);
		const auto known = shot.measured.find(key);
		if (known != shot.measured.end())
			return known->second;
		const double start = CpuSeconds();
		tiltcal::Photo photo = shot.photo;
		tiltcal::MeasureEdges(shot.grey, board, photo, { edges, phase });
		return shot.measured.emplace(key, Measured{ photo, CpuSeconds() - start }).first->second;
	}

	tiltcal::Board board;
	std::vector<std::vector<Shot>> shots;   // state, photograph
};

/// Keeps the edges that tiltcal would measure.
void KeepEdges(const tiltcal::Board& board, int edges, tiltcal::Photo& photo)
{
	const std::vector<tiltcal::EdgePlace> order = tiltcal::SpreadOrder(board, 0);
	std::map<std::tuple<int, int, bool>, size_t> rank;
	for (size_t k = 0; k < order.size(); ++k)
		rank[{ order[k].column, order[k].row, order[k].along_columns }] = k;
	photo.edges.erase(std::remove_if(photo.edges.begin(), photo.edges.end(), [&](const tiltcal::Edge& e)
		{ return rank.at({ e.column, e.row, e.along_columns }) >= size_t(edges); }), photo.edges.end());
}

class ThinLensSource : public Source
{
public:
	int Photos() const override { return 6; }
	int Draws(const Effort&, int wanted) const override { return std::min(wanted, 4); }
	double ShareUsed(const Effort&) const override { return 0; }
	double DrawsExisting(const Effort&) const override { return 0; }

	tiltcal::Task Draw(const Effort& effort, int k, int draws, Preparation&) override
	{
		const std::vector<int> poses = Choice(Photos(), effort.photos, k, draws);
		std::vector<tiltcal::State> states;
		for (size_t s = 0; s < STATES.size(); ++s)
		{
			synthetic::Lens lens;
			lens.floor = 1;
			lens.tilt = s == 0 ? 0 : s == 1 ? 5 : -5;
			const unsigned seed = unsigned(1 + 3 * k) + unsigned(s);
			tiltcal::State all = synthetic::Photograph(STATES[s], lens, { 0.03, 0.06, seed });
			tiltcal::State some = all;
			some.photos.clear();
			for (const int pose : poses)
				some.photos.push_back(all.photos[size_t(pose)]);
			states.push_back(some);
		}
		tiltcal::Task task = synthetic::MakeTask(states);
		if (effort.edges)
			for (tiltcal::State& state : task.states)
				for (tiltcal::Photo& photo : state.photos)
					KeepEdges(task.board, effort.edges, photo);
		return task;
	}
};

}

std::unique_ptr<Source> Photographs(const std::string& folder) { return std::make_unique<PhotographSource>(folder); }

std::unique_ptr<Source> ThinLens() { return std::make_unique<ThinLensSource>(); }

double Choices(int n, int chosen)
{
	double c = 1;
	for (int k = 1; k <= chosen; ++k)
		c = c * (n - chosen + k) / k;
	return c;
}

std::vector<int> Choice(int n, int chosen, int k, int draws)
{
	std::vector<std::vector<int>> all;
	for (unsigned bits = 0; bits < 1u << n; ++bits)
	{
		std::vector<int> one;
		for (int i = 0; i < n; ++i)
			if (bits >> i & 1)
				one.push_back(i);
		if (static_cast<int>(one.size()) == chosen)
			all.push_back(one);
	}
	return all[size_t(k) * all.size() / size_t(draws) % all.size()];
}

double CpuSeconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

}
