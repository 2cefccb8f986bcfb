// SPDX-License-Identifier: AGPL-3.0-or-later

#include "shaded_lens.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace synthetic
{

namespace
{

using Vec = Eigen::Vector3d;

const double RAD = M_PI / 180;

Vec Normal(const Lens& lens)
{
	const double t = lens.tilt * RAD, phi = lens.direction * RAD;
	return { -std::sin(phi) * std::sin(t), -std::cos(phi) * std::sin(t), std::cos(t) };
}

/// Whether the ray that the lens point S sends to the focus of the direction v passes the rim.
bool Passes(const Lens& lens, const Shade& shade, const Vec& n, const Vec& v, const Vec& S)
{
	const double image_depth = lens.w * v.dot(n);   // v.z is 1
	const double inverse_depth = 1 / lens.f - 1 / image_depth;
	// The line through S and the point v s, s its depth, in a form that holds at infinity.
	const Vec ray = v / v.dot(n) - inverse_depth * S;
	const Vec met = S + shade.rim_distance / ray.dot(n) * ray;
	return (met - shade.rim_distance * n).norm() <= shade.rim_radius;
}

}

double LightLeft(const Lens& lens, const Shade& shade, double u, double v)
{
	const Vec n = Normal(lens), direction((u - lens.cx) * PITCH / lens.w, -(v - lens.cy) * PITCH / lens.w, 1);
	double light = 1;
	if (shade.natural)   // one cosine of the lens, three of the sensor, relative to the lens axis
	{
		const double sensor = 1 / direction.norm(), on_axis = n.z();
		light = direction.dot(n) * sensor * std::pow(sensor / on_axis, 3);
	}
	if (shade.rim_radius <= 0)
		return light;
	const Vec a = n.unitOrthogonal(), b = n.cross(a);
	// Fermat's spiral covers the disc evenly: 8000 points count an area to some 0.0005.
	const int points = 8000;
	int open = 0;
	for (int k = 0; k < points; ++k)
	{
		const double radius = 0.5 * lens.d * std::sqrt((k + 0.5) / points), angle = k * 2.399963229728653;
		open += Passes(lens, shade, n, direction, radius * (std::cos(angle) * a + std::sin(angle) * b));
	}
	return light * open / points;
}

tiltcal::Calibration Shaded(const std::vector<Lens>& lenses, const Shade& shade, double noise, unsigned seed, int photos)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> normal(0, 1);
	tiltcal::Calibration c;
	std::vector<tiltcal::State> states;
	for (size_t s = 0; s < lenses.size(); ++s)
		states.push_back(Photograph("state" + std::to_string(s), lenses[s], {}, photos));
	c.task = MakeTask(states);
	for (size_t s = 0; s < lenses.size(); ++s)
		for (tiltcal::Photo& photo : c.task.states[s].photos)
		{
			const double exposure = 0.7 + 0.2 * normal(random) / 3;
			for (int j = 0; j + 1 < c.task.board.InnerRows(); ++j)
				for (int i = j % 2; i + 1 < c.task.board.InnerColumns(); i += 2)
				{
					tiltcal::BrightPatch patch;
					for (int k = 0; k < 4; ++k)
					{
						const tiltcal::Corner& corner = photo.corners[size_t((j + k / 2) * c.task.board.InnerColumns() + i + k % 2)];
						patch.u += corner.x / 4;
						patch.v += corner.y / 4;
					}
					patch.board_column = i + 0.5;
					patch.board_row = j + 0.5;
					const double lit = 1 + shade.gradient * (patch.board_column / (c.task.board.InnerColumns() - 1) - 0.5);
					patch.value = exposure * lit * LightLeft(lenses[s], shade, patch.u, patch.v) * (1 + noise * normal(random));
					patch.sigma = noise * patch.value;
					photo.white.push_back(patch);
				}
		}
	c.geometry.w_px = lenses[0].w / PITCH;
	c.geometry.shared_poses = true;
	c.solution.model = "plane";
	c.solution.aperture_diameter = { lenses[0].d, 0 };
	c.solution.focal_length = { lenses[0].f, 0 };
	for (const Lens& lens : lenses)
	{
		const Vec n = Normal(lens);
		c.geometry.principal_point.push_back({ lens.cx, lens.cy });
		c.geometry.lens_normal.push_back({ n.x(), n.y(), n.z() });
		tiltcal::StateLens found;
		found.q = { n.x() / lens.f, n.y() / lens.f, n.z() / lens.f - 1 / lens.w };   // the vector lens equation
		c.solution.states.push_back(found);
	}
	return c;
}

tiltcal::FlatField ShadedField(const Lens& lens, size_t state, const Shade& shade, double noise, unsigned seed)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> normal(0, 1);
	tiltcal::FlatField field;
	field.state = state;
	for (double v = 22; v < 1200; v += 45)
		for (double u = 22; u < 1800; u += 45)
		{
			const double value = 0.6 * LightLeft(lens, shade, u, v) * (1 + noise * normal(random));
			field.patches.push_back({ u, v, value, noise * value, 0, 0 });
		}
	return field;
}

}
