// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/vignetting.h"

#include "lens/angles.h"
#include <tiltcal/calibrate.h>
#include "effects/falloff_fit.h"
#include "effects/second_rim.h"
#include "base/robust.h"

#include <fmt/format.h>
#include "lens/natural_vignetting.h"

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const double DEGREES = tilt_lens::DegreesPerRadian;

/// Fewer patches leave nothing over beside exposure and gradient.
const size_t FEWEST_PATCHES = 6;

/// A patch counts as no more than this, in log_value: a shadow on one must not decide.
const double MOST_HELD_OUT = 0.2;

/// One exposure: where it comes from, for the answer.
struct Exposure
{
	size_t state, photo;
};

struct Data
{
	FalloffFit fit;
	std::vector<Exposure> exposures;
	size_t lights = 0;
	std::vector<size_t> state, group;   ///< of every sample; groups are what is left out in turn
	size_t groups = 0;
	size_t first_edge_group = 0;        ///< of the board's first photograph, where its edges are looked at too
};

/// How the lens of state `s` sees a patch, through that part of the reference's opening.
FalloffSample Seen(const Calibration& c, size_t s, double opening, const BrightPatch& patch)
{
	FalloffSample sample;
	static_cast<PixelView&>(sample) = ViewOfPixel(c, s, patch.u, patch.v);
	sample.opening = opening;
	sample.log_natural = std::log(tilt_lens::NaturalFalloff(sample.n, Vec3<double>{ 0, 0, 1 }, sample.pixel));
	sample.log_value = std::log(patch.value);
	sample.sigma = patch.sigma / patch.value;
	return sample;
}

void Add(const Calibration& c, size_t s, double opening, const BrightPatch& patch, size_t light, const double (&place)[2], size_t group, Data& data)
{
	// Beyond the lens's image circle there is no light, and no logarithm.
	if (!(patch.value > 0))
		return;
	FalloffSample sample = Seen(c, s, opening, patch);
	sample.gain = data.exposures.size() - 1;
	sample.light = light;
	std::copy(place, place + 2, sample.place);
	data.fit.samples.push_back(sample);
	data.state.push_back(s);
	data.group.push_back(group);
	data.groups = std::max(data.groups, group + 1);
}

Data FromFlatFields(const Calibration& c)
{
	Data data;
	data.fit.gradients = false;
	data.lights = 1;
	const std::vector<FlatField>& fields = c.task.flat_fields;
	for (size_t k = 0; k < fields.size(); ++k)
	{
		data.exposures.push_back({ fields[k].state, k });
		for (const BrightPatch& p : fields[k].patches)
		{
			// A single picture is left out by quarters.
			const size_t quarter = size_t(p.u > 0.5 * c.task.width) + 2 * size_t(p.v > 0.5 * c.task.height);
			Add(c, fields[k].state, 1, p, 0, { 0, 0 }, fields.size() > 1 ? k : quarter, data);
		}
	}
	data.first_edge_group = data.groups;
	return data;
}

Data FromWhite(const Calibration& c)
{
	Data data;
	const Board& board = c.task.board;
	const bool shared = c.MainGeometry().shared_poses;
	size_t number = 0;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p, ++number)
		{
			const std::vector<BrightPatch>& white = c.task.states[s].photos[p].white;
			if (white.size() < FEWEST_PATCHES)
				continue;
			const size_t light = shared ? p : data.exposures.size();
			data.exposures.push_back({ s, p });
			data.lights = std::max(data.lights, light + 1);
			for (const BrightPatch& patch : white)
				Add(c, s, c.solution.RatioOf(c.task.states[s].photos[p]), patch, light, { 2 * patch.board_column / board.columns - 1, 2 * patch.board_row / board.rows - 1 }, number, data);
		}
	return data;
}

FalloffUnknowns Blank(const Data& data)
{
	FalloffUnknowns x;
	x.gain.assign(data.exposures.size(), 0);
	x.gradient.assign(data.lights, { 0, 0 });
	x.rim[0] = std::log(1.2 * data.fit.lens_radius);
	x.rim[1] = std::log(2 * data.fit.lens_radius);
	return x;
}

/// What the fit makes of the darkest patch, 0 to 1 of its light.
double Darkening(const FalloffFit& fit, const FalloffSample& darkest, const double* rim)
{
	return 1 - std::exp(fit.Effects(darkest, rim) - (fit.natural ? darkest.log_natural : 0));
}

const FalloffSample& Darkest(const FalloffFit& fit, const double* rim)
{
	return *std::max_element(fit.samples.begin(), fit.samples.end(), [&](const FalloffSample& a, const FalloffSample& b) { return Darkening(fit, a, rim) < Darkening(fit, b, rim); });
}

/// Log R, log Z and the darkening of one fit.
Eigen::Vector3d Numbers(const FalloffFit& fit, const FalloffSample& darkest, const double* rim) { return { rim[0], rim[1], Darkening(fit, darkest, rim) }; }

