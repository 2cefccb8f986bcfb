// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/real_lens_light.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// Fewer patches leave nothing over beside exposure and gradient.
const size_t FEWEST_PATCHES = 6;

struct RimInPlace
{
	int number, side;
	double factor_of_radius, factor_of_distance;   ///< of their units (real_lens::UnitsOfRim)
	double radius, distance, width;

	RimInPlace(const OpeningView& view, double opening, const double* rims, int k, int on_side)
		: number(k), side(on_side), factor_of_radius(std::exp(rims[real_lens::RIM_SIZE * k + real_lens::LOG_RADIUS])),
		  factor_of_distance(on_side * std::exp(rims[real_lens::RIM_SIZE * k + real_lens::LOG_DISTANCE]))
	{
		const real_lens::UnitsOfRim<double> unit(opening, view.lens.pupil_magnification, side);
		radius = unit.radius * factor_of_radius;
		distance = unit.distance * factor_of_distance;
		width = WidthAtRim(view, distance);
	}
};

class MovingRim
{
public:
	MovingRim(const MovingRays& rays, const RimInPlace& of) : rim(of), unit(rays.Opening(), rays.Mounted().lens.pupil_magnification, of.side) {}

	/// Of PartWithin, where a rim cuts the point.
	ByLight PartBy(const MovingRay& ray) const
	{
		const tilt_lens::PupilRay<double>& seen = rim.side > 0 ? ray.object : ray.image;
		const double x = seen.x + rim.distance * seen.slope_x, y = seen.y + rim.distance * seen.slope_y, height = std::hypot(x, y);
		const Eigen::Vector4d by_ray(x / height, y / height, rim.distance * x / height, rim.distance * y / height);
		const double by_distance = (x * seen.slope_x + y * seen.slope_y) / height;
		ByLight by = ByLight::Zero();
		if (rim.side > 0)
			by.head<RAY_NUMBERS>() = -ray.object_by.transpose() * by_ray;
		else
			by.head<PLACE_NUMBERS>() = -ray.image_by.transpose() * by_ray;
		by.head<PLACE_NUMBERS>() += rim.factor_of_radius * unit.radius.v - by_distance * rim.factor_of_distance * unit.distance.v;
		const int at = RAY_NUMBERS + real_lens::RIM_SIZE * rim.number;
		by[at + real_lens::LOG_RADIUS] = rim.radius;
		by[at + real_lens::LOG_DISTANCE] = -by_distance * rim.distance;
		return by / rim.width;
	}

private:
	const RimInPlace& rim;
	real_lens::UnitsOfRim<PlaceJet> unit;
};

void Add(const std::vector<BrightPatch>& patches, const Board* board, RealLensExposure& exposure)
{
	for (const BrightPatch& p : patches)
		// Beyond the lens's image circle there is no light, and no logarithm.
		if (p.value > 0)
			exposure.light.patches.push_back({ p.u, p.v, { board ? 2 * p.board_column / board->columns - 1 : 0, board ? 2 * p.board_row / board->rows - 1 : 0 }, std::log(p.value), p.sigma / p.value, 1 });
}

}

double LogLightThroughRims(const MountedLens<double>& mounted, double opening, const double* rims, const RimSides& sides, const MovingRays* moving, ByLight* by)
{
	const double radius = opening * mounted.lens.pupil_magnification;
	const OpeningView view{ mounted.lens, radius, mounted.x, mounted.y, mounted.depth };
	std::vector<RimInPlace> in_place;
	for (size_t i = 0; i < sides.size(); ++i)
		in_place.emplace_back(view, opening, rims, int(i), sides[i]);
	std::vector<MovingRim> in_motion;
	for (size_t i = 0; moving && i < sides.size(); ++i)
		in_motion.emplace_back(*moving, in_place[i]);
	double open = 0;
	ByLight by_open = ByLight::Zero();
	for (const auto& [x, y] : OpeningCover())
	{
		const double share = LightOfPoint(view, x, y) / COVER;
		const tilt_lens::PupilRay<double> image = tilt_lens::RayToSensor(radius * x, radius * y, view.X, view.Y, view.depth), object = tilt_lens::ObjectSideRay(view.lens, image);
		double part[real_lens::MOST_RIMS], whole = share;
		bool near_a_rim = false;
		for (size_t i = 0; i < sides.size(); ++i)
		{
			part[i] = PartWithin(HeightAtRim(object, image, in_place[i].distance), in_place[i].radius, in_place[i].width);
			near_a_rim |= part[i] > 0 && part[i] < 1;
			whole *= part[i];
		}
		open += whole;
		// Only these know of the rims.
		if (!moving || !near_a_rim || whole == 0)
			continue;
		const MovingRay ray = moving->Through(x, y);
		for (size_t i = 0; i < sides.size(); ++i)
			if (part[i] < 1)
				by_open += whole / part[i] * in_motion[i].PartBy(ray);
	}
	// The whole opening sends what its middle does, to the fourth order; the shares hold the rest.
	const double least = 1e-3, squared = mounted.x * mounted.x + mounted.y * mounted.y + mounted.depth * mounted.depth;
	if (moving)
	{
		const MountedLens<PlaceJet>& m = moving->Mounted();
		const PlaceJet s = m.x * m.x + m.y * m.y + m.depth * m.depth;
		*by = open > least ? ByLight(by_open / open) : ByLight::Zero();
		by->head<PLACE_NUMBERS>() += log(m.depth * m.w_mm / (s * s)).v;
	}
	return std::log(mounted.depth * mounted.w_mm / (squared * squared)) + std::log(std::max(open, least));
}

