// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/check_light.h"

#include "calibrate/left_over.h"
#include "edge/tone_exponent.h"
#include "model/footprint.h"
#include "model/predict.h"
#include "solve/each_edge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

/// Share of clipped edges that is worth a word, and that spoils the blur: a bright side that is known too low by x narrows the blur by some x/2.
const double SOME_CLIPPED = 0.02, MANY_CLIPPED = 0.2;
/// px^2, of diameters: what an unsharp mask of 1 px and an amount of 0.05 takes off.
const double SHARPENED = 0.1;
/// Shift over radius. An exponent wrong by 1 % gives 0.004: m = e^1.01 = e + 0.01 e log e, at e = 1/2 0.0035, over the slope 2/(pi R).
const double BENT = 0.004;
/// An exponent within 1 % of another is not told from it: one standard deviation of what is anywhere between.
const double UNTOLD = 0.01 / 1.7320508;
const double CERTAIN = 3;   // sigmas
/// Of two states, whose sigma has some six degrees of freedom: once in 400 by chance, of Student's t.
const double CERTAIN_OF_STATES = 5;
const size_t LEAST_FREEDOM = 4;
/// Sharpening is seen where the blur is narrower than so many px; told from wider ones, as where the focus is at infinity, it would be an
/// error of the edge's shape: 0.04 px of 13 are 1 px².
const double SHARP = 4;
const int ENOUGH_SHARP = 20;
/// What sharpening takes off the squares of blurs falls from narrow ones to nothing at wide ones; what the fit sees of it lies between: narrow ones miss by up to so many times that.
const double MOST_OF_SHARPENING = 2;
/// Relative change of a blur's square, over the bend that is seen: a tone curve makes blurs, and the aperture, wrong by 1.7 times its bend
/// (closed_loop --random 1 --first 3 --light tone-curve: 7 % and 0.043), squares by twice that.
const double WIDTH_OF_BEND = 3.5;
/// Of the contrast: what an unsharp mask of 1 px and an amount of 0.1 makes beside a sharp edge. Blur alone makes nothing: where no light is negative, an edge only rises.
const double OVERSHOT = 0.005;
/// px^2 of SHARPENED's kind: an unsharp mask of 1 px and 0.8 makes 0.055 of the one and up to 2.8 of the other (closed_loop --random 3 --light sharpened).
const double SQUARES_OF_OVERSHOOT = 50;
/// Where light overshoots beside an edge, px from the end of its blur: beyond the pixel's own width, and as wide as what sharpens reaches.
const double BESIDE = 0.75, BESIDE_WIDE = 1.5;
const double LEAST_REACH = 2;   // of ShiftOfExponent; edges whose neighbours lie nearer are fitted with those
/// The power that its curve is like between middle grey and white: 2.4 c/(c + 0.055) at a code c of 0.8.
const double SRGB_GAMMA = 2.25;

/// Of every edge, from where the lens puts it to where it was measured, to the bright side, px. By the real lens where that is the answer: what it makes of coma would be
/// taken for a tone curve's work where the edges that were measured have their bright sides on one side more often than on the other.
std::vector<double> ShiftsOf(const Calibration& c)
{
	std::vector<double> shifts;
	size_t edges = 0;
	ForEachEdge(c.task, [&](size_t, size_t, const Edge&) { ++edges; });
	if (c.RealLensIsUsed() && c.LensOfScenes().place_errors_px.size() == edges)
	{
		for (const double error : c.LensOfScenes().place_errors_px)
			shifts.push_back(-error);
		return shifts;
	}
	ForEachEdge(c.task, [&](size_t s, size_t p, const Edge& e)
	{
		const Point at = Reproject(c.task, c.geometry, s, p, e.board_column, e.board_row), normal = EdgeNormal(e);
		shifts.push_back((e.x - at[0]) * normal[0] + (e.y - at[1]) * normal[1]);
	});
	return shifts;
}

