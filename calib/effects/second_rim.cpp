// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/second_rim.h"

#include "base/robust.h"
#include "solve/solve_lens.h"

#include <fmt/format.h>

#include <cmath>

namespace tiltcal
{

namespace
{

struct Candidate
{
	RimFit fit;        ///< with the sigmas that it leaves over
	Rims rims, one;    ///< the best two and the best one by these sigmas
	double sigmas = -1;
};

Candidate Try(const RimFit& start, const Rims& one, int distance_sign, double focal_length)
{
	Candidate c{ start, one, one };
	if (!c.fit.Search(c.rims, distance_sign, focal_length) || !c.fit.Minimise(c.one))
		return c;
	const double with = c.fit.ChiSquared(c.rims), without = c.fit.ChiSquared(c.one);
	const double freedom = std::max<double>(1, double(c.fit.Residuals()) - 4);
	c.sigmas = SigmasOfTwo(std::max(0.0, (without - with) / (with / freedom)));
	return c;
}

/// Groups in turn: what the others say of it.
void LeaveGroupsOut(const Candidate& c, TwoRims& result)
{
	double with = 0, without = 0;
	size_t total = 0;
	for (size_t group = 0; group < c.fit.Groups(); ++group)
	{
		Rims two = c.rims, one = c.one;
		if (!c.fit.Minimise(two, group, true) || !c.fit.Minimise(one, group, true))
			two.clear();
		result.left_out.push_back(two);
		size_t count = 0;
		if (two.empty() || (c.fit.MeanOfGroup(two, group, count), count == 0))
			continue;
		with += double(count) * c.fit.MeanOfGroup(two, group, count);
		without += double(count) * c.fit.MeanOfGroup(one, group, count);
		total += count;
	}
	if (total == 0)
		return;
	result.verdict.held_out_with = std::sqrt(with / double(total));
	result.verdict.held_out_without = std::sqrt(without / double(total));
}

/// Of (log R, log |Z|) of each rim.
Eigen::VectorXd JackknifeSigmas(const TwoRims& two)
{
	std::vector<Eigen::VectorXd> numbers;
	for (const Rims& rims : two.left_out)
	{
		Eigen::VectorXd x(4);
		for (size_t k = 0; k < rims.size(); ++k)
			x.segment(long(2 * k), 2) << std::log(rims[k].radius), std::log(std::abs(rims[k].distance));
		if (!rims.empty())
			numbers.push_back(x);
	}
	Eigen::VectorXd mean = Eigen::VectorXd::Zero(4), squares = mean;
	for (const Eigen::VectorXd& x : numbers)
		mean += x / double(numbers.size());
	for (const Eigen::VectorXd& x : numbers)
		squares += (x - mean).cwiseAbs2();
	return numbers.size() < 2 ? squares : (squares * double(numbers.size() - 1) / double(numbers.size())).cwiseSqrt();
}

/// Empty: it is kept.
std::string Against(const SecondRim& v)
{
	if (v.sigmas < SIGNIFICANT_RIM)
		return fmt::format("{:.1f} sigma: not significant", std::max(0.0, v.sigmas));
	if (!(v.held_out_with > 0))
		return "nothing can be left out to be predicted";
	return v.held_out_with < WORTH_IT * v.held_out_without ? "" : "what was left out is not predicted better with it";
}

}

TwoRims TrySecondRim(const RimFit& start, const tilt_lens::Rim& rim, double focal_length)
{
	TwoRims result;
	RimFit single = start;
	Rims one{ rim };
	if (!single.Search(one, 0, focal_length))
	{
		result.verdict.why = "the fit did not converge";
		return result;
	}
	const Candidate behind = Try(single, one, -1, focal_length), before = Try(single, one, 1, focal_length);
	// By what is left of the light alone: aberrations shift edges too, and wide open they put both rims of a double Gauss before the lens, where one is behind.
	const bool is_before = before.sigmas >= SIGNIFICANT_RIM && (behind.sigmas < SIGNIFICANT_RIM || before.fit.LightSigma() < behind.fit.LightSigma());
	const Candidate& best = is_before ? before : behind;
	Eigen::MatrixXd covariance;
	result.verdict.sigmas = best.sigmas;
	if (best.sigmas < SIGNIFICANT_RIM || !best.fit.Covariance(best.rims, covariance))
	{
		result.verdict.why = best.sigmas < SIGNIFICANT_RIM ? Against(result.verdict) : "one of the two cuts nothing";
		return result;
	}
	result.rims = best.rims;
	LeaveGroupsOut(best, result);
	const Eigen::VectorXd sigma = covariance.diagonal().cwiseSqrt().cwiseMax(JackknifeSigmas(result));
	for (size_t k = 0; k < result.rims.size(); ++k)
	{
		const tilt_lens::Rim& r = result.rims[k];
		result.estimates.push_back({ { r.radius, r.radius * sigma[long(2 * k)] }, { r.distance, std::abs(r.distance) * sigma[long(2 * k + 1)] } });
	}
	const std::string against = Against(result.verdict);
	result.verdict.used = against.empty();
	result.verdict.why = against.empty() ? "significant, and predicts better" : against;
	return result;
}

}
