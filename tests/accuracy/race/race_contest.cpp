// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace
{

using Say = std::function<void(const std::string&)>;

// Sets of independent samples are added until the mean is good enough.
void FindTruth(Contest& contest, const Renderer& renderer, const RaceSettings& settings, const Say& say)
{
	std::vector<Picture> sets;
	for (int i = 1; i <= settings.reference_seeds; ++i)
	{
		Setting setting;
		setting.opponent = Opponent::FIXED;
		setting.max = settings.reference_samples;
		setting.tilted = contest.tilted;
		setting.seed = i;
		sets.push_back(renderer.Reference(setting));
		if (i < 2)
			continue;
		contest.truth = Mean(sets, contest.truth_error);
		contest.truth_samples = i * settings.reference_samples;
		say(fmt::format("truth of {} samples, own error {:.6f}", contest.truth_samples, contest.truth_error));
		if (contest.truth_error <= settings.reference_error)
			break;
	}
}

Picture StocksLimit(Contest& contest, const Renderer& renderer, const RaceSettings& settings)
{
	std::vector<Picture> runs;
	for (int i = 1; i <= 2; ++i)
	{
		Setting setting;
		setting.opponent = Opponent::STOCK;
		setting.max = settings.limit_samples;
		setting.seed = i;
		runs.push_back(renderer.Reference(setting));
	}
	const Picture limit = Mean(runs, contest.limit_error);
	contest.limit_distance = RmsDifference(limit, contest.truth);
	contest.stock_offset = FindOffset(limit, contest.truth);
	return limit;
}

void Judge(RacePoint& point, const Picture& picture, const Contest& contest, const Picture* limit)
{
	const Picture& truth = contest.truth;
	point.rms_truth = point.rms_shifted = point.rms_limit = RmsDifference(picture, truth);
	point.rel_mse = RelativeMse(picture, truth);
	if (!limit)
		return;
	// The offset that suits this picture best, not the one that stock has on average.
	const Offset offset = FindOffset(picture, truth);
	const Picture moved = Moved(truth, offset.dx, offset.dy);
	point.rms_shifted = RmsDifference(picture, moved);
	point.rms_limit = WithoutOwnError(RmsDifference(picture, *limit), contest.limit_error);
	point.rel_mse = std::min({point.rel_mse, RelativeMse(picture, moved), RelativeMse(picture, *limit)});
}

// Stock, ours and fixed by turns, so that whatever else the machine does falls on all of them alike.
std::vector<Setting> Interleaved(const RaceSettings& settings, bool stock, bool area_lights)
{
	std::vector<const std::vector<Setting>*> lists = {&settings.ours, &settings.raw, &settings.fixed};
	if (stock)
		lists.push_back(&settings.stock);
	if (area_lights)
		lists.push_back(&settings.grid);
	std::vector<std::pair<double, Setting>> order;
	for (const auto* list : lists)
		for (std::size_t i = 0; i < list->size(); ++i)
			order.emplace_back((double(i) + 0.5) / double(list->size()), (*list)[i]);
	std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
	std::vector<Setting> interleaved;
	for (const auto& entry : order)
		interleaved.push_back(entry.second);
	return interleaved;
}

class Measurement
{
public:
	Measurement(Contest& to_fill, const Renderer& with, const RaceSettings& all, Reuse of_earlier, const Picture* stocks_limit)
		: contest(to_fill), renderer(with), settings(all), reuse(of_earlier), limit(stocks_limit) {}

	void First(const Setting& setting)
	{
		if (LeftOut(setting))
			return;
		const Rendered rendered = Render(setting, 0);
		RacePoint point;
		point.setting = setting;
		Add(point, rendered);
		point.rss = rendered.cost.rss;
		Judge(point, rendered.picture, contest, setting.opponent == Opponent::STOCK ? limit : nullptr);
		if (IsFixed(setting))
		{
			per_sample[setting.opponent] = std::max(per_sample[setting.opponent], point.Time() / setting.max);
			if (point.Rms() < settings.enough)
				enough[{setting.opponent, setting.bokeh}] = setting.max;
		}
		contest.points[setting.opponent].push_back(point);
		if (setting.opponent != Opponent::STOCK)
			pictures[Label(setting)] = rendered.picture;
	}

	// Of the denoised pictures that ran without denoise too.
	void CountWorseBlocks()
	{
		for (RacePoint& point : contest.points[Opponent::OURS])
		{
			Setting without = point.setting;
			without.denoise = false;
			const auto raw = pictures.find(Label(without)), denoised = pictures.find(Label(point.setting));
			if (raw != pictures.end() && denoised != pictures.end() && point.setting.denoise)
				point.worse_blocks = ShareOfWorseBlocks(denoised->second, raw->second, contest.truth);
		}
	}

	void Again(const Setting& setting, int repeat)
	{
		for (RacePoint& point : contest.points[setting.opponent])
			if (Label(point.setting) == Label(setting) && (repeat < settings.repeats || point.times.front() < settings.short_run))
				Add(point, Render(setting, repeat));
	}

private:
	static bool IsFixed(const Setting& setting) { return setting.variance == 0; }

	Rendered Render(Setting setting, int repeat) const
	{
		setting.tilted = contest.tilted;
		return renderer.RenderOrReuse(setting, reuse == Reuse::ALL || (reuse == Reuse::STOCK && setting.opponent == Opponent::STOCK), repeat);
	}

	void Add(RacePoint& point, const Rendered& rendered) const { point.Add(rendered.cost.cpu, contest.start_up.at(point.setting.opponent)); }

	bool LeftOut(const Setting& setting) const
	{
		if (!IsFixed(setting))
			return false;
		const auto cost = per_sample.find(setting.opponent);
		const auto done = enough.find({setting.opponent, setting.bokeh});
		return (cost != per_sample.end() && cost->second * setting.max > settings.longest_run) ||
			(done != enough.end() && setting.max > done->second);
	}

	Contest& contest;
	const Renderer& renderer;
	const RaceSettings& settings;
	Reuse reuse;
	const Picture* limit;
	std::map<Opponent, double> per_sample;
	std::map<std::string, Picture> pictures; // ours, by label
	std::map<std::pair<Opponent, bool>, int> enough;
};

void AddPinholes(Contest& contest, const Renderer& renderer, const RaceSettings& settings)
{
	std::vector<RacePoint> points;
	for (int repeat = 0; repeat < settings.repeats; ++repeat)
	{
		std::size_t i = 0;
		std::vector<int> frames;
		double start_up = 0;
		const Cost cost = renderer.Pinholes(settings.pinhole_frames, contest.tilted, PinholesFor::RACE, start_up, [&](int m, const Picture& mean) {
			if (m < 4)
				return;
			if (repeat == 0)
			{
				RacePoint point;
				point.setting.opponent = Opponent::PINHOLES;
				point.setting.max = m;
				point.setting.tilted = contest.tilted;
				Judge(point, mean, contest, nullptr);
				points.push_back(point);
			}
			frames.push_back(m);
		});
		for (RacePoint& point : points)
		{
			// Frames cost the same each: the time of the first m is their share.
			point.Add(cost.cpu, start_up, double(frames[i++]) / settings.pinhole_frames);
			point.rss = cost.rss;
		}
		contest.pinholes_paid = cost.cpu / NetTime(cost.cpu, start_up);
		contest.start_up[Opponent::PINHOLES] = start_up / settings.pinhole_frames;
	}
	contest.points[Opponent::PINHOLES] = points;
}

// The independent check of the truth: pinholes of stock, and how well their two halves agree.
void CheckTruth(Contest& contest, const Renderer& renderer, const RaceSettings& settings)
{
	Picture half;
	double start_up = 0;
	renderer.Pinholes(settings.check_frames, contest.tilted, PinholesFor::CHECK, start_up, [&](int m, const Picture& mean) {
		if (2 * m == settings.check_frames)
			half = mean;
		if (m != settings.check_frames)
			return;
		contest.pinhole_distance = RmsDifference(mean, contest.truth);
		// mean = (half + other) / 2, so half the distance of the halves is that of the mean from the first.
		contest.pinhole_error = RmsDifference(mean, half);
		contest.pinhole_frames = m;
	});
}

double RmsOf(const RacePoint& point)
{
	return point.Rms();
}

double RootOfRelMse(const RacePoint& point)
{
	return std::sqrt(point.rel_mse);
}

std::vector<CurvePoint> HullOf(const Contest& contest, std::initializer_list<Opponent> opponents, double (*error)(const RacePoint&))
{
	std::vector<CurvePoint> points;
	for (Opponent opponent : opponents)
	{
		const auto found = contest.points.find(opponent);
		if (found != contest.points.end())
			for (const RacePoint& point : found->second)
				points.push_back({point.Time(), error(point), point.at_floor});
	}
	return Hull(points);
}

std::vector<CurvePoint> BestOf(const Contest& contest, Opponent opponent, double (*error)(const RacePoint&))
{
	return opponent == Opponent::OURS ? HullOf(contest, {Opponent::OURS, Opponent::RAW, Opponent::FIXED}, error) : HullOf(contest, {opponent}, error);
}

std::vector<CurvePoint> OursAgainst(const Contest& contest, Opponent opponent, Side side, double (*error_of)(const RacePoint&))
{
	// Rivals of our own make are not on our side.
	if (opponent == Opponent::RAW)
		return HullOf(contest, {Opponent::OURS}, error_of);
	if (opponent == Opponent::FIXED)
		return side == Side::RAW ? HullOf(contest, {Opponent::RAW}, error_of) : HullOf(contest, {Opponent::OURS, Opponent::RAW}, error_of);
	return side == Side::RAW ? HullOf(contest, {Opponent::RAW, Opponent::FIXED}, error_of) : BestOf(contest, Opponent::OURS, error_of);
}

Ratio RatioOf(const Contest& contest, Opponent opponent, double error, Side side, double (*error_of)(const RacePoint&))
{
	const auto ours = OursAgainst(contest, opponent, side, error_of);
	const auto rival = opponent == Opponent::RAW ? HullOf(contest, {Opponent::RAW, Opponent::FIXED}, error_of) : BestOf(contest, opponent, error_of);
	const TimeAt theirs = TimeToReach(rival, error, true), own = TimeToReach(ours, error, false);
	return {error, theirs.time / own.time, !theirs.reached, !own.reached, theirs.at_floor, own.at_floor};
}

}