/// Slope of places by radii of one photograph, least squares through 0. at: the shift of its first edge; left at the next photograph's.
double SlopeOf(const Calibration& c, size_t s, size_t p, std::vector<double>::const_iterator& at, double& weight)
{
	double ab = 0, aa = 0;
	for (const Edge& e : c.task.states[s].photos[p].edges)
	{
		const double shift = *at++, radius = 0.5 * PredictedBlur(c, s, p, e);
		ab += shift * radius;
		aa += radius * radius;
	}
	weight = aa;
	return aa > 0 ? ab / aa : 0;
}

/// The power of light that makes this bend at edges like these: what they show of wide blurs counts, as it does in the bend.
std::optional<Estimate> ExponentOf(const Calibration& c, const Estimate& bend)
{
	double dark = 0, bright = 0, reach = 0, squares = 0;
	ForEachEdge(c.task, [&](size_t s, size_t p, const Edge& e)
	{
		const double radius = 0.5 * PredictedBlur(c, s, p, e);
		dark += radius * radius * std::max(e.low, 0.0);
		bright += radius * radius * e.high;
		reach += radius * e.reach;
		squares += radius * radius;
	});
	if (!(bright > 0))
		return std::nullopt;
	const auto exponent = [&](double shift) { return ExponentOfShift(shift, dark / bright, std::max(reach / squares, LEAST_REACH)); };
	const double e = exponent(bend.value), by_bend = 0.5 * (exponent(bend.value + bend.sigma) - exponent(bend.value - bend.sigma)), sigma = std::hypot(by_bend, UNTOLD * e);
	return std::isfinite(e + sigma) ? std::optional(Estimate{ e, sigma }) : std::nullopt;
}

/// Of each state's photographs, which scatter alike in all: by that, photographs about the mean of their state, each as certain as its weight.
std::vector<Estimate> BendOfStates(const std::vector<size_t>& state, const std::vector<double>& slopes, const std::vector<double>& weights)
{
	const size_t states = state.empty() ? 0 : state.back() + 1;
	std::vector<double> sum(states, 0), all(states, 0);
	for (size_t k = 0; k < slopes.size(); ++k)
	{
		sum[state[k]] += weights[k] * slopes[k];
		all[state[k]] += weights[k];
	}
	if (slopes.size() < states + LEAST_FREEDOM || std::any_of(all.begin(), all.end(), [](double w) { return !(w > 0); }))
		return {};
	double squares = 0;
	for (size_t k = 0; k < slopes.size(); ++k)
		squares += weights[k] * std::pow(slopes[k] - sum[state[k]] / all[state[k]], 2);
	std::vector<Estimate> bends;
	for (size_t s = 0; s < states; ++s)
		bends.push_back({ sum[s] / all[s], std::sqrt(squares / double(slopes.size() - states) / all[s]) });
	return bends;
}

/// Mean of the profile's pixels whose distances lie between `from` and `to`; NaN: none.
double MeanBetween(const std::vector<ProfileBin>& profile, double from, double to)
{
	double sum = 0, count = 0;
	for (const ProfileBin& bin : profile)
		if (bin.x >= from && bin.x <= to)
		{
			sum += bin.value * bin.count;
			count += bin.count;
		}
	return sum / count;
}

/// How far the light beside an edge goes beyond what it is farther off, over the edge's contrast, on both sides. NaN: not told.
double OvershootOf(const Edge& e)
{
	const double R = 0.5 * std::max(e.blur, 0.0), near = R + BESIDE, far = near + BESIDE_WIDE, beyond = far + 1;
	const auto step = [&](double from, double to) { return MeanBetween(e.profile, from, to) - MeanBetween(e.profile, -to, -from); };
	return (step(near, far) - step(beyond, e.reach)) / (e.high - e.low);
}

/// Mean of what photographs say, by their weights. They differ by more than their edges' noise: they are the independent draws, by which sigma goes. NaN of fewer than two, or without weight.
Estimate MeanOfPhotographs(const std::vector<double>& values, const std::vector<double>& weights)
{
	const double unknown = std::numeric_limits<double>::quiet_NaN(), n = double(values.size());
	double sum = 0, all = 0, squares = 0;
	for (size_t k = 0; k < values.size(); ++k)
	{
		sum += weights[k] * values[k];
		all += weights[k];
	}
	if (!(all > 0) || n < 2)
		return { unknown, unknown };
	for (size_t k = 0; k < values.size(); ++k)
		squares += std::pow(weights[k] / all * (values[k] - sum / all), 2);
	return { sum / all, std::sqrt(squares * n / (n - 1)) };
}

