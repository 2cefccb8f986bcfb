// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/shaded_lens.h"

#include "model/projection.h"
#include <tiltcal/photo.h>
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

/// Where the line from S to `to` meets the plane at the depth Z of the lens's axis, seen from the axis.
double OffAxis(const Vec& n, const Vec& S, const Vec& to, double Z)
{
	return (S + (Z - S.dot(n)) / (to - S).dot(n) * (to - S) - Z * n).norm();
}

/// Whether what goes from the scene's point `from` (any point of the ray before the lens) through S to the sensor's point `to` passes all rims.
bool Passes(const Shade& shade, const Vec& n, const Vec& from, const Vec& S, const Vec& to)
{
	return (shade.rim_radius <= 0 || OffAxis(n, S, from, shade.rim_distance) <= shade.rim_radius)
		&& (shade.front_radius <= 0 || OffAxis(n, S, from, shade.front_distance) <= shade.front_radius)
		&& (shade.rear_radius <= 0 || OffAxis(n, S, to, -shade.rear_distance) <= shade.rear_radius);
}

/// Point k of so many that cover the lens evenly: Fermat's spiral.
Vec LensPoint(const Lens& lens, const Vec& n, int k, int points)
{
	const Vec a = n.unitOrthogonal(), b = n.cross(a);
	const double radius = 0.5 * lens.d * std::sqrt((k + 0.5) / points), angle = k * 2.399963229728653;
	return radius * (std::cos(angle) * a + std::sin(angle) * b);
}

/// Where P's light from S meets the sensor, by Gauss's equation along the lens's own axis.
Vec OnSensor(const Lens& lens, const Vec& n, const Vec& P, const Vec& S)
{
	const double depth = P.dot(n);
	const Vec image = P / (1 - depth / lens.f);
	return S + (-lens.w - S.z()) / (image.z() - S.z()) * (image - S);
}

/// How far the middle of what the rims let through moves P's picture, px, v downwards.
Eigen::Vector2d ShiftOf(const Lens& lens, const Shade& shade, const Vec& P)
{
	const Vec n = Normal(lens), chief = OnSensor(lens, n, P, Vec::Zero());
	Vec sum = Vec::Zero();
	const int points = 2000;   // their middle is right to some 0.001 of the radius
	int open = 0;
	for (int k = 0; k < points; ++k)
	{
		const Vec S = LensPoint(lens, n, k, points), hit = OnSensor(lens, n, P, S);
		if (!Passes(shade, n, P, S, hit))
			continue;
		sum += hit - chief;
		++open;
	}
	return open ? Eigen::Vector2d(-sum.x(), sum.y()) / (open * PITCH) : Eigen::Vector2d(0, 0);   // the picture is upright
}

void MoveEdges(const Lens& lens, const Shade& shade, const tiltcal::Board& board, const tiltcal::Pose& pose, std::mt19937& random, tiltcal::Photo& photo)
{
	std::normal_distribution<double> normal(0, 0.03);
	for (tiltcal::Edge& e : photo.edges)
	{
		const tiltcal::Vec3<double> P = tiltcal::CameraFromBoard(pose.data(), board.X(e.board_column), board.Y(e.board_row));
		const double off = ShiftOf(lens, shade, { P.x, P.y, P.z }).dot(Eigen::Vector2d(e.nx, e.ny)) + normal(random);
		e.x += off * e.nx;
		e.y += off * e.ny;
		e.offset_sigma = 0.03;
	}
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
	// The ray's point on the plane of focus, along v; at infinity far away. 8000 points count an area to some 0.0005.
	const double inverse_depth = 1 / lens.f - 1 / (lens.w * direction.dot(n));   // v.z is 1
	const Vec focus = direction / direction.dot(n) / (std::abs(inverse_depth) > 1e-9 ? inverse_depth : 1e-9), sensor = -lens.w * direction;
	const int points = 8000;
	int open = 0;
	for (int k = 0; k < points; ++k)
		open += Passes(shade, n, focus, LensPoint(lens, n, k, points), sensor);
	return light * open / points;
}

tiltcal::Calibration Shaded(const std::vector<Lens>& lenses, const Shade& shade, double noise, unsigned seed, int photos)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> normal(0, 1);
	tiltcal::Calibration c;
	std::vector<tiltcal::State> states;
	const std::vector<tiltcal::Pose> poses = PosesOfPhotographs(photos);
	std::mt19937 edge_random(seed + 1000);
	for (size_t s = 0; s < lenses.size(); ++s)
		states.push_back(Photograph("state" + std::to_string(s), lenses[s], {}, photos));
	c.task = MakeTask(states);
	for (size_t s = 0; s < lenses.size(); ++s)
		for (tiltcal::Photo& photo : c.task.states[s].photos)
		{
			MoveEdges(lenses[s], shade, c.task.board, poses[size_t(&photo - c.task.states[s].photos.data())], edge_random, photo);
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
	c.geometry.states.resize(lenses.size());
	c.geometry.w_px = lenses[0].w / PITCH;
	c.solution.w_mm = { lenses[0].w, 0 };
	c.geometry.shared_poses = true;
	c.solution.model = tiltcal::Model::PLANE;
	c.solution.aperture_diameter = { lenses[0].d, 0 };
	c.solution.focal_length = { lenses[0].f, 0 };
	for (const Lens& lens : lenses)
	{
		const Vec n = Normal(lens);
		tiltcal::StateGeometry& state = c.geometry.states[c.solution.states.size()];
		state.poses = poses;
		state.principal_point = { lens.cx, lens.cy };
		state.lens_normal = { n.x(), n.y(), n.z() };
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
