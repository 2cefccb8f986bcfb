// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/real_lens_ray.h"

#include "camera/real_lens_words.h"
#include "solve/real_lens_cost.h"

namespace tiltcal
{

CameraRay MeanRayThroughLens(const StateCamera& camera, const Point& pixel)
{
	const tilt_lens::RealLens<double> lens = RealLensOf(*camera.aberrations);
	const Vec3<double> n = camera.LensNormal();
	const double state[real_lens::STATE_SIZE] = { n.x / n.z, n.y / n.z, camera.ImageDistancePx() * lens.pupil_magnification, camera.principal_point[0], camera.principal_point[1] };
	const double of_lens[real_lens::LENS_SIZE] = { lens.power * camera.pitch_mm, lens.pupil_magnification, 1, 0 };
	MountedLens<double> mounted(state, of_lens, lens.aberrations.c, lens.aberrations.radius, camera.pitch_mm, pixel[0], pixel[1]);
	mounted.lens.etendue = lens.etendue;
	const double radius = 0.5 * camera.aperture_diameter_mm * lens.pupil_magnification;
	std::vector<tilt_lens::Rim> rims;
	for (const TwoNumbers& rim : camera.rims_mm)
		rims.push_back({ rim[0], rim[1] });
	CameraRay mean{ { 0, 0, 0 }, { 0, 0, 0 } };
	for (const OpeningPoint& p : OpeningThroughRims({ lens, radius, mounted.x, mounted.y, mounted.depth }, rims))
	{
		Vec3<double> origin, direction;
		mounted.Ray(radius * p.x, radius * p.y, origin, direction);
		// In the plane z = 0 of the camera, so that means of origins and of directions are the means of where the rays go.
		direction = (1 / direction.z) * direction;
		origin = origin - origin.z * direction;
		mean.origin = mean.origin + p.weight * origin;
		mean.direction = mean.direction + p.weight * direction;
	}
	return mean;
}

}