/// Mean over the sharp edges. NaN where fewer than ENOUGH_SHARP, or one photograph, tell.
Estimate Overshoot(const Task& task)
{
	double all = 0;
	std::vector<double> means, edges;   // of photographs
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
		{
			double sum = 0, count = 0;
			for (const Edge& e : photo.edges)
				if (const double o = e.blur < SHARP ? OvershootOf(e) : NAN; std::isfinite(o))
				{
					sum += o;
					++count;
				}
			all += count;
			if (count > 0)
			{
				means.push_back(sum / count);
				edges.push_back(count);
			}
		}
	return all < ENOUGH_SHARP ? Estimate{ NAN, NAN } : MeanOfPhotographs(means, edges);
}

int SharpEdges(const Task& task)
{
	int sharp = 0;
	ForEachEdge(task, [&](size_t, size_t, const Edge& e) { sharp += e.blur < SHARP; });
	return sharp;
}

}

LightCheck CheckLight(const Calibration& c)
{
	LightCheck light;
	const double unknown = std::numeric_limits<double>::quiet_NaN();
	light.sharpening = SharpEdges(c.task) < ENOUGH_SHARP ? Estimate{ unknown, unknown } : Estimate{ -c.solution.psf_floor_squared.value, c.solution.psf_floor_squared.sigma };
	light.overshoot = Overshoot(c.task);
	const std::vector<double> shifts = ShiftsOf(c);
	auto shift = shifts.begin();
	std::vector<double> slopes, weights;
	std::vector<size_t> state;
	double edges = 0, clipped = 0;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
		{
			const Photo& photo = c.task.states[s].photos[p];
			clipped += photo.saturated_share * double(photo.edges.size());
			edges += double(photo.edges.size());
			double weight = 0;
			slopes.push_back(SlopeOf(c, s, p, shift, weight));
			weights.push_back(weight);
			state.push_back(s);
		}
	light.clipped_share = edges > 0 ? clipped / edges : 0;
	const Estimate bend = MeanOfPhotographs(slopes, weights);
	light.bend = bend;
	if (!std::isfinite(bend.value))
		return light;
	// Glass that a thin lens was forced on bends edges too, and no `transfer` mends that.
	if (c.real_lens || !MoreThanNoiseIsLeftOver(c))
		light.exponent = ExponentOf(c, light.bend);
	light.bend_of_states = BendOfStates(state, slopes, weights);
	return light;
}

namespace
{

bool SteepnessIsSeen(const LightCheck& light) { return light.sharpening.value > SHARPENED && light.sharpening.value > CERTAIN * light.sharpening.sigma; }

bool OvershootIsSeen(const LightCheck& light) { return light.overshoot.value > OVERSHOT && light.overshoot.value > CERTAIN * light.overshoot.sigma; }

/// What sharpening takes off the squares of blurs, px^2: a demosaicing, or the lens, may hide it in them, not in what overshoots.
double SizeOfSharpening(const LightCheck& light)
{
	return std::max(SteepnessIsSeen(light) ? light.sharpening.value : 0, OvershootIsSeen(light) ? SQUARES_OF_OVERSHOOT * light.overshoot.value : 0);
}

Remark SharpeningRemark(const LightCheck& light)
{
	std::string what;
	if (SteepnessIsSeen(light))
		what = fmt::format("sharp edges are steeper than their pixels can make them (by {:.2f} +- {:.2f} px² of blur)", light.sharpening.value, light.sharpening.sigma);
	if (OvershootIsSeen(light))
		what += fmt::format("{}the light overshoots beside sharp edges, which no blur does (by {:.1f} +- {:.1f} % of their contrast)", what.empty() ? "" : ", and ", 100 * light.overshoot.value, 100 * light.overshoot.sigma);
	return { SizeOfSharpening(light) > 10 * SHARPENED ? Grade::POOR : Grade::FAIR, what + ": the photographs were sharpened, or given contrast, which makes blur, aperture and tilt wrong. "
		"Develop the raw files without sharpening, or set the camera's sharpness and contrast to their least" };
}

}

