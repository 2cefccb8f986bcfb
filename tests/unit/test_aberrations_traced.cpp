// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The numbers of a real lens against two oracles that share no code with them or with each other: Seidel's sums, and rays traced through
// the lens's spheres by Snell's law (support/sphere_tracer.h), in long double.

#include <cmath>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include "lens/aberrations.h"
#include "support/sphere_tracer.h"

using namespace tilt_lens;
using namespace sphere_tracer;

namespace
{

/// The thick biconvex lens of Hecht, "Optics", 6.1: radii 20 and 40 cm, 1 cm of glass of 1.5; f = 26.8 cm. A stop before or behind it.
std::vector<Surface> Hecht()
{
	return { { 1 / 20.0L, 1, 1.5L }, { -1 / 40.0L, 0, 1 } };
}

struct StoppedLens
{
	const char* name;
	std::vector<Surface> surfaces;
	size_t stop;
};

std::vector<StoppedLens> Lenses()
{
	StoppedLens behind = { "stop behind", Hecht(), 2 }, before = { "stop before", Hecht(), 0 };
	behind.surfaces[1].thickness = 4;
	behind.surfaces.push_back({ 0, 0, 1 });
	before.surfaces.insert(before.surfaces.begin(), { 0, 3, 1 });
	return { behind, before };
}

/// A lens with its linear part from paraxial rays, and its numbers from Seidel's sums of an object at infinity: there a pixel
/// of Gauss's image plane sees the slope b0 through every point of the pupil, and b - b0 = (b0 g_R + 2 q g_Q) / r is minus the gradient by q of
/// the wave aberration W (in units of r), W = I/8 Q^2 + II/2 .. in Hopkins's notation with the field b / B.
RealLens<Real> LensOfSums(const StoppedLens& lens, const Cardinal& cardinal, Real radius)
{
	const Real B = 0.3L;        // of the chief ray; cancels
	const Seidel S = SeidelSums(TraceParaxial(lens.surfaces, { radius, 0 }), TraceParaxial(lens.surfaces, { cardinal.entrance_pupil * B, -B }));
	RealLens<Real> real = { cardinal.pupil_magnification, 1 / cardinal.focal_length, { {}, radius }, true };
	real.aberrations.c[Spherical] = -S.I / 8;
	real.aberrations.c[Coma] = -S.II / (2 * B);
	real.aberrations.c[Astigmatism] = -S.III / (2 * B * B);
	real.aberrations.c[Curvature] = -(S.III + S.IV) / (4 * B * B);
	real.aberrations.c[Distortion] = -S.V / (2 * B * B * B);
	return real;
}

/// Slopes, on the object side, towards the scene: X = S + Z b.
struct Pair
{
	PupilRay<Real> object, image;
};

/// The ray that has the slopes b and the point S of the entrance pupil, traced to the exit pupil.
Pair TracePair(const StoppedLens& lens, const Cardinal& cardinal, Real S_x, Real S_y, Real b_x, Real b_y)
{
	// From well before the lens; Z points against the light.
	const Real start = 50;
	const Real length = std::sqrt(b_x * b_x + b_y * b_y + 1);
	Ray ray = { S_x + (start + cardinal.entrance_pupil) * b_x, S_y + (start + cardinal.entrance_pupil) * b_y, -start, -b_x / length, -b_y / length, 1 / length };
	EXPECT_TRUE(Trace(lens.surfaces, ray));
	const Real u = ray.dx / ray.dz, v = ray.dy / ray.dz, t = cardinal.exit_pupil - ray.z;
	return { { S_x, S_y, b_x, b_y }, { ray.x + t * u, ray.y + t * v, -u, -v } };
}

/// The aberration of the slope as it is: b - b0, and by the map.
struct SlopeErrors
{
	Real x, y, map_x, map_y;
};

SlopeErrors Errors(const StoppedLens& stopped, const Cardinal& cardinal, const RealLens<Real>& lens, Real S_x, Real S_y, Real b_x, Real b_y)
{
	const Pair pair = TracePair(stopped, cardinal, S_x, S_y, b_x, b_y);
	const PupilRay<Real> linear = BeforeLinearLens(lens.pupil_magnification, lens.power, pair.image), map = ObjectSideRay(lens, pair.image);
	return { b_x - linear.slope_x, b_y - linear.slope_y, map.slope_x - linear.slope_x, map.slope_y - linear.slope_y };
}

}

