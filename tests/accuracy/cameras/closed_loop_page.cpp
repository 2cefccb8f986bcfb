// SPDX-License-Identifier: AGPL-3.0-or-later

#include "closed_loop_page.h"

#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace cameras
{

namespace
{

/// "tilt along tilted1" is of the kind "tilt along".
std::string KindOf(const std::string& name)
{
	const size_t last = name.rfind(' ');
	return last == std::string::npos ? name : name.substr(0, last);
}

bool IsInside(const Deviation& d) { return std::abs(d.InSigmas()) < 2; }

/// Counts set by set.
class Counter
{
public:
	/// Those of one set's numbers that are of `kind`; empty: all.
	void Add(const Answer& a, const std::string& kind = {})
	{
		double inside = 0, all = 0;
		for (const Deviation& d : a.deviations)
			if (kind.empty() || KindOf(d.name) == kind)
			{
				AddNumber(d);
				inside += IsInside(d);
				++all;
			}
		if (kind.empty())
			c.not_told += int(a.not_told.size());
		if (all > 0)
			sets.emplace_back(inside, all);
	}

	Coverage Finished() const
	{
		Coverage out = c;
		out.rms = c.all ? std::sqrt(c.rms / c.all) : 0;
		out.mean = c.all ? c.mean / c.all : 0;
		out.clustering = Clustering();
		return out;
	}

private:
	void AddNumber(const Deviation& d)
	{
		const double z = d.InSigmas();
		c.inside += IsInside(d);
		c.rms += std::min(100.0, z * z);
		c.mean += std::clamp(z, -10.0, 10.0);   // one that is far off is not to hide the others
		c.worst = std::max(c.worst, std::abs(z));
		++c.all;
	}

	/// The variance of a ratio of sums over sets (Cochran, "Sampling techniques", 6.3) over the binomial one.
	double Clustering() const
	{
		const double p = c.Share(), binomial = p * (1 - p) * c.all, m = double(sets.size());
		double sum = 0;
		for (const auto& [inside, all] : sets)
			sum += std::pow(inside - p * all, 2);
		return m > 1 && binomial > 0 ? std::max(1.0, sum * m / (m - 1) / binomial) : 1;
	}

	Coverage c;
	std::vector<std::pair<double, double>> sets;   ///< inside, and all
};

std::string Row(const std::string& name, const Coverage& c)
{
	return fmt::format("| {} | {} of {} | {:.1f} % | {:.1f} to {:.1f} % | {} | {:.2f} | {:+.2f} | {:.1f} |\n", name, c.inside, c.all, 100 * c.Share(), 100 * c.Where().low, 100 * c.Where().high,
		c.not_told, c.rms, c.mean, c.worst);
}

std::vector<std::string> LightsOf(const std::vector<Result>& results)
{
	std::vector<std::string> lights;
	for (const Result& r : results)
		if (std::find(lights.begin(), lights.end(), r.light) == lights.end())
			lights.push_back(r.light);
	return lights;
}

Coverage CoverageOfLight(const std::vector<Result>& results, const std::string& light)
{
	Counter of_it;
	for (const Result& r : results)
		if (r.light == light)
			of_it.Add(r.answer);
	return of_it.Finished();
}

std::string Joined(const std::vector<std::string>& words)
{
	std::string text;
	for (const std::string& word : words)
		text += (text.empty() ? "" : "; ") + word;
	return text;
}

/// A set without an answer says nothing of its numbers: the counts would be the better, the more are refused.
std::string RefusalsInWords(const std::vector<Result>& results, const std::vector<std::string>& expected)
{
	const Refusals refusals = RefusalsOf(results, expected);
	std::string text = fmt::format("\nWithout an answer: {} of {} sets, {} of them unexpected, which fails the run.", refusals.all.size(), results.size(), refusals.unexpected.size());
	for (const Result* r : refusals.unexpected)
		text += " **" + NameOf(*r) + "**.";
	return text + " Numbers that a calibration does not tell (a distortion that is not significant, a principal point that is held) are left out of the counts.\n";
}

std::string RowOf(const Result& r)
{
	const std::string name = fmt::format("| {} | {} | ", r.camera.name, r.light);
	if (!r.answer.refusal.empty())
		return name + (r.answer.photographed ? "refused" : "not photographed") + " | | | | | " + r.answer.refusal + " |\n";
	const tiltcal::Calibration& c = r.answer.calibration;
	Counter counter;
	counter.Add(r.answer);
	const Coverage of_it = counter.Finished();
	const Deviation* worst = nullptr;
	for (const Deviation& d : r.answer.deviations)
		if (!worst || std::abs(d.InSigmas()) > std::abs(worst->InSigmas()))
			worst = &d;
	return name + fmt::format("{}, {} | {:.4f} | {:.3f} | {} of {} | {} | {} {:+.1f} |\n", tiltcal::NameOf(c.verdict.grade), tiltcal::NameOf(c.Answer()), r.answer.tilt_error, c.geometry.rms,
		of_it.inside, of_it.all, Joined(r.answer.not_told), worst ? worst->name : "", worst ? worst->InSigmas() : 0);
}

}

std::vector<std::pair<std::string, Coverage>> CoverageByKind(const std::vector<Result>& results)
{
	std::set<std::string> kinds;
	for (const Result& r : results)
		for (const Deviation& d : r.answer.deviations)
			kinds.insert(KindOf(d.name));
	std::vector<std::pair<std::string, Coverage>> all;
	for (const std::string& kind : kinds)
	{
		Counter of_it;
		for (const Result& r : results)
			of_it.Add(r.answer, kind);
		all.emplace_back(kind, of_it.Finished());
	}
	return all;
}

Interval IntervalOf(double inside, double all)
{
	if (!(all > 0))
		return {};
	const double z = 1.959964, p = inside / all, middle = (p + z * z / (2 * all)) / (1 + z * z / all), half = z / (1 + z * z / all) * std::sqrt(p * (1 - p) / all + z * z / (4 * all * all));
	return { std::max(0.0, middle - half), std::min(1.0, middle + half) };
}

Coverage CoverageOfAll(const std::vector<Result>& results)
{
	Counter all;
	for (const Result& r : results)
		all.Add(r.answer);
	return all.Finished();
}

int LeastInside(int all, double share)
{
	if (!(share > 0))
		return 0;
	if (share >= 1)
		return all;
	double chance = 0;   // of up to `least` inside
	for (int least = 0; least <= all; ++least)
	{
		chance += std::exp(std::lgamma(all + 1) - std::lgamma(least + 1) - std::lgamma(all - least + 1) + least * std::log(share) + (all - least) * std::log1p(-share));
		if (chance > 0.001)
			return least;
	}
	return all;
}

std::string NameOf(const Result& r) { return r.camera.name + ", " + r.light; }

Refusals RefusalsOf(const std::vector<Result>& results, const std::vector<std::string>& expected)
{
	Refusals refusals;
	for (const Result& r : results)
	{
		if (r.answer.refusal.empty())
			continue;
		refusals.all.push_back(&r);
		if (std::none_of(expected.begin(), expected.end(), [&](const std::string& beginning) { return NameOf(r).rfind(beginning, 0) == 0; }))
			refusals.unexpected.push_back(&r);
	}
	return refusals;
}

MadeUpRims CountMadeUpRims(const std::vector<Result>& results)
{
	MadeUpRims count;
	for (const Result& r : results)
	{
		if (!r.answer.refusal.empty() || !r.camera.glass.empty() || !r.camera.rims.empty())
			continue;
		const std::vector<tiltcal::Effect>& effects = r.answer.calibration.effects;
		++count.sets;
		count.with += std::any_of(effects.begin(), effects.end(), [](const tiltcal::Effect& e) { return e.used && e.id == tiltcal::EffectId::VIGNETTING_OPTICAL; });
	}
	return count;
}

void WritePage(const std::string& file, const std::string& command, const std::vector<Result>& results, const std::vector<std::string>& expected_refusals)
{
	std::string page = "# Simulated cameras, calibrated and held against the truth\n\nBy `" + command + "`: exact photographs, developed as the light's name says, measured and calibrated. "
		"Deviations are in the calibrator's own sigmas; the truth is the simulation's.\n\n"
		"| number | inside 2 σ | | true share, 95 % | not told | RMS, σ | mean, σ | worst, σ |\n|---|---|---|---|---|---|---|---|\n";
	for (const auto& [kind, c] : CoverageByKind(results))
		page += Row(kind, c);
	for (const std::string& light : LightsOf(results))
		page += Row("in the light " + light, CoverageOfLight(results, light));
	page += Row("**all**", CoverageOfAll(results));
	page += "\nThe interval of a share is the binomial one, wider where the numbers of one set hang together.\n";
	const MadeUpRims rims = CountMadeUpRims(results);
	page += fmt::format("\nThin lenses have no rims, unless `--rim` gives them one: {} of {} without were given one.\n", rims.with, rims.sets);
	page += RefusalsInWords(results, expected_refusals);
	page += "\n| camera | light | verdict, model | tilt error, degrees | corners, px RMS | inside 2 σ | not told | worst, σ |\n|---|---|---|---|---|---|---|---|\n";
	for (const Result& r : results)
		page += RowOf(r);
	tiltcal::WriteText(file, page);
}

}
