// SPDX-License-Identifier: AGPL-3.0-or-later

#include "closed_loop_page.h"

#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

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

void Add(const Deviation& d, Coverage& c)
{
	const double z = d.InSigmas();
	c.inside += std::abs(z) < 2;
	c.rms += std::min(100.0, z * z);
	c.mean += std::clamp(z, -10.0, 10.0);   // one that is far off is not to hide the others
	c.worst = std::max(c.worst, std::abs(z));
	++c.all;
}

void Add(const Answer& a, Coverage& c)
{
	for (const Deviation& d : a.deviations)
		Add(d, c);
	c.not_told += int(a.not_told.size());
}

void Finish(Coverage& c)
{
	c.rms = c.all ? std::sqrt(c.rms / c.all) : 0;
	c.mean = c.all ? c.mean / c.all : 0;
}

std::string Row(const std::string& name, const Coverage& c)
{
	return fmt::format("| {} | {} of {} | {:.0f} % | {} | {:.2f} | {:+.2f} | {:.1f} |\n", name, c.inside, c.all, 100 * c.Share(), c.not_told, c.rms, c.mean, c.worst);
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
	Coverage of_it;
	for (const Result& r : results)
		if (r.light == light)
			Add(r.answer, of_it);
	Finish(of_it);
	return of_it;
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
	Coverage of_it;
	const Deviation* worst = nullptr;
	for (const Deviation& d : r.answer.deviations)
	{
		Add(d, of_it);
		if (!worst || std::abs(d.InSigmas()) > std::abs(worst->InSigmas()))
			worst = &d;
	}
	return name + fmt::format("{}, {} | {:.4f} | {:.3f} | {} of {} | {} | {} {:+.1f} |\n", tiltcal::NameOf(c.verdict.grade), tiltcal::NameOf(c.Answer()), r.answer.tilt_error, c.geometry.rms,
		of_it.inside, of_it.all, Joined(r.answer.not_told), worst ? worst->name : "", worst ? worst->InSigmas() : 0);
}

}

std::vector<std::pair<std::string, Coverage>> CoverageByKind(const std::vector<Result>& results)
{
	std::map<std::string, Coverage> kinds;
	for (const Result& r : results)
		for (const Deviation& d : r.answer.deviations)
			Add(d, kinds[KindOf(d.name)]);
	for (auto& [kind, c] : kinds)
		Finish(c);
	return { kinds.begin(), kinds.end() };
}

Coverage CoverageOfAll(const std::vector<Result>& results)
{
	Coverage all;
	for (const Result& r : results)
		Add(r.answer, all);
	Finish(all);
	return all;
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

void WritePage(const std::string& file, const std::string& command, const std::vector<Result>& results, const std::vector<std::string>& expected_refusals)
{
	std::string page = "# Simulated cameras, calibrated and held against the truth\n\nBy `" + command + "`: exact photographs, developed as the light's name says, measured and calibrated. "
		"Deviations are in the calibrator's own sigmas; the truth is the simulation's.\n\n"
		"| number | inside 2 σ | | not told | RMS, σ | mean, σ | worst, σ |\n|---|---|---|---|---|---|---|\n";
	for (const auto& [kind, c] : CoverageByKind(results))
		page += Row(kind, c);
	for (const std::string& light : LightsOf(results))
		page += Row("in the light " + light, CoverageOfLight(results, light));
	page += Row("**all**", CoverageOfAll(results));
	page += RefusalsInWords(results, expected_refusals);
	page += "\n| camera | light | verdict, model | tilt error, degrees | corners, px RMS | inside 2 σ | not told | worst, σ |\n|---|---|---|---|---|---|---|---|\n";
	for (const Result& r : results)
		page += RowOf(r);
	tiltcal::WriteText(file, page);
}

}