TEST(TracedLens, TheOracleHasThePublishedFocalLength)
{
	EXPECT_NEAR(double(CardinalOf(Lenses()[0].surfaces, 2).focal_length), 26.8, 0.05) << "as printed";
	for(const StoppedLens& lens : Lenses())
	{
		// A ray near the axis crosses it in the focus, and the chief ray goes through the middles of both pupils.
		const Cardinal c = CardinalOf(lens.surfaces, lens.stop);
		const Real S = 1e-4L, b = 1e-4L;
		const Pair along = TracePair(lens, c, S, 0, 0, 0), chief = TracePair(lens, c, 0, 0, b, 0);
		EXPECT_NEAR(double(along.image.x / S), double(c.pupil_magnification), 1e-8) << lens.name;
		EXPECT_NEAR(double(along.image.slope_x / S), double(1 / c.focal_length), 1e-8) << lens.name;
		EXPECT_NEAR(double(chief.image.x / b), 0, 1e-7) << lens.name;
		EXPECT_NEAR(double(chief.image.slope_x / b), double(1 / c.pupil_magnification), 1e-8) << lens.name;
	}
}

// Rays chosen so that each of the five stands alone, or beside those before it: halving pupil and field brings traced and map's
// aberration together by the square of the scale, for what differs is of the fifth order.
TEST(TracedLens, SeidelsFiveOneByOne)
{
	const Real r = 2, B = 0.2L;
	const struct { const char* name; AberrationTerm term; Real q_x, q_y, b; } cases[] =
	{
		{ "spherical", Spherical, 1, 0, 0 },
		{ "coma", Coma, 0, 1, 1 },
		{ "astigmatism", Astigmatism, 1, 0, 1 },
		{ "curvature", Curvature, 0, 1, 1 },
		{ "distortion", Distortion, 0, 0, 1 }
	};
	for(const StoppedLens& stopped : Lenses())
	{
		const Cardinal cardinal = CardinalOf(stopped.surfaces, stopped.stop);
		const RealLens<Real> lens = LensOfSums(stopped, cardinal, r);
		for(const auto& c : cases)
		{
			// What the number alone contributes, from rays with both signs of q and b: coma is odd in b and even in q, astigmatism
			// and curvature are even in b and odd in q.
			const auto part = [&](Real scale, bool map)
			{
				const Real q_x = scale * r * c.q_x, q_y = scale * r * c.q_y, b = scale * B * c.b;
				const auto at = [&](Real s, Real t)
				{
					const SlopeErrors e = Errors(stopped, cardinal, lens, s * q_x, s * q_y, t * b, 0);
					return map ? Pair{ { 0, 0, e.map_x, e.map_y }, {} } : Pair{ { 0, 0, e.x, e.y }, {} };
				};
				if(c.term == Spherical)
					return at(1, 0).object.slope_x;
				if(c.term == Distortion)
					return at(0, 1).object.slope_x;
				if(c.term == Coma)      // b_x c Q: even in q, less the part without q, which is distortion
					return (at(1, 1).object.slope_x + at(-1, 1).object.slope_x) / 2 - at(0, 1).object.slope_x;
				if(c.term == Curvature) // across: 2 q_y c P, odd in q, less the part without b, which is spherical
					return (at(1, 1).object.slope_y - at(-1, 1).object.slope_y) / 2 - at(1, 0).object.slope_y;
				// Along: 2 q (curvature + astigmatism) P, less the same without b.
				return (at(1, 1).object.slope_x - at(-1, 1).object.slope_x) / 2 - at(1, 0).object.slope_x;
			};
			// By the formulas of MODEL.md.
			const Real* n = lens.aberrations.c;
			const Real formula = c.term == Spherical ? 4 * n[Spherical] / r : c.term == Distortion ? n[Distortion] * B * B * B / r :
			                     c.term == Coma ? n[Coma] * B / r : c.term == Curvature ? 2 * n[Curvature] * B * B / r :
			                     2 * (n[Curvature] + n[Astigmatism]) * B * B / r;
			const Real scale = 0.01L, cubed = scale * scale * scale;
			const Real traced = part(scale, false) / cubed, half = part(scale / 2, false) / cubed * 8;
			// Extrapolated to no aperture and no field: fourth powers of the scale are left, 1e-8 of some ones.
			const Real limit = half + (half - traced) / 3;
			EXPECT_NEAR(double(limit / formula), 1, 1e-6) << stopped.name << ", " << c.name;
			EXPECT_NEAR(double(part(scale, true) / cubed / formula), 1, 0.01) << stopped.name << ", " << c.name << ": of the map itself";
			EXPECT_GT(double(std::fabs(formula)), 1e-6) << c.name << " is there at all";
		}
	}
}

