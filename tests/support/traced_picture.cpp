// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/traced_picture.h"

#include "prescription/trace.h"
#include "support/srgb.h"

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>

namespace synthetic
{

namespace
{

using namespace tiltcal;
using V = tilt_lens::Vec3<double>;

/// A rectangle of the exit pupil's plane that holds what a pixel's rays pass.
struct Box
{
	double x0 = 1e30, x1 = -1e30, y0 = 1e30, y1 = -1e30;

	void Add(double x, double y)
	{
		x0 = std::min(x0, x);
		x1 = std::max(x1, x);
		y0 = std::min(y0, y);
		y1 = std::max(y1, y);
	}
	bool Empty() const { return x1 < x0; }
	double Area() const { return (x1 - x0) * (y1 - y0); }
};

/// What one ray brings.
struct Hit
{
	double weight;           ///< its share of the illuminance: both cosines over the square of the distance
	double x, y;             ///< on the board, mm; nan: the board's plane is not before it
};

class Camera
{
public:
	Camera(const TracedScene& scene, const GlassState& state)
		: scene_(scene), frame_(scene.glass, state), paraxial_(ParaxialOf(scene.glass))
	{
		GlassState untilted = state;
		untilted.tilt_deg = 0;
		pupil_ = GlassFrame(scene.glass, untilted).OnAxis(paraxial_.entrance_pupil);
	}

	/// The ray from the pixel's place through (x, y) of the exit pupil's plane; none: it does not come through.
	std::optional<Hit> Trace(double u, double v, double x, double y) const
	{
		const V from = frame_.ToGlass(SensorPoint(scene_.sensor, u, v)), to = V{ x, y, paraxial_.exit_pupil } - from;
		Ray<double> ray{ from, Normalized(to) };
		const double cosine = ray.direction.z, on_sensor = frame_.DirectionToSensor(ray.direction).z;
		if (TraceToScene(scene_.glass, ray) != Fate::PASSED)
			return std::nullopt;
		const Eigen::Vector2d at = OnBoard(ray);
		return Hit{ cosine * on_sensor / Dot(to, to), at.x(), at.y() };
	}

	/// Around all that passes to this pixel; empty: nothing does.
	Box Opening(double u, double v) const
	{
		const int n = 25;
		const double reach = 1.6 * paraxial_.entrance_radius * paraxial_.pupil_magnification, step = 2 * reach / n;
		Box box;
		for (int i = 0; i < n; ++i)
			for (int j = 0; j < n; ++j)
			{
				const double x = -reach + (i + 0.5) * step, y = -reach + (j + 0.5) * step;
				if (Trace(u, v, x, y))
				{
					box.Add(x - step, y - step);
					box.Add(x + step, y + step);
				}
			}
		return box;
	}

	const TracedScene& scene() const { return scene_; }

private:
	Eigen::Vector2d OnBoard(const Ray<double>& ray) const
	{
		// Sensor frame to the board's: y is down there, and the origin in the pupil.
		const V p = frame_.ToSensor(ray.point) - pupil_, d = frame_.DirectionToSensor(ray.direction);
		const Eigen::Vector3d point = scene_.camera_from_board.transpose() * (Eigen::Vector3d(p.x, -p.y, p.z) - scene_.origin);
		const Eigen::Vector3d direction = scene_.camera_from_board.transpose() * Eigen::Vector3d(d.x, -d.y, d.z);
		const double along = -point.z() / direction.z();
		if (!(along > 0))
			return { NAN, NAN };
		return (point + along * direction).head<2>();
	}

