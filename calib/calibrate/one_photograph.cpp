// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/one_photograph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// A change is chance up to so many sigmas of the number.
const double CHANCE = 4;
/// Of a tilt, degrees: what is wanted of it (0.03) and a half more; and ten times that.
const double TILT_SEEN = 0.05, TILT_LARGE = 0.3;
/// Of d, and of the boards' mean 1/z for 1/U: likewise of the hundredth that is wanted of them (optimal_design.cpp).
const double SEEN = 0.016, LARGE = 0.1;

/// What of one number changes, in words.
struct Change
{
	double size, allowed, large;
	std::string words;

	bool IsSeen() const { return size > allowed; }
};

/// What chance makes of numbers. A photograph that contradicts the others widens the sigmas that hold how photographs scatter, by as much as the
/// answer moves without it, so that no change would ever be seen: of the edges alone. Where a real lens is the answer, how the thin one scatters is
/// known to be the glass.
class Chance
{
public:
	explicit Chance(const Calibration& calibration) : c(calibration) {}

	double OfAperture() const { return Sigma("aperture_diameter_mm", c.solution.aperture_diameter.sigma); }
	double OfInverseFocus() const { return Sigma(c.task.states[0].name + ".q_z_per_mm", c.solution.states[0].q_sigma.z); }

	/// As a vector, degrees; of the untilted state's photographs the tilt that is known least.
	double OfTilt(size_t s) const
	{
		double most = 0;
		for (size_t k = 0; k < c.solution.states.size(); ++k)
			if (s == 0 || k == s)
			{
				const StateLens& lens = c.solution.states[k];
				const std::string& name = c.task.states[k].name;
				// n is f q across the axis.
				most = std::max(most, c.solution.focal_length.value * 180 / M_PI * std::hypot(Sigma(name + ".q_x_per_mm", lens.q_sigma.x), Sigma(name + ".q_y_per_mm", lens.q_sigma.y)));
			}
		return most;
	}

private:
	double Sigma(const std::string& name, double told) const
	{
		const NamedCovariance& all = c.solution.covariance;
		const size_t k = size_t(std::find(all.names.begin(), all.names.end(), name) - all.names.begin()), n = all.names.size();
		return c.RealLensIsUsed() || k == n ? told : std::sqrt(all.matrix[k * n + k]);
	}

	const Calibration& c;
};

std::vector<Change> ChangesOf(const Calibration& c, const LeftOut& l)
{
	const Chance chance(c);
	const double d = c.solution.aperture_diameter.value, nearness = MeanNearness(c.geometry);
	return {
		{ l.tilt_change, std::max(CHANCE * chance.OfTilt(l.state), TILT_SEEN), TILT_LARGE, fmt::format("{} by {:.2f} degrees", l.state ? "the tilt changes" : "a tilt changes", l.tilt_change) },
		{ l.aperture_change, std::max(CHANCE * chance.OfAperture(), SEEN * d), LARGE * d, fmt::format("the aperture changes by {:.1f} %", 100 * l.aperture_change / d) },
		{ l.inverse_focus_change, std::max(CHANCE * chance.OfInverseFocus(), SEEN * nearness), LARGE * nearness, fmt::format("1/U changes by {:.2g} 1/m", 1000 * l.inverse_focus_change) },
	};
}

double Most(const std::vector<Change>& changes)
{
	double most = 0;
	for (const Change& change : changes)
		most = std::max(most, change.size / change.allowed);
	return most;
}

}

double MeanNearness(const Geometry& g)
{
	double sum = 0, count = 0;
	for (const StateGeometry& state : g.states)
		for (const Pose& pose : state.poses)
		{
			sum += 1 / pose[5];
			++count;
		}
	return sum / std::max(count, 1.0);
}

std::vector<Remark> JudgeLeftOut(const Calibration& c, size_t s)
{
	const std::vector<Photo>& photos = c.task.states[s].photos;
	if (photos.size() == 1)
		return { { Grade::FAIR, fmt::format("state {}: one photograph alone cannot be checked against others: photograph at least three poses", c.task.states[s].name) } };
	const size_t answered = size_t(std::count_if(c.solution.left_out.begin(), c.solution.left_out.end(), [s](const LeftOut& l) { return l.state == s; }));
	const size_t with_edges = size_t(std::count_if(photos.begin(), photos.end(), [](const Photo& photo) { return !photo.edges.empty(); }));
	if (answered < with_edges)
		return { { Grade::FAIR, fmt::format("state {}: without {} of its {} photographs, one left out at a time, there is no answer: what hangs on one of them is not known. Photograph more poses",
			c.task.states[s].name, with_edges - answered, with_edges) } };
	const LeftOut* worst = nullptr;
	std::vector<Change> without;
	for (const LeftOut& l : c.solution.left_out)
		if (std::vector<Change> changes = ChangesOf(c, l); l.state == s && (!worst || Most(changes) > Most(without)))
		{
			worst = &l;
			without = std::move(changes);
		}
	Grade grade = Grade::GOOD;
	std::string words;
	for (const Change& change : without)
		if (change.IsSeen())
		{
			grade = std::max(grade, change.size > change.large ? Grade::POOR : Grade::FAIR);
			words += (words.empty() ? "" : ", ") + change.words;
		}
	if (words.empty())
		return {};
	return { { grade, fmt::format("state {}: without {} {}: look at that photograph, and take more", c.task.states[s].name, photos[worst->photo].file, words) } };
}

}