bool SharpeningIsSeen(const LightCheck& light) { return SteepnessIsSeen(light) || OvershootIsSeen(light); }

bool BendIsSeen(const LightCheck& light) { return std::abs(light.bend.value) > BENT && std::abs(light.bend.value) > CERTAIN * light.bend.sigma; }

std::vector<Remark> JudgeLightOfStates(const Calibration& c)
{
	const std::vector<Estimate>& bends = c.light.bend_of_states;
	if (bends.empty() || c.light.clipped_share > SOME_CLIPPED)
		return {};
	const auto [low, high] = std::minmax_element(bends.begin(), bends.end(), [](const Estimate& a, const Estimate& b) { return a.value < b.value; });
	const double apart = high->value - low->value, sigma = std::hypot(high->sigma, low->sigma);
	if (!(apart > 2 * BENT && apart > CERTAIN_OF_STATES * sigma))
		return {};
	const auto name = [&](auto bend) { return c.task.states[size_t(bend - bends.begin())].name; };
	return { { apart > 10 * BENT ? Grade::POOR : Grade::FAIR, fmt::format("blurred edges lie {:.3f} +- {:.3f} of their blur's radius to the bright side in {} and {:.3f} +- {:.3f} in {} (less than 0: to the dark side): the photographs of the states "
		"were not developed alike. A tone curve that the camera or the raw converter chooses for each does this, and biases blur and aperture of each in another way. Develop all with one linear curve",
		high->value, high->sigma, name(high), low->value, low->sigma, name(low)) } };
}

bool LightMayExplain(const Calibration& c, const PhotographCheck& photograph)
{
	const double sharpened = SizeOfSharpening(c.light), bent = BendIsSeen(c.light) ? std::abs(c.light.bend.value) : 0;
	double misfit = 0, light = 0;
	for (const Edge& e : c.task.states[photograph.state].photos[photograph.photo].edges)
	{
		const double predicted = PredictedBlur(c, photograph.state, photograph.photo, e);
		misfit += std::pow(predicted * std::abs(predicted) - e.blur * std::abs(e.blur), 2);
		light += std::pow(MOST_OF_SHARPENING * sharpened + WIDTH_OF_BEND * bent * e.blur * e.blur, 2);
	}
	return misfit < light;
}

std::vector<Remark> JudgeLight(const LightCheck& light)
{
	// Clipping bends and steepens edges too.
	if (light.clipped_share > SOME_CLIPPED)
		return { { light.clipped_share > MANY_CLIPPED ? Grade::POOR : Grade::FAIR, fmt::format("{:.0f} % of the edges have a clipped bright side, which makes their blur, and "
			"the aperture, too small: expose less, so that the board's white stays below the file's greatest value in every colour", 100 * light.clipped_share) } };
	std::vector<Remark> remarks;
	if (SharpeningIsSeen(light))
		remarks.push_back(SharpeningRemark(light));
	if (BendIsSeen(light))
	{
		const std::string power = !light.exponent ? "" : fmt::format(". As if they were light to the power {:.3f} +- {:.3f}: a `transfer` of {:.2f} in place of srgb, or of what was told over {:.3f}, "
			"puts that right where the curve is a power", light.exponent->value, light.exponent->sigma, SRGB_GAMMA / light.exponent->value, light.exponent->value);
		remarks.push_back({ std::abs(light.bend.value) > 5 * BENT ? Grade::POOR : Grade::FAIR, fmt::format("blurred edges lie {:.3f} +- {:.3f} of their blur's radius to the {} side of where the sharp ones "
			"say: the values are not the light that `transfer` makes of them. A tone curve in the camera does this (and coma and rims that the lens was not given, a little), and biases blur and aperture. Develop the raw files with a linear curve, or say the right `transfer`{}",
			std::abs(light.bend.value), light.bend.sigma, light.bend.value > 0 ? "bright" : "dark", power) });
	}
	return remarks;
}

}