// The same for any ray: what the five leave is of the fifth order, and without any of them it is of the third.
TEST(TracedLens, WhatTheFiveLeaveIsOfTheFifthOrder)
{
	for(const StoppedLens& stopped : Lenses())
	{
		const Cardinal cardinal = CardinalOf(stopped.surfaces, stopped.stop);
		const RealLens<Real> lens = LensOfSums(stopped, cardinal, 2);
		const auto left = [&](const RealLens<Real>& by, Real scale)
		{
			const SlopeErrors e = Errors(stopped, cardinal, by, scale * 1.1L, scale * 0.7L, scale * 0.15L, scale * -0.1L);
			return std::hypot(e.x - e.map_x, e.y - e.map_y);
		};
		EXPECT_NEAR(double(left(lens, 0.1L) / left(lens, 0.05L)), 32, 0.5) << stopped.name;
		for(int term = Spherical; term <= Distortion; term++)
		{
			RealLens<Real> without = lens;
			without.aberrations.c[term] = 0;
			EXPECT_NEAR(double(left(without, 0.1L) / left(without, 0.05L)), 8, 1) << stopped.name << ", " << term;
		}
	}
}

// Where rays meet the entrance pupil, by Seidel's five and the etendue together. What is left of S is what no image shows, how the pupil itself wanders: P^2, one number;
// with the one that a single ray tells, all others agree but for the fifth order. Without the etendue, or without distortion, the third is left.
TEST(TracedLens, PointsOfThePupilAreTheGlassesToo)
{
	for(const StoppedLens& stopped : Lenses())
	{
		const Cardinal cardinal = CardinalOf(stopped.surfaces, stopped.stop);
		EXPECT_GT(std::fabs(double(cardinal.pupil_magnification - 1)), 0.05) << "or little is shown";
		RealLens<Real> lens = LensOfSums(stopped, cardinal, 2);
		// How far the map's S is from the traced ray's.
		const auto off = [&](const RealLens<Real>& by, Real S_x, Real S_y, Real b_x, Real b_y)
		{
			const PupilRay<Real> map = ObjectSideRay(by, TracePair(stopped, cardinal, S_x, S_y, b_x, b_y).image);
			return Across<Real>{ map.x - S_x, map.y - S_y };
		};
		const Real b = 0.001L;
		lens.aberrations.c[PupilAberration] = off(lens, 0, 0, b, 0).x / (4 * b * b * b);
		const auto left = [&](const RealLens<Real>& by, Real scale)
		{
			const Across<Real> e = off(by, scale * 1.1L, scale * 0.7L, scale * 0.15L, scale * -0.1L);
			return std::sqrt(Dot(e, e));
		};
		EXPECT_NEAR(double(left(lens, 0.1L) / left(lens, 0.05L)), 32, 0.5) << stopped.name;
		RealLens<Real> thin = lens, straight = lens;
		thin.etendue = false;
		straight.aberrations.c[Distortion] = 0;
		EXPECT_NEAR(double(left(thin, 0.1L) / left(thin, 0.05L)), 8, 1) << stopped.name;
		EXPECT_NEAR(double(left(straight, 0.1L) / left(straight, 0.05L)), 8, 1) << stopped.name;
	}
}

// A double Gauss: the example of REFERENCE.md. US patent 2,673,491 (Tronnier), 50 mm, whose focal length is printed as 50.358.
TEST(TracedLens, NumbersOfADoubleGauss)
{
	StoppedLens lens = { "double Gauss", {}, 5 };
	const Real table[][3] = { { 29.475L, 3.760L, 1.670L }, { 84.830L, 0.120L, 1 }, { 19.275L, 4.025L, 1.670L }, { 40.770L, 3.275L, 1.699L }, { 12.750L, 5.705L, 1 },
		{ 0, 4.500L, 1 }, { -14.495L, 1.180L, 1.603L }, { 40.770L, 6.065L, 1.658L }, { -20.385L, 0.190L, 1 }, { 437.065L, 3.220L, 1.717L }, { -39.730L, 0, 1 } };
	for(const auto& row : table)
		lens.surfaces.push_back({ row[0] != 0 ? 1 / row[0] : 0, row[1], row[2] });
	const Cardinal cardinal = CardinalOf(lens.surfaces, lens.stop);
	EXPECT_NEAR(double(cardinal.focal_length), 50.358, 0.0006) << "as printed";
	const RealLens<Real> real = LensOfSums(lens, cardinal, cardinal.focal_length / 5.6L);
	const double wanted[] = { -0.03, -0.04, 0.61, -0.97, 12.16 };
	for(int i = Spherical; i <= Distortion; i++)
	{
		const double number = double(1000 * real.aberrations.c[i] / cardinal.focal_length);
		std::printf("%d: %.3f\n", i, number);
		EXPECT_NEAR(number, wanted[i], 0.0051) << "as REFERENCE.md has it, rounded";
	}
}
