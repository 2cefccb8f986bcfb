// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/check_untilted.h"

#include "model/tilt_angles.h"
#include "solve/solve_joint.h"

#include <tiltcal/error.h>

#include <algorithm>

namespace tiltcal
{

UntiltedCheck CheckUntilted(const Calibration& c)
{
	const Solution& s = c.solution;
	const std::vector<Observation> observations = Observe(c.task, c.geometry);
	BlurFit fit{ s.lens, observations, s.w_mm.value, 0.1, c.task.priors, c.task.stops };
	Unknowns x = UnknownsOf(s);
	x.untilted_free = true;
	UntiltedCheck check;
	try
	{
		for (int round = 0; round < 2; ++round)
		{
			fit.model_sigma = fit.LeftOutBy(x);
			if (!fit.Minimise(x, Free::EVERYTHING, 0))
				return check;
		}
		StateLens lens;
		FillStateLens(fit.Plane(x, 0), s.w_mm.value, fit.Covariance(x, s.w_mm.sigma).OfPlaneAndImageDistance(0), lens);
		check = { true, lens.lens_tilt, lens.tilt_direction, std::nullopt };
		const GeometryAlone places = TiltFromGeometryAlone(c.task, c.geometry, s, true);
		if (!places.states.empty())
			check.by_places = places.states[0];
	}
	catch (const Error& e)
	{
		if (e.Code() != EXIT_REFUSED)
			throw;
	}
	return check;
}

}