/// By the covariance of the fit; the darkening by central differences.
Eigen::Vector3d CovarianceSigmas(const FalloffFit& fit, const FalloffSample& darkest, FalloffUnknowns x)
{
	Eigen::Matrix2d covariance;
	if (!fit.Covariance(x, covariance))
		return Eigen::Vector3d::Constant(HUGE_VAL);
	Eigen::Vector2d slope;
	for (int k = 0; k < 2; ++k)
	{
		const double step = 1e-4;
		double above[2] = { x.rim[0], x.rim[1] }, below[2] = { x.rim[0], x.rim[1] };
		above[k] += step;
		below[k] -= step;
		slope[k] = (Darkening(fit, darkest, above) - Darkening(fit, darkest, below)) / (2 * step);
	}
	return { std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1)), std::sqrt(slope.dot(covariance * slope)) };
}

/// Every group in turn is left out; what the others say of it, with an exposure and lighting of its own.
/// `known`: what they say of several rims, by group; empty: one rim, to be fitted.
struct LeaveOut
{
	double held_out = 0;
	Eigen::Vector3d sigmas = Eigen::Vector3d::Zero();
};

LeaveOut LeaveGroupsOut(const Data& data, const FalloffFit& fit, const FalloffSample& darkest, const FalloffUnknowns& x, const std::vector<Rims>& known = {})
{
	LeaveOut result;
	std::vector<Eigen::Vector3d> numbers;
	double squares = 0;
	size_t count = 0;
	for (size_t group = 0; group < data.groups; ++group)
	{
		FalloffFit others = fit, own = fit;
		others.samples.clear();
		own.samples.clear();
		for (size_t k = 0; k < fit.samples.size(); ++k)
			(data.group[k] == group ? own : others).samples.push_back(fit.samples[k]);
		FalloffUnknowns y = x;
		if (own.samples.empty() || others.samples.empty() || (!known.empty() && known[group].empty()) || (fit.optical && !others.Minimise(y)))
			continue;
		if (!known.empty())
			own.rims = others.rims = known[group];
		numbers.push_back(Numbers(others, darkest, y.rim));
		own.SolveLighting(y);
		for (const FalloffSample& s : own.samples)
			squares += std::pow(std::min(std::abs(own.Residual(s, y)), MOST_HELD_OUT), 2);
		count += own.samples.size();
	}
	if (numbers.size() < 2)
		return result;
	result.held_out = std::sqrt(squares / double(count));
	Eigen::Vector3d mean = Eigen::Vector3d::Zero();
	for (const Eigen::Vector3d& n : numbers)
		mean += n / double(numbers.size());
	for (const Eigen::Vector3d& n : numbers)
		result.sigmas += (n - mean).cwiseAbs2();
	result.sigmas = (result.sigmas * double(numbers.size() - 1) / double(numbers.size())).cwiseSqrt();
	return result;
}

void FillPoints(const Data& data, const FalloffFit& fit, const FalloffUnknowns& x, FalloffAnswer& answer)
{
	answer.points.clear();
	answer.gains.clear();
	double squares = 0;
	for (size_t k = 0; k < fit.samples.size(); ++k)
	{
		const FalloffSample& s = fit.samples[k];
		const double r = fit.Residual(s, x), effects = fit.Effects(s, x.rim);
		squares += r * r;
		answer.points.push_back({ data.state[k], std::atan2(Length(Cross(s.v, s.n)), Dot(s.v, s.n)) * DEGREES, std::exp(effects - r), std::exp(effects) });
	}
	answer.rms = std::sqrt(squares / double(fit.samples.size()));
	for (size_t k = 0; k < data.exposures.size(); ++k)
		answer.gains.push_back({ data.exposures[k].state, data.exposures[k].photo, std::exp(x.gain[k]) });
}

/// How much the rim's two numbers lower the cost, in standard deviations of one.
double SigmasOfRim(const FalloffFit& fit, FalloffUnknowns x)
{
	FalloffFit without = fit;
	without.optical = false;
	const std::optional<double> with_rim = fit.Minimise(x), no_rim = without.Minimise(x);
	if (!with_rim)
		return 0;
	if (!no_rim)
		return HUGE_VAL;
	const double freedom = std::max<double>(1, double(fit.samples.size()) - double(x.gain.size()) - 2);
	return SigmasOfTwo(std::max(0.0, (*no_rim - *with_rim) / (*with_rim / freedom)));
}

/// One of the four fits, and its answer.
struct Fitted
{
	FalloffFit fit;
	FalloffUnknowns x;
	FalloffAnswer answer;
};

