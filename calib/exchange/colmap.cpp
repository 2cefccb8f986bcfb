// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/colmap.h"

#include "base/plain_text.h"
#include "camera/state_camera.h"
#include "lens/distortion.h"

#include <tiltcal/error.h>

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace tiltcal
{

namespace
{

/// Parameters of the fit: f_x, f_y, c_x, c_y (our pixels), k1, k2, p1, p2, k3.
const int PARAMETERS = 9;

/// What COLMAP's camera makes of the direction (x, y, 1), y down, less the pixel where ours has it.
struct PixelError
{
	double x, y;
	Point pixel;

	template<typename T>
	bool operator()(const T* p, T* error) const
	{
		T d[2];
		tilt_lens::Distort(p + 4, T(x), T(y), d);
		error[0] = p[0] * d[0] + p[2] - pixel[0];
		error[1] = p[1] * d[1] + p[3] - pixel[1];
		return true;
	}
};

/// 33 by 33 pixels from edge to edge: five coefficients are smooth.
std::vector<PixelError> Grid(const StateCamera& c)
{
	std::vector<PixelError> grid;
	for (int j = 0; j <= 32; ++j)
		for (int i = 0; i <= 32; ++i)
		{
			const Point pixel{ i / 32.0 * (c.width - 1), j / 32.0 * (c.height - 1) };
			const std::optional<Vec3<double>> v = Unproject(c, pixel);
			if (!v)
				throw Refused(FoldWarning(c));
			grid.push_back({ v->x / v->z, -v->y / v->z, pixel });
		}
	return grid;
}

void Fit(const std::vector<PixelError>& grid, double* p)
{
	ceres::Problem problem;
	for (const PixelError& at : grid)
		problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PixelError, 2, PARAMETERS>(new PixelError(at)), nullptr, p);
	ceres::Solver::Options options;
	options.linear_solver_type = ceres::DENSE_QR;
	options.max_num_iterations = 200;
	options.function_tolerance = 1e-14;
	options.parameter_tolerance = 1e-12;
	options.logging_type = ceres::SILENT;
	ceres::Solver::Summary summary;
	ceres::Solve(options, &problem, &summary);
	if (summary.termination_type != ceres::CONVERGENCE)
		throw Refused("no camera of COLMAP's comes near this one: the fit did not converge");
}

}

ColmapCamera ToColmap(const StateCamera& c)
{
	const double w = c.ImageDistancePx();
	double p[PARAMETERS] = { w, w, c.principal_point[0], c.principal_point[1] };
	std::copy(c.distortion.begin(), c.distortion.end(), p + 4);
	const std::vector<PixelError> grid = Grid(c);
	if (c.IsTilted() && c.HasDistortion())
		Fit(grid, p);
	ColmapCamera camera{ p[0], p[1], { p[2] + 0.5, p[3] + 0.5 }, { p[4], p[5], p[6], p[7], p[8] }, 0, 0 };
	for (const PixelError& at : grid)
	{
		double error[2];
		at(p, error);
		camera.worst_px = std::max(camera.worst_px, std::hypot(error[0], error[1]));
		camera.rms_px += error[0] * error[0] + error[1] * error[1];
	}
	camera.rms_px = std::sqrt(camera.rms_px / double(grid.size()));
	return camera;
}

std::string ColmapText(const StateCamera& camera)
{
	const ColmapCamera c = ToColmap(camera);
	const Distortion& k = c.distortion;
	return fmt::format("# Camera list with one line of data per camera:\n"
		"#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
		"# Number of cameras: 1\n"
		"# State {}, by tiltcal {}. PARAMS: fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6. Within {:.2g} px RMS of tiltcal's camera, {:.2g} px at worst.\n"
		"1 FULL_OPENCV {} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} 0 0 0\n", OneLine(camera.state), TILTCAL_VERSION, c.rms_px, c.worst_px,
		camera.width, camera.height, c.fx, c.fy, c.centre[0], c.centre[1], k[0], k[1], k[2], k[3], k[4]);
}

}