	const TracedScene& scene_;
	GlassFrame frame_;
	Paraxial paraxial_;
	V pupil_;
};

/// Points of a box and of the pixel's square: a four-dimensional additive sequence.
const double STEPS[4] = { 0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101 };

double Part(double start, int k, int dimension)
{
	const double x = start + k * STEPS[dimension];
	return x - std::floor(x);
}

/// How much light of an evenly bright world falls on each pixel, up to a factor: on a coarse grid, and the opening's boxes there.
class Light
{
public:
	/// For the pixels of `part`.
	Light(const Camera& camera, const cv::Rect& part)
		: sensor_(camera.scene().sensor), boxes_(size_t(COLUMNS * ROWS)), light_(ROWS, COLUMNS)
	{
		const Place from = PlaceOf(part.x, part.y), to = PlaceOf(part.x + part.width - 1, part.y + part.height - 1);
		cv::parallel_for_(cv::Range(0, ROWS * COLUMNS), [&](const cv::Range& range)
		{
			for (int k = range.start; k < range.end; ++k)
			{
				if (k % COLUMNS < from.i || k % COLUMNS > to.i + 1 || k / COLUMNS < from.j || k / COLUMNS > to.j + 1)
					continue;
				const double u = (sensor_.width - 1.0) * (k % COLUMNS) / (COLUMNS - 1), v = (sensor_.height - 1.0) * (k / COLUMNS) / (ROWS - 1);
				boxes_[size_t(k)] = camera.Opening(u, v);
				light_(k / COLUMNS, k % COLUMNS) = boxes_[size_t(k)].Empty() ? 0 : Through(camera, u, v, boxes_[size_t(k)]);
			}
		});
	}

	static double Through(const Camera& camera, double u, double v, const Box& box)
	{
		const int n = 2048;
		double sum = 0;
		for (int k = 0; k < n; ++k)
			if (const std::optional<Hit> hit = camera.Trace(u, v, box.x0 + (box.x1 - box.x0) * Part(0.5, k, 0), box.y0 + (box.y1 - box.y0) * Part(0.5, k, 1)))
				sum += hit->weight;
		return sum / n * box.Area();
	}

	double At(double u, double v) const
	{
		const Place p = PlaceOf(u, v);
		const auto row = [&](int j) { return (1 - p.s) * light_(j, p.i) + p.s * light_(j, p.i + 1); };
		return (1 - p.t) * row(p.j) + p.t * row(p.j + 1);
	}

	/// Holds the openings of the four nodes around the pixel.
	Box BoxAt(double u, double v) const
	{
		const Place p = PlaceOf(u, v);
		Box all;
		for (const int k : { p.j * COLUMNS + p.i, p.j * COLUMNS + p.i + 1, (p.j + 1) * COLUMNS + p.i, (p.j + 1) * COLUMNS + p.i + 1 })
			if (const Box& box = boxes_[size_t(k)]; !box.Empty())
			{
				all.Add(box.x0, box.y0);
				all.Add(box.x1, box.y1);
			}
		return all;
	}

private:
	static constexpr int COLUMNS = 31, ROWS = 21;

	struct Place
	{
		int i, j;
		double s, t;
	};

	Place PlaceOf(double u, double v) const
	{
		const double x = u / (sensor_.width - 1) * (COLUMNS - 1), y = v / (sensor_.height - 1) * (ROWS - 1);
		const int i = std::min(COLUMNS - 2, int(x)), j = std::min(ROWS - 2, int(y));
		return { i, j, x - i, y - j };
	}

	Sensor sensor_;
	std::vector<Box> boxes_;
	cv::Mat_<double> light_;
};

/// Pixels that share their points of the pupil. From pixel to pixel of a tile the place on the board to which such a point sends a ray is
/// as good as a polynomial of second degree (its third-order rest is 1e-3 px): nine rays for all of them. Only where the rims cut between
/// the nine is every ray traced.
const int TILE = 12;

class Tile
{
public:
	Tile(const Camera& camera, const Light& light, int u, int v)
		: camera_(camera), u_(u), v_(v)
	{
		Box box;
		for (const double x : { u - 0.5, u + TILE - 0.5 })
			for (const double y : { v - 0.5, v + TILE - 0.5 })
				if (const Box corner = light.BoxAt(x, y); !corner.Empty())
				{
					box.Add(corner.x0, corner.y0);
					box.Add(corner.x1, corner.y1);
				}
		if (box.Empty())
			return;
		const int points = std::max(24, camera.scene().rays);
		// Begun elsewhere in every tile.
		const double start = u * 0.7548776662 + v * 0.5698402910;
		for (int k = 0; k < points; ++k)
			AddPoint(box.x0 + (box.x1 - box.x0) * Part(start * 1.7, k, 0), box.y0 + (box.y1 - box.y0) * Part(start * 2.3, k, 1));
	}