Fitted Fit(const Data& data, bool natural, bool optical, double focal_length)
{
	Fitted f{ data.fit, Blank(data), {} };
	FalloffFit& fit = f.fit;
	FalloffUnknowns& x = f.x;
	FalloffAnswer& answer = f.answer;
	fit.natural = natural;
	fit.optical = optical;
	if (!fit.Search(focal_length, x))
		return f;
	answer.fitted = true;
	const FalloffSample& darkest = Darkest(fit, x.rim);
	const LeaveOut left = LeaveGroupsOut(data, fit, darkest, x);
	answer.held_out = left.held_out;
	FillPoints(data, fit, x, answer);
	answer.rim_seen = optical && Darkening(fit, darkest, x.rim) > 1e-6;
	if (!answer.rim_seen)
		return f;
	const Eigen::Vector3d sigma = CovarianceSigmas(fit, darkest, x).cwiseMax(left.sigmas);
	answer.radius_mm = { std::exp(x.rim[0]), std::exp(x.rim[0]) * sigma[0] };
	answer.distance_mm = { std::exp(x.rim[1]), std::exp(x.rim[1]) * sigma[1] };
	answer.rims = { { answer.radius_mm, answer.distance_mm } };
	answer.darkening = { Darkening(fit, darkest, x.rim), sigma[2] };
	answer.rim_sigmas = std::min(answer.darkening.value / answer.darkening.sigma, SigmasOfRim(fit, x));
	return f;
}

/// Puts two rims in the place of the one where the photographs show them.
void AddSecondRim(const Calibration& c, const Data& data, Fitted f, FalloffAnswer& answer)
{
	const RimFit start(f.fit, data.group, EdgeShifts(c), data.first_edge_group);
	const TwoRims two = TrySecondRim(start, { answer.radius_mm.value, answer.distance_mm.value }, c.solution.focal_length.value);
	answer.second = two.verdict;
	if (!two.verdict.used)
		return;
	f.fit.optical = false;
	f.fit.rims = two.rims;
	f.fit.SolveLighting(f.x);
	FillPoints(data, f.fit, f.x, answer);
	const FalloffSample& darkest = Darkest(f.fit, f.x.rim);
	const LeaveOut left = LeaveGroupsOut(data, f.fit, darkest, f.x, two.left_out);
	answer.held_out = left.held_out;
	answer.rims = two.estimates;
	answer.radius_mm = two.estimates[0].radius_mm;
	answer.distance_mm = two.estimates[0].distance_mm;
	answer.darkening = { Darkening(f.fit, darkest, f.x.rim), std::max(left.sigmas[2], answer.darkening.sigma) };
}

/// Why no patch could be used.
std::string WhyNothing(const Calibration& c)
{
	int clipped = 0;
	size_t white = 0;
	for (const State& state : c.task.states)
		for (const Photo& photo : state.photos)
		{
			clipped += photo.white_saturated;
			white += photo.white.size();
		}
	if (size_t(clipped) > white)
		return fmt::format("{} of {} white patches are clipped, which hides the fall-off: expose less, or give `flat_field`", clipped, size_t(clipped) + white);
	if (!c.task.board.IsCheckerboard())
		return "it is told by white squares, which a grid of circles does not have: give `flat_field`";
	return "no photograph has enough white squares that blur leaves flat in their middle: give `flat_field`, or use larger squares";
}

}

Vignetting EstimateVignetting(const Calibration& c)
{
	Vignetting result;
	result.flat_field = !c.task.flat_fields.empty();
	if (c.solution.model == Model::PAPER)
	{
		result.failure = "the paper's model has no effects";
		return result;
	}
	Data data = result.flat_field ? FromFlatFields(c) : FromWhite(c);
	int clipped = 0;
	for (const State& state : c.task.states)
		for (const Photo& photo : state.photos)
			clipped += photo.white_saturated;
	if (data.exposures.empty() || (!result.flat_field && size_t(clipped) > data.fit.samples.size()))
	{
		result.failure = WhyNothing(c);
		return result;
	}
	data.fit.lens_radius = 0.5 * c.solution.aperture_diameter.value;
	data.fit.image_distance = c.solution.w_mm.value > 0 ? c.solution.w_mm.value : c.MainGeometry().w_px * c.task.pitch_mm;
	for (const bool optical : { false, true })
		// With the natural fall-off first: where it predicts better, as it does, the rims beside it are those that count.
		for (const bool natural : { true, false })
		{
			const Fitted fitted = Fit(data, natural, optical, c.solution.focal_length.value);
			FalloffAnswer& answer = result.answers[FalloffKind(natural, optical)] = fitted.answer;
			if (answer.rim_seen && answer.rim_sigmas > 0 && (natural || answer.held_out < result.answers[FalloffKind(true, true)].held_out))
				AddSecondRim(c, data, fitted, answer);
		}
	return result;
}

void WidenRimsByOpening(const Estimate& aperture, Calibration& told)
{
	const double relative = aperture.sigma / aperture.value;
	const auto widen = [&](Estimate& e) { e.sigma = std::hypot(e.sigma, relative * e.value); };
	if (!(relative > 0) || !std::isfinite(relative))
		return;
	for (FalloffAnswer& answer : told.vignetting.answers)
	{
		widen(answer.radius_mm);
		widen(answer.distance_mm);
		for (RimEstimate& rim : answer.rims)
		{
			widen(rim.radius_mm);
			widen(rim.distance_mm);
		}
	}
	for (Effect& effect : told.effects)
		for (auto& [name, value] : effect.values)
			if (effect.id == EffectId::VIGNETTING_OPTICAL && name.find(" mm") != std::string::npos)
				widen(value);
}

}