std::vector<CurvePoint> Contest::RmsHull(Opponent opponent) const
{
	return BestOf(*this, opponent, RmsOf);
}

std::vector<CurvePoint> Contest::RelMseHull(Opponent opponent) const
{
	return BestOf(*this, opponent, RootOfRelMse);
}

Ratio RatioAt(const Contest& contest, Opponent opponent, double error, Side side)
{
	return RatioOf(contest, opponent, error, side, RmsOf);
}

Ratio RelMseRatioAt(const Contest& contest, Opponent opponent, double rel_mse, Side side)
{
	Ratio ratio = RatioOf(contest, opponent, std::sqrt(rel_mse), side, RootOfRelMse);
	ratio.error = rel_mse;
	return ratio;
}

Contest RunContest(const Renderer& renderer, const RaceScene& scene, bool tilted, const RaceSettings& settings,
	Reuse reuse, const Say& say)
{
	Contest contest;
	contest.scene = scene;
	contest.tilted = tilted;
	say("truth");
	FindTruth(contest, renderer, settings, say);
	if (settings.check_frames > 0)
	{
		CheckTruth(contest, renderer, settings);
		say(fmt::format("truth is {:.5f} from {} averaged pinholes, whose own error is below {:.5f}", contest.pinhole_distance,
			contest.pinhole_frames, contest.pinhole_error));
	}
	Picture limit;
	if (!tilted)
	{
		limit = StocksLimit(contest, renderer, settings);
		say(fmt::format("stock's limit is {:.5f} from the truth, own error {:.5f}, offset {:.3f}, {:.3f} px", contest.limit_distance,
			contest.limit_error, contest.stock_offset.dx, contest.stock_offset.dy));
		contest.start_up[Opponent::STOCK] = renderer.StartUp(Opponent::STOCK, false);
	}
	contest.start_up[Opponent::OURS] = contest.start_up[Opponent::RAW] = contest.start_up[Opponent::FIXED] = contest.start_up[Opponent::GRID] = renderer.StartUp(Opponent::OURS, tilted);

	std::vector<Setting> order = Interleaved(settings, !tilted, scene.area_lights);
	Measurement measurement(contest, renderer, settings, reuse, tilted ? nullptr : &limit);
	for (int repeat = 0; repeat < settings.short_repeats; ++repeat)
	{
		for (std::size_t i = 0; i < order.size(); ++i)
		{
			if (i % 8 == 0)
				say(fmt::format("pass {} of {}{}, run {} of {}", repeat + 1, settings.short_repeats, repeat < settings.repeats ? "" : ", of short runs", i + 1, order.size()));
			repeat == 0 ? measurement.First(order[i]) : measurement.Again(order[i], repeat);
		}
		if (repeat == 0)
			measurement.CountWorseBlocks();
		std::reverse(order.begin(), order.end());
	}
	if (tilted)
		AddPinholes(contest, renderer, settings);
	return contest;
}