Eigen::VectorXd RealLensPatches::See(const double* state, const double* lens, const double* c, const double* rims, const double* gradient, Eigen::MatrixXd* by) const
{
	Eigen::VectorXd seen{ Eigen::Index(patches.size()) };
	if (by)
		by->resize(seen.size(), LIGHT_NUMBERS);
	for (size_t i = 0; i < patches.size(); ++i)
	{
		const Patch& p = patches[i];
		const MountedLens<double> mounted(state, lens, c, r, pitch_mm, p.u, p.v);
		std::optional<MovingRays> moving;
		ByLight row;
		if (by)
			moving.emplace(state, lens, c, r, pitch_mm, p.u, p.v);
		seen[Eigen::Index(i)] = LogLightThroughRims(mounted, r * lens[real_lens::OPENING], rims, sides, moving ? &*moving : nullptr, &row) + gradient[0] * p.place[0] + gradient[1] * p.place[1] - p.log_value;
		if (by)
			by->row(Eigen::Index(i)) = row;
	}
	return seen;
}

RealLensLightCost::RealLensLightCost(const RealLensPatches& patches) : light(patches)
{
	set_num_residuals(int(light.patches.size()));
	*mutable_parameter_block_sizes() = { real_lens::STATE_SIZE, real_lens::LENS_SIZE, tilt_lens::AberrationTerms, real_lens::RIMS_SIZE, 2 };
}

bool RealLensLightCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const
{
	const auto n = Eigen::Index(light.patches.size());
	Eigen::MatrixXd by;
	Eigen::VectorXd weight(n);
	Eigen::Map<Eigen::VectorXd> r(residuals, n);
	r = light.See(parameters[0], parameters[1], parameters[2], parameters[3], parameters[4], jacobians ? &by : nullptr);
	for (Eigen::Index i = 0; i < n; ++i)
		weight[i] = light.patches[size_t(i)].weight;
	r.array() *= weight.array();
	r -= light.basis * (light.basis.transpose() * r);
	// Beyond `most` as the square root of Huber's cost.
	const double most = 3;
	Eigen::VectorXd slope = Eigen::VectorXd::Ones(n);
	for (Eigen::Index i = 0; i < n; ++i)
		if (const double size = std::abs(r[i]); size > most)
		{
			r[i] = std::copysign(std::sqrt(2 * most * size - most * most), r[i]);
			slope[i] = most / std::abs(r[i]);
		}
	if (!jacobians)
		return true;
	Eigen::MatrixXd all(n, LIGHT_NUMBERS + 2);
	all.leftCols(LIGHT_NUMBERS) = by;
	for (Eigen::Index i = 0; i < n; ++i)
		all.row(i).tail<2>() << light.patches[size_t(i)].place[0], light.patches[size_t(i)].place[1];
	all = weight.asDiagonal() * all;
	all -= light.basis * (light.basis.transpose() * all);
	all = slope.asDiagonal() * all;
	Eigen::Index at = 0;
	for (size_t block = 0; block < parameter_block_sizes().size(); ++block)
	{
		const int size = parameter_block_sizes()[block];
		if (jacobians[block])
			Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(jacobians[block], n, size) = all.middleCols(at, size);
		at += size;
	}
	return true;
}

std::vector<RealLensExposure> ExposuresOf(const Task& task, bool shared_poses, double r, const RimSides& sides)
{
	std::vector<RealLensExposure> all;
	const RealLensPatches blank{ {}, {}, r, task.pitch_mm, sides };
	for (const FlatField& field : task.flat_fields)
	{
		all.push_back({ field.state, std::nullopt, false, blank });
		Add(field.patches, nullptr, all.back());
	}
	for (size_t s = 0; task.flat_fields.empty() && s < task.states.size(); ++s)
		for (size_t p = 0; p < task.states[s].photos.size(); ++p)
			if (const std::vector<BrightPatch>& white = task.states[s].photos[p].white; white.size() >= FEWEST_PATCHES)
			{
				all.push_back({ s, p, shared_poses, blank, task.states[s].photos[p].stop });
				Add(white, &task.board, all.back());
			}
	// A gradient that one photograph alone shows is its own: left out with it nothing would tell it.
	for (RealLensExposure& exposure : all)
		exposure.lit_alike = exposure.lit_alike && std::count_if(all.begin(), all.end(), [&](const RealLensExposure& other) { return other.photo == exposure.photo; }) > 1;
	return all;
}

void Weigh(double error, RealLensExposure& exposure)
{
	std::vector<RealLensPatches::Patch>& patches = exposure.light.patches;
	const bool own_gradient = exposure.photo && !exposure.lit_alike;
	Eigen::MatrixXd columns(long(patches.size()), own_gradient ? 3 : 1);
	for (size_t i = 0; i < patches.size(); ++i)
	{
		RealLensPatches::Patch& p = patches[i];
		p.weight = 1 / std::hypot(p.sigma, error);
		columns(long(i), 0) = p.weight;
		for (int k = 0; own_gradient && k < 2; ++k)
			columns(long(i), 1 + k) = p.weight * p.place[k];
	}
	const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
	exposure.light.basis = qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
}

}