	/// Mean shade of what the pixel sees, by the rays' weights.
	double Shade(const Pattern& pattern, int u, int v) const
	{
		const double start = u * 0.7548776662 + v * 0.5698402910;
		double sum = 0, weights = 0;
		Eigen::AlignedBox2d seen;
		const int first = 24;
		for (size_t k = 0; k < points_.size(); ++k)
		{
			const std::optional<Hit> hit = At(points_[k], u + Part(start, int(k), 2) - 0.5, v + Part(start * 1.3, int(k), 3) - 0.5);
			if (!hit || !std::isfinite(hit->x))
				continue;
			sum += hit->weight * pattern.light(hit->x, hit->y);
			weights += hit->weight;
			seen.extend(Eigen::Vector2d(hit->x, hit->y));
			// What two dozen rays span, and as much again around it, is one shade: so is all.
			if (k == first - 1 && pattern.clearance && pattern.clearance(seen.center().x(), seen.center().y()) > 1.5 * seen.diagonal().norm())
				break;
		}
		return weights > 0 ? sum / weights : 0;
	}

private:
	struct Point
	{
		double x, y;
		bool smooth = true;          ///< all nine pass
		Hit nodes[9];
	};

	void AddPoint(double x, double y)
	{
		Point point{ x, y, true, {} };
		bool any = false;
		for (int n = 0; n < 9; ++n)
		{
			const std::optional<Hit> hit = camera_.Trace(u_ - 0.5 + 0.5 * TILE * (n % 3), v_ - 0.5 + 0.5 * TILE * (n / 3), x, y);
			any |= hit.has_value();
			point.smooth &= hit && std::isfinite(hit->x);
			if (hit)
				point.nodes[n] = *hit;
		}
		if (any)
			points_.push_back(point);
	}

	std::optional<Hit> At(const Point& point, double u, double v) const
	{
		if (!point.smooth)
			return camera_.Trace(u, v, point.x, point.y);
		const auto weights = [](double t, double* w)     // Lagrange's, at 0, 1 and 2
		{
			w[0] = 0.5 * (t - 1) * (t - 2);
			w[1] = t * (2 - t);
			w[2] = 0.5 * t * (t - 1);
		};
		double a[3], b[3];
		weights((u - u_ + 0.5) / (0.5 * TILE), a);
		weights((v - v_ + 0.5) / (0.5 * TILE), b);
		Hit hit{ 0, 0, 0 };
		for (int n = 0; n < 9; ++n)
		{
			const double w = a[n % 3] * b[n / 3];
			hit.weight += w * point.nodes[n].weight;
			hit.x += w * point.nodes[n].x;
			hit.y += w * point.nodes[n].y;
		}
		return hit;
	}

