// SPDX-License-Identifier: AGPL-3.0-or-later

#include "effects/edge_shift.h"

#include "lens/optics.h"
#include "model/predict.h"
#include <tiltcal/calibrate.h>
#include "model/footprint.h"
#include "solve/solve_geometry.h"

namespace tiltcal
{

namespace
{

EdgeShift ShiftOf(const Calibration& c, size_t s, size_t p, const Edge& e)
{
	const Geometry& g = c.MainGeometry();
	const Vec3<double>& n = g.states[s].lens_normal;
	const tilt_lens::LensBasis<double> basis = tilt_lens::BasisOfLensPlane(n);
	const Vec3<double> P = EdgeInCamera(c.task, g.states[s].poses[p], e);
	const double curvature[2] = { c.solution.field_curvature.value, 0.5 * (c.solution.tangential_curvature.value - c.solution.sagittal_curvature.value) };
	const Vec3<double> move = MoveByLensPoint(c.solution.states[s].q, n, curvature, P, EdgeGradient(g, s, P, e));
	EdgeShift shift;
	shift.view = ViewOfPixel(c, s, e.x, e.y);
	shift.view.opening = c.solution.RatioOf(c.task.states[s].photos[p]);
	shift.by_x = -Dot(move, basis.a);
	shift.by_y = -Dot(move, basis.b);
	const Point normal = EdgeNormal(e), at = Reproject(c.task, g, s, p, e.board_column, e.board_row);
	shift.measured = normal[0] * (e.x - at[0]) + normal[1] * (e.y - at[1]);
	shift.sigma = e.offset_sigma;
	// A change of homography has eight numbers, of the radial distortion two.
	const double x = (e.x - g.states[s].principal_point[0]) / g.w_px, y = (e.y - g.states[s].principal_point[1]) / g.w_px, r2 = x * x + y * y;
	const double nx = normal[0], ny = normal[1], along = x * nx + y * ny;
	shift.nuisance << nx, ny, x * nx, x * ny, y * nx, y * ny, x * along, y * along, r2 * along, r2 * r2 * along;
	return shift;
}

}

std::vector<EdgeShift> EdgeShifts(const Calibration& c)
{
	std::vector<EdgeShift> shifts;
	size_t photo = 0;
	for (size_t s = 0; s < c.task.states.size() && s < c.MainGeometry().states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p, ++photo)
			for (const Edge& e : c.task.states[s].photos[p].edges)
			{
				shifts.push_back(ShiftOf(c, s, p, e));
				shifts.back().photo = photo;
			}
	return shifts;
}

}
