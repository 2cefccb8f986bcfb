// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_approximations.h"

#include "support/synthetic_lens.h"
#include "solve/blur_fit.h"
#include "solve/solve_geometry.h"

#include <algorithm>
#include <cmath>

namespace calibrator_cost
{

namespace
{

const double RAD = 3.14159265358979323846 / 180;

struct Problem
{
	std::vector<tiltcal::Observation> observations;
	synthetic::Lens untilted;
	Mended mended;

	/// Sum of squares for a lens tilt, with the plane of focus that (1) gives it.
	double Cost(double lens_tilt) const
	{
		const double w = untilted.w, f = untilted.f, d = untilted.d;
		const double U = mended.refocused ? 1 / (std::cos(lens_tilt * RAD) / f - 1 / w) : untilted.FocusDistance();
		const double slope = std::tan(lens_tilt * RAD) * (U + w) / w;   // tan(theta_F), by (1)
		double sum = 0;
		for (const tiltcal::Observation& o : observations)
		{
			// The ray (x, y, z) t meets z = U + y slope at t z = U / (1 - slope y / z).
			const double depth = mended.depth_along_ray ? U / (1 - slope * o.P.y / o.P.z) : U + o.P.y * slope;
			const double b = w / synthetic::PITCH * d * std::abs(1 / depth - 1 / o.P.z);
			sum += (b - o.blur) * (b - o.blur);
		}
		return sum;
	}
};

}

double TiltByPaper(int pose, double true_tilt, const Mended& mended)
{
	synthetic::Lens untilted, tilted;
	tilted.tilt = true_tilt;
	tiltcal::Task task = synthetic::MakeTask({ synthetic::Photograph("untilted", untilted, {}), synthetic::Photograph("tilted", tilted, {}) });
	const tiltcal::Geometry geometry = tiltcal::SolveGeometry(task, {});
	Problem problem{ {}, untilted, mended };
	for (const tiltcal::Observation& o : tiltcal::Observe(task, geometry))
		if (o.state == 1 && o.photo == size_t(pose))
			problem.observations.push_back(o);
	// A coarse search, for |.| has more than one minimum, then golden section.
	double best = 0;
	for (double tilt = -12; tilt <= 12; tilt += 0.1)
		if (problem.Cost(tilt) < problem.Cost(best))
			best = tilt;
	const double golden = 0.5 * (std::sqrt(5.0) - 1);
	double a = best - 0.1, b = best + 0.1;
	while (b - a > 1e-7)
	{
		const double x = b - golden * (b - a), y = a + golden * (b - a);
		(problem.Cost(x) < problem.Cost(y) ? b : a) = problem.Cost(x) < problem.Cost(y) ? y : x;
	}
	return 0.5 * (a + b);
}

}
