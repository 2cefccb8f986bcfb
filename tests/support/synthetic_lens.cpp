// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/synthetic_lens.h"

#include <Eigen/Geometry>

#include <cmath>
#include <random>

namespace synthetic
{

namespace
{

using Real = long double;
using Vec = Eigen::Matrix<Real, 3, 1>;
const Real RAD = 3.14159265358979323846L / 180;

tiltcal::Board TheBoard() { return tiltcal::ParseBoard("12x9", 25); }

Vec Normal(const Lens& lens)
{
	const Real t = lens.tilt * RAD, phi = lens.direction * RAD;
	return { -std::sin(phi) * std::sin(t), -std::cos(phi) * std::sin(t), std::cos(t) };
}

/// Image of P, by Gauss's equation along the lens's own axis.
Vec Image(const Lens& lens, const Vec& P)
{
	const Real s = P.dot(Normal(lens));                 // object distance
	const Real image = 1 / (1 / Real(lens.f) - 1 / s);
	return -P * (image / s);                            // the centre ray is straight
}

/// Where the ray from P through the lens point S hits the sensor z = -w; in the upright
/// picture, mm from the principal point, y up.
Eigen::Matrix<Real, 2, 1> Hit(const Lens& lens, const Vec& P, const Vec& S)
{
	const Vec ray = Image(lens, P) - S;
	const Real t = (-Real(lens.w) - S.z()) / ray.z();
	const Vec hit = S + t * ray;
	return { -hit.x(), -hit.y() };
}

/// Where the lens point S sees P, of a lens with field curvature: the direction v, found by iteration, whose
/// focus point on the bowl lies on the line from S through P. As Hit.
Eigen::Matrix<Real, 2, 1> HitOfBowl(const Lens& lens, const Vec& P, const Vec& S)
{
	const Vec n = Normal(lens);
	Vec v = P;
	for (int k = 0; k < 8; ++k)   // each gains two digits or more
	{
		// Along v the plane of focus of Gauss's equation: the object depth s whose image lies on the sensor z = -w.
		const Real along = v.dot(n) / v.norm(), cosine = v.z() / v.norm();
		const Real image_depth = Real(lens.w) / cosine * along;
		const Real plane = 1 / Real(lens.f) - 1 / image_depth;
		const Real tangent = std::sqrt(std::max(0.0L, 1 - along * along)) / along;
		const Vec focus = v / v.dot(n) / (plane + Real(lens.curvature) * tangent * tangent);
		// The ray from S through the focus point must meet P: shift v by what it misses P, at P's depth.
		const Vec reached = S + (focus - S) * (P.dot(n) / focus.dot(n));
		v = v * (P.dot(n) / v.dot(n)) + (P - reached);
	}
	return Eigen::Matrix<Real, 2, 1>(v.x(), v.y()) * (Real(lens.w) / v.z());
}

/// Width of the footprint of the lens's rim along the picture direction (nx, ny), px.
double Width(const Lens& lens, const Vec& P, double nx, double ny)
{
	const Vec n = Normal(lens);
	const Vec a = n.unitOrthogonal(), b = n.cross(a);
	Real least = 1e30L, most = -1e30L;
	// 360 rim points leave out less than (pi/360)^2/2 = 4e-5 of the width.
	const int points = 360;
	for (int k = 0; k < points; ++k)
	{
		const Real u = 2 * 3.14159265358979323846L * k / points;
		const Vec S = (Real(lens.d) / 2) * (std::cos(u) * a + std::sin(u) * b);
		const auto hit = lens.curvature == 0 ? Hit(lens, P, S) : HitOfBowl(lens, P, S);
		const Real along = nx * hit.x() - ny * hit.y();   // the picture's y is down
		least = std::min(least, along);
		most = std::max(most, along);
	}
	return double(most - least) / PITCH;
}

/// The direction in which the picture shows P: its slope from the lens axis is (1 + k1 slope^2) as large.
Vec Distorted(const Lens& lens, const Vec& P)
{
	const Vec n = Normal(lens), slope = P / P.dot(n) - n;
	return n + slope * (1 + Real(lens.k1) * slope.squaredNorm());
}

struct Placed
{
	Eigen::Matrix<Real, 3, 3> R;
	Vec t;
};

/// Tilted about x and y by these degrees, its centre on the axis at `distance`.
Placed Place(double about_x, double about_y, double about_z, double distance)
{
	const Eigen::Matrix<Real, 3, 3> R = (Eigen::AngleAxis<Real>(about_x * RAD, Vec::UnitX()) * Eigen::AngleAxis<Real>(about_y * RAD, Vec::UnitY())
		* Eigen::AngleAxis<Real>(about_z * RAD, Vec::UnitZ())).toRotationMatrix();
	const Vec centre(125, -87.5L, 0);
	return { R, Vec(0, 0, distance) - R * centre };
}

std::vector<Placed> Inclined(double shift)
{
	return {
		Place(35, 0, 0, 630 + shift), Place(-36, 3, 2, 600 + shift), Place(0, 36, 0, 640 + shift),
		Place(2, -38, -4, 650 + shift), Place(25, 25, 5, 620 + shift), Place(-26, -24, -3, 610 + shift)
	};
}

tiltcal::Photo Shoot(const Lens& lens, const Placed& pose, const Noise& noise, std::mt19937& random, const Shape& shape = {})
{
	const tiltcal::Board board = TheBoard();
	std::normal_distribution<double> normal(0, 1);
	std::mt19937 offsets(random());
	tiltcal::Photo photo;
	photo.width = 1800;
	photo.height = 1200;
	const auto camera = [&](double column, double row) 
	{
		const Real along = 2 * Real(column) / (board.InnerColumns() - 1) - 1, down = 2 * Real(row) / (board.InnerRows() - 1) - 1;
		const Real height = shape.bend * (1 - along * along) + shape.bend_along_rows * (1 - down * down) + shape.twist * along * down;
		return Vec(pose.R * Vec(board.X(column) * (1 + shape.widening), board.Y(row), height) + pose.t);
	};
	const auto pixel = [&](const Vec& object)
	{
		const Vec P = Distorted(lens, object);
		return Eigen::Vector2d(lens.cx + double(lens.w * P.x() / P.z()) / PITCH, lens.cy - double(lens.w * P.y() / P.z()) / PITCH);
	};
	for (int j = 0; j < board.InnerRows(); ++j)
		for (int i = 0; i < board.InnerColumns(); ++i)
		{
			const Eigen::Vector2d p = pixel(camera(i, j));
			photo.corners.push_back({ i, j, p.x() + noise.corner * normal(random), p.y() + noise.corner * normal(random), std::max(noise.corner, 0.005) });
			for (const bool along : { true, false })
			{
				if ((along ? i + 1 >= board.InnerColumns() : j + 1 >= board.InnerRows()))
					continue;
				tiltcal::Edge e;
				e.column = i;
				e.row = j;
				e.along_columns = along;
				e.board_column = i + (along ? 0.5 : 0);
				e.board_row = j + (along ? 0 : 0.5);
				const Vec P = camera(e.board_column, e.board_row);
				const Eigen::Vector2d way = (pixel(camera(i + along, j + !along)) - p).normalized();
				e.nx = -way.y();
				e.ny = way.x();
				const double off = noise.corner * normal(offsets);
				e.x = pixel(P).x() + off * e.nx;
				e.y = pixel(P).y() + off * e.ny;
				e.offset_sigma = std::max(noise.corner, 0.002);
				const double width = Width(lens, P, e.nx, e.ny);
				e.blur = std::abs(std::hypot(width, lens.floor) + noise.blur * normal(random));
				e.blur_sigma = std::max(noise.blur, 0.01);
				photo.edges.push_back(e);
			}
		}
	return photo;
}

}

double Lens::FocusDistance() const
{
	// A point at z = U on the axis has the object distance U cos(tilt); its image must lie
	// at z = -w, at the image distance w cos(tilt).
	const double c = std::cos(double(tilt * RAD));
	return 1 / (c / f - 1 / w);
}

tiltcal::State Photograph(const std::string& name, const Lens& lens, const Noise& noise, int photos, double shift, const Shape& shape)
{
	const std::vector<Placed> poses = Inclined(shift);
	std::mt19937 random(noise.seed);
	tiltcal::State state;
	state.name = name;
	for (int k = 0; k < photos; ++k)
		state.photos.push_back(Shoot(lens, poses[size_t(k)], noise, random, shape));
	return state;
}

std::vector<tiltcal::Pose> PosesOfPhotographs(int photos, double shift)
{
	std::vector<tiltcal::Pose> poses;
	const std::vector<Placed> placed = Inclined(shift);
	for (int k = 0; k < photos; ++k)
	{
		const Eigen::AngleAxis<Real> turn(placed[size_t(k)].R);
		const Vec r = turn.angle() * turn.axis(), t = placed[size_t(k)].t;
		poses.push_back({ double(r.x()), double(r.y()), double(r.z()), double(t.x()), double(t.y()), double(t.z()) });
	}
	return poses;
}

tiltcal::State PhotographParallel(const std::string& name, const Lens& lens, double distance)
{
	std::mt19937 random(1);
	tiltcal::State state;
	state.name = name;
	for (int k = 0; k < 3; ++k)
		state.photos.push_back(Shoot(lens, Place(0, 0, 10 * k, distance), { 0.02, 0.05, 1 }, random));
	return state;
}

tiltcal::Task MakeTask(std::vector<tiltcal::State> states)
{
	tiltcal::Task task;
	task.board = TheBoard();
	task.pitch_mm = PITCH;
	task.width = 1800;
	task.height = 1200;
	for (size_t k = 0; k < states.size(); ++k)
		states[k].tilted = k > 0;
	task.states = std::move(states);
	return task;
}

Lens Tilted(double tilt, double direction)
{
	Lens lens;
	lens.tilt = tilt;
	lens.direction = direction;
	return lens;
}

tiltcal::Task TwoStates(const Lens& untilted, const Lens& tilted, const Noise& noise, const Noise& noise_tilted)
{
	return MakeTask({ Photograph("untilted", untilted, noise), Photograph("tilted", tilted, noise_tilted) });
}

tiltcal::Task TwoStates(const Lens& untilted, const Lens& tilted, const Noise& noise) { return TwoStates(untilted, tilted, noise, noise); }

double TiltError(const tiltcal::StateLens& found, const Lens& lens)
{
	const double phi = found.tilt_direction.value * M_PI / 180, truth = lens.direction * M_PI / 180;
	return std::hypot(found.lens_tilt.value * std::sin(phi) - lens.tilt * std::sin(truth),
		found.lens_tilt.value * std::cos(phi) - lens.tilt * std::cos(truth));
}

}
