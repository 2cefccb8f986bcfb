// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prediction_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace
{

/// What is promised (COSTS.md), where the pilot's blocks are a fair sample of the picture.
const double TimeBound = 0.25, ErrorBound = 0.30;
/// Where they are not, tiltcost says so by its standard deviation, a jackknife over ten groups of blocks: Student's t with 9 degrees of
/// freedom is beyond this once in a thousand. Of twenty-two scenes and figures, whose two settings share a pilot, one day in fifty.
const double Student = 4.78;
/// A prediction that is wrong by a factor of two, up or down, is none, whatever it says of itself: no bound is wider, and a standard deviation whose bound would be is a failure itself.
/// Else whoever says to know less and less of his own predictions could never be wrong.
const double MostBound = 1.0, MostSigma = MostBound / Student;

/// `off` is predicted / true - 1. A bound beyond the promise is a factor, the same one down as up: what is 100 % too much one way is half the other.
bool Within(double off, double limit, double promise) { return off <= limit && off >= std::min(-promise, 1 / (1 + limit) - 1); }

std::string DenoisedCells(const Result& r)
{
	if (r.denoised <= 0)
		return "<td>-</td><td></td><td></td><td></td>";
	return fmt::format("<td>{:.4f}</td><td>{:.4f}</td><td>{:+.0f} %</td><td>{:.0f} %</td>", r.predicted.denoised_error, r.denoised, 100 * r.DenoisedOff(), 100 * r.DenoisedLimit());
}

}

double Result::ErrorLimit() const { return std::min(MostBound, std::max(ErrorBound, Student * std::hypot(predicted.error_sigma, uncertain))); }

double Result::DenoisedLimit() const { return std::min(MostBound, std::max(ErrorBound, Student * std::hypot(predicted.denoised_sigma, denoised_uncertain))); }

double Result::TimeLimit() const { return std::min(MostBound, std::max(TimeBound, Student * predicted.time_sigma)); }

bool Result::SigmasPromise(bool judge_time) const
{
	return predicted.error_sigma <= MostSigma && (denoised <= 0 || predicted.denoised_sigma <= MostSigma) && (!judge_time || predicted.time_sigma <= MostSigma);
}

bool Result::Good(bool judge_time) const
{
	return SigmasPromise(judge_time) && Within(ErrorOff(), ErrorLimit(), ErrorBound) && Within(DenoisedOff(), DenoisedLimit(), ErrorBound) && Within(RaysOff(), TimeLimit(), TimeBound)
		&& (!judge_time || (Within(TimeOff(), TimeLimit(), TimeBound) && Within(DenoisedTimeOff(), TimeLimit(), TimeBound)));
}

std::string Line(const Result& r, bool judge_time)
{
	const TiltcostRow& p = r.predicted;
	return fmt::format("{} {:<11} {:4.1f} %  {:>2}, {:>4}, {:<7g} error {:.5f} is {:.5f} ({:+3.0f} % of {:.0f} %; known to {:.1f} %)  denoised {:.5f} is {:.5f} ({:+3.0f} % of {:.0f} %)  rays {:.0f} is {:.0f} ({:+3.0f} %)  CPU {:6.2f} s is {:6.2f} s ({:+3.0f}, denoised {:+3.0f} % of {:.0f} %)",
		r.Good(judge_time) ? ' ' : '!', r.scene, 100 * r.share, p.min, p.max, p.variance, p.error, r.error, 100 * r.ErrorOff(), 100 * r.ErrorLimit(), 100 * r.uncertain,
		r.denoised > 0 ? p.denoised_error : 0, r.denoised, 100 * r.DenoisedOff(), 100 * r.DenoisedLimit(), p.rays, r.rays, 100 * r.RaysOff(), p.cpu, r.cpu, 100 * r.TimeOff(), 100 * r.DenoisedTimeOff(), 100 * r.TimeLimit());
}

void WritePredictions(const std::filesystem::path& folder, const std::vector<Result>& results, const Rendering& rendering)
{
	std::string csv = "scene,min,max,variance,predicted_error,predicted_error_sigma,error,error_sigma,predicted_rays,rays,predicted_cpu_s,predicted_cpu_sigma,cpu_s,pilot_share,predicted_denoised_error,predicted_denoised_error_sigma,denoised_error,denoised_error_sigma,predicted_denoised_cpu_s,denoised_cpu_s\n";
	const bool timed = rendering.judge_time;
	std::string html = fmt::format("<h2>tiltcost: predicted and rendered</h2>\n<p>{} × {} pixels, predicted once{}, from the part of the picture that stands beside it. Errors against "
		"truths with other lens samples, whose own error is taken off. Bounds: {:.0f} % in rays{}, {:.0f} % in error, or {:.2f} standard deviations (Student's t, once in 1000) where those are wider, never more than {:.0f} %, and no standard "
		"deviation that is told may be beyond {:.0f} %."
		"</p>\n<table><tr><th>scene</th><th>pilot</th><th>blur_samples, variance</th><th>error predicted</th><th>rendered</th><th>off by</th><th>bound</th>"
		"<th>denoised, predicted</th><th>rendered</th><th>off by</th><th>bound</th><th>rays predicted</th><th>rendered</th><th>off by</th><th>CPU s predicted</th><th>rendered</th><th>off by</th><th>denoised, off by</th><th>bound</th></tr>\n", rendering.width, rendering.height, timed ? " (seconds in turn with the renders)" : "", 100 * TimeBound,
		timed ? " and in time" : " (seconds are shown, not judged)", 100 * ErrorBound, Student, 100 * MostBound, 100 * MostSigma);
	for (const Result& r : results)
	{
		const TiltcostRow& p = r.predicted;
		csv += fmt::format("{},{},{},{:g},{:.5g},{:.3g},{:.5g},{:.3g},{:.0f},{:.0f},{:.4g},{:.3g},{:.4g},{:.4g},{:.5g},{:.3g},{:.5g},{:.3g},{:.4g},{:.4g}\n", r.scene, p.min, p.max, p.variance, p.error, p.error_sigma, r.error, r.uncertain,
			p.rays, r.rays, p.cpu, p.time_sigma, r.cpu, r.share, r.denoised > 0 ? p.denoised_error : 0, p.denoised_sigma, r.denoised, r.denoised_uncertain, p.cpu + p.denoise_cpu, r.denoised_cpu);
		html += fmt::format("<tr{}><td>{}</td><td>{:.1f} %</td><td>{}, {}, {:g}</td><td>{:.4f}</td><td>{:.4f}</td><td>{:+.0f} %</td><td>{:.0f} %</td>{}<td>{:.0f}</td><td>{:.0f}</td><td>{:+.0f} %</td>"
			"<td>{:.2f}</td><td>{:.2f}</td><td>{:+.0f} %</td><td>{:+.0f} %</td><td>{:.0f} %</td></tr>\n", r.Good(timed) ? "" : " class=\"lost\"", r.scene, 100 * r.share, p.min, p.max, p.variance, p.error, r.error, 100 * r.ErrorOff(), 100 * r.ErrorLimit(),
			DenoisedCells(r), p.rays, r.rays, 100 * r.RaysOff(), p.cpu, r.cpu, 100 * r.TimeOff(), 100 * r.DenoisedTimeOff(), 100 * r.TimeLimit());
	}
	html += "</table>\n";
	std::ofstream(folder / "tiltcost.csv") << csv;
	std::ofstream(folder / "tiltcost.html") << html;
}