	const Camera& camera_;
	int u_, v_;
	std::vector<Point> points_;
};

float Recorded(const TracedScene& scene, double value, std::mt19937& random)
{
	std::normal_distribution<double> normal(0, std::max(scene.noise, 1e-12));
	const double v = std::min(1.0, value + normal(random));
	return scene.eight_bit ? ThroughSrgb(v) : float(v);
}

}

cv::Mat TakeTracedPicture(const TracedScene& scene, const Pattern& pattern)
{
	const Camera camera(scene, scene.state);
	const cv::Rect part = scene.part.area() > 0 ? scene.part : cv::Rect(0, 0, scene.sensor.width, scene.sensor.height);
	const Light light(camera, part);
	GlassState untilted = scene.state;
	untilted.tilt_deg = 0;
	const Camera middle(scene, untilted);
	const double u = 0.5 * (scene.sensor.width - 1), v = 0.5 * (scene.sensor.height - 1), unit = scene.exposure / Light::Through(middle, u, v, middle.Opening(u, v));
	cv::Mat picture(scene.sensor.height, scene.sensor.width, CV_32FC1, cv::Scalar(0));
	const int across = (part.width + TILE - 1) / TILE, down = (part.height + TILE - 1) / TILE;
	cv::parallel_for_(cv::Range(0, across * down), [&](const cv::Range& range)
	{
		for (int k = range.start; k < range.end; ++k)
		{
			const cv::Rect pixels = cv::Rect(part.x + k % across * TILE, part.y + k / across * TILE, TILE, TILE) & part;
			const Tile tile(camera, light, pixels.x, pixels.y);
			for (int y = pixels.y; y < pixels.y + pixels.height; ++y)
				for (int x = pixels.x; x < pixels.x + pixels.width; ++x)
					picture.at<float>(y, x) = float(unit * light.At(x, y) * tile.Shade(pattern, x, y));
		}
	});
	std::mt19937 random(scene.seed);
	for (int y = part.y; y < part.y + part.height; ++y)
		for (int x = part.x; x < part.x + part.width; ++x)
			picture.at<float>(y, x) = Recorded(scene, picture.at<float>(y, x), random);
	return picture;
}

Eigen::Vector2d TracedPixelOf(const TracedScene& scene, double x, double y)
{
	// Rays from the stop's centre both ways, as a direction in the stop's space maps to the sensor and to the board.
	const GlassFrame frame(scene.glass, scene.state);
	GlassState untilted = scene.state;
	untilted.tilt_deg = 0;
	const V pupil = GlassFrame(scene.glass, untilted).OnAxis(ParaxialOf(scene.glass).entrance_pupil);
	const Eigen::Vector3d board = scene.camera_from_board * Eigen::Vector3d(x, y, 0) + scene.origin;
	const V target = frame.ToGlass(V{ board.x(), -board.y(), board.z() } + pupil);
	// Of the ray through the stop's centre with these slopes: where it passes the target's height, and what reaches the sensor.
	Prescription front = scene.glass, rear = scene.glass;
	front.surfaces.resize(scene.glass.stop + 1);
	rear.surfaces.erase(rear.surfaces.begin(), rear.surfaces.begin() + long(scene.glass.stop));
	const double stop = scene.glass.StopHeight();
	const auto before = [&](const Eigen::Vector2d& slope)
	{
		Ray<double> ray{ { 0, 0, stop }, Normalized(V{ slope.x(), slope.y(), 1 }) };
		if (TraceToScene(front, ray, Rims::OPEN) != Fate::PASSED)
			throw std::runtime_error("no ray from the stop's centre reaches the point");
		const double along = (target.z - ray.point.z) / ray.direction.z;
		return Eigen::Vector2d(ray.point.x + along * ray.direction.x - target.x, ray.point.y + along * ray.direction.y - target.y);
	};
	Eigen::Vector2d slope(target.x / target.z, target.y / target.z);
	for (int k = 0; k < 20; ++k)
	{
		const double h = 1e-6;
		const Eigen::Vector2d off = before(slope);
		Eigen::Matrix2d J;
		J.col(0) = (before(slope + Eigen::Vector2d(h, 0)) - off) / h;
		J.col(1) = (before(slope + Eigen::Vector2d(0, h)) - off) / h;
		slope -= J.inverse() * off;
	}
	Ray<double> ray{ { 0, 0, 0 }, Normalized(V{ -slope.x(), -slope.y(), -1 }) };
	if (TraceToSensor(rear, ray, Rims::OPEN) != Fate::PASSED)
		throw std::runtime_error("no ray from the stop's centre reaches the sensor");
	ray.point.z += stop;
	const V point = frame.ToSensor(ray.point), direction = frame.DirectionToSensor(ray.direction);
	const double along = -point.z / direction.z;
	const std::array<double, 2> pixel = PixelOfSensorPoint(scene.sensor, point + along * direction);
	return { pixel[0], pixel[1] };
}

}
