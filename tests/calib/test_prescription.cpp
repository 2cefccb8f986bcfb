// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Prescriptions: the table, what it does near the axis, real rays.

#include "prescription/mount.h"
#include "prescription/paraxial.h"
#include "prescription/prescription.h"
#include "prescription/trace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiltcal/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace
{

using namespace tiltcal;


/// A lens of two surfaces in air, its stop at the first vertex, without rims.
Prescription Singlet(double r1, double r2, double thickness, double index, double stop_radius = 1)
{
	Prescription lens;
	lens.file = "singlet";
	lens.surfaces = { { 0, 0, 1, 0, stop_radius }, { 1 / r1, thickness, index, 0, 0 }, { 1 / r2, 0, 1, 0, 0 } };
	return lens;
}

Prescription Gauss45()
{
	const Prescription printed = ReadPrescription(DOUBLE_GAUSS);
	return StoppedTo(printed.Scaled(45 / ParaxialOf(printed).focal_length), 2.8);
}

// --- near the axis -----------------------------------------------------------------------------------------------------------

TEST(Paraxial, ThickLensOfTheTextbook)
{
	// Hecht, Optics, the thick lens: radii 20 and -40 cm, 1 cm of index 1.5: f 26.8 cm, principal planes 0.22 and -0.44 cm from the vertices.
	const Paraxial p = ParaxialOf(Singlet(200, -400, 10, 1.5));
	EXPECT_NEAR(p.focal_length, 268, 0.5);
	EXPECT_NEAR(p.front_principal, -2.2, 0.05);
	EXPECT_NEAR(p.rear_principal - p.last_vertex, 4.4, 0.1);
	// And to the last digits by the closed formula.
	const double power = 0.5 * (1 / 200. + 1 / 400. - 0.5 * 10 / (1.5 * 200 * 400));
	EXPECT_NEAR(p.focal_length * power, 1, 1e-15);
	EXPECT_NEAR(p.back_focus, (1 - 0.5 * 10 / (1.5 * 200)) / power, 1e-12);
}

TEST(Paraxial, BallLens)
{
	// f = n D / (4 (n - 1)), both principal planes at the centre.
	const Paraxial p = ParaxialOf(Singlet(5, -5, 10, 1.6));
	EXPECT_NEAR(p.focal_length, 1.6 * 10 / 2.4, 1e-14);
	EXPECT_NEAR(p.front_principal, -5, 1e-14);
	EXPECT_NEAR(p.rear_principal, -5, 1e-14);
}

TEST(Paraxial, PublishedFocalLengths)
{
	// As printed to three decimals.
	EXPECT_NEAR(ParaxialOf(ReadPrescription(DOUBLE_GAUSS)).focal_length, 50.358, 0.0005);
	// Published as 50.000, for indices of more digits than these.
	EXPECT_NEAR(ParaxialOf(ReadPrescription(COOKE_TRIPLET)).focal_length, 50, 0.001);
}

TEST(Paraxial, PhotographsTruth)
{
	// truth.json of the photographs through this glass, ten digits, by a program that shares nothing with this one.
	const Prescription lens = Gauss45();
	const Paraxial p = ParaxialOf(lens);
	const double first = 64.32397435, digits = 2e-8;
	EXPECT_NEAR(p.focal_length, 45, 1e-12);
	EXPECT_NEAR(2 * p.entrance_radius, 16.07142857, digits);
	EXPECT_NEAR(2 * lens.StopRadius(), 11.07922888, digits);
	EXPECT_NEAR(2 * p.entrance_radius * p.pupil_magnification, 17.19452116, digits);
	EXPECT_NEAR(p.back_focus, 32.26419534, digits);
	EXPECT_NEAR(first + lens.StopHeight(), 49.2355578, digits);
	EXPECT_NEAR(first + p.entrance_pupil, 46.49982043, digits);
	EXPECT_NEAR(first + p.exit_pupil, 51.57353116, digits);
	EXPECT_NEAR(first + p.front_principal, 43.56056052, digits);
	EXPECT_NEAR(first + p.rear_principal, 48.42887191, digits);
	// Gaussian: the sensor before it was moved to the least blur, with the magnification that it has there.
	const double image = p.ImageDistance(618);
	EXPECT_NEAR(image - 0.0871238588, 51.57353116, 1e-7);
	EXPECT_NEAR(image / p.pupil_magnification / 618, 0.07813323927, 1e-10);
	EXPECT_NEAR(p.ObjectDistance(image), 618, 1e-9);
	// The least blur: which rays stand for the disc is theirs, to a hundredth of the move of 0.087 mm.
	EXPECT_NEAR(FocusedBackDistance(lens, p, 618), 35.69306725, 0.001);
	// Tilted about the stop: where the entrance pupil goes.
	const GlassFrame frame(lens, { "plus5", 5, 0, 35.69306725, lens.StopHeight() });
	const Vec3<double> pupil = frame.OnAxis(p.entrance_pupil);
	EXPECT_NEAR(pupil.y, 0.2384352224, digits);     // y up; truth.json's is down
	EXPECT_NEAR(pupil.z - 46.49982043, 0.01041030663, digits);
}

TEST(Paraxial, ScalesAndTurnsAround)
{
	const Prescription lens = Gauss45(), twice = lens.Scaled(2);
	const Paraxial p = ParaxialOf(lens), q = ParaxialOf(twice);
	EXPECT_NEAR(q.focal_length, 2 * p.focal_length, 1e-12);
	EXPECT_NEAR(q.exit_pupil, 2 * p.exit_pupil, 1e-12);
	EXPECT_NEAR(q.pupil_magnification, p.pupil_magnification, 1e-14);
	// Front and rear changed over, in air on both sides: the same focal length, the pupils' parts changed.
	Prescription turned = lens;
	std::reverse(turned.surfaces.begin(), turned.surfaces.end());
	for (size_t k = 0; k < turned.surfaces.size(); ++k)
	{
		const size_t was = lens.surfaces.size() - 1 - k;
		turned.surfaces[k].curvature *= -1;
		turned.surfaces[k].index = lens.IndexBefore(was);
		turned.surfaces[k].distance = was ? lens.surfaces[was - 1].distance : 0;
	}
	turned.stop = lens.surfaces.size() - 1 - lens.stop;
	const Paraxial t = ParaxialOf(turned);
	EXPECT_NEAR(t.focal_length, p.focal_length, 1e-12);
	EXPECT_NEAR(t.pupil_magnification * p.pupil_magnification, 1, 1e-13);
	EXPECT_NEAR(t.entrance_pupil, p.last_vertex - p.exit_pupil, 1e-12);
}

TEST(Paraxial, RefusesWhatHasNoFocus)
{
	// Two confocal lenses: light that comes parallel leaves parallel.
	EXPECT_THROW(ParaxialOf(Singlet(1e300, -1e300, 1, 1.5)), Error);
	EXPECT_THROW(StoppedTo(ReadPrescription(DOUBLE_GAUSS), 1.4), Error);
}

// --- real rays -----------------------------------------------------------------------------------------------------------------

template<typename T>
Ray<T> RayFrom(T x, T y, T z, T u, T v)
{
	return { { x, y, z }, Normalized(Vec3<T>{ u, v, T(-1) }) };
}

TEST(Trace, AplanaticMeniscusIsSharpForEveryRay)
{
	// Light that runs towards the point n R behind the centre of a sphere of radius R goes to the point R / n, exactly, at any opening
	// (Young, Weierstrass); the second surface is centred there and bends nothing.
	using Number = long double;
	const double n = 2, R = 2, thickness = 1;       // all that follows is exact in binary
	const Vec3<Number> aim{ 0, 0, -6 }, sharp{ 0, 0, -3 };
	Prescription lens = Singlet(R, 2, thickness, n, 0);
	for (const Number slope : { 0.01L, 0.2L, 0.4L, 0.5L })      // sin u < 1 / n
	{
		Ray<Number> ray{ { 7 * slope, 0, 1 }, {} };
		ray.direction = Normalized(aim - ray.point);
		const Number before = ray.direction.x;
		ASSERT_EQ(TraceToSensor(lens, ray), Fate::PASSED);
		const Vec3<Number> off = Cross(ray.direction, sharp - ray.point);
		EXPECT_LT(double(Length(off)), 1e-17) << double(slope);
		// Abbe's sine condition: sines grow by n at every opening.
		EXPECT_NEAR(double(ray.direction.x / before), n, 1e-17);
	}
}

TEST(Trace, SnellInAnglesAndSkewInvariant)
{
	std::mt19937 random(7);
	std::uniform_real_distribution<double> number(-1, 1);
	int refracted = 0, reflected = 0;
	for (int k = 0; k < 20000; ++k)
	{
		const Vec3<double> normal = Normalized(Vec3<double>{ number(random), number(random), number(random) });
		const Vec3<double> before = Normalized(Vec3<double>{ number(random), number(random), number(random) });
		const double from = 1.5 + 0.5 * number(random), into = 1.5 + 0.5 * number(random);
		Vec3<double> behind = before;
		const double sine = Length(Cross(normal, before)) * from / into;
		if (!Refract(normal, from, into, behind))
		{
			EXPECT_GT(sine, 1 - 1e-12);
			++reflected;
			continue;
		}
		++refracted;
		EXPECT_NEAR(Length(behind), 1, 1e-14);
		// Vector form of the law, with its plane of incidence; the sense along the normal is kept.
		const Vec3<double> difference = from * Cross(normal, before) - into * Cross(normal, behind);
		EXPECT_LT(Length(difference), 1e-14);
		EXPECT_GE(Dot(normal, before) * Dot(normal, behind), -1e-15);
	}
	EXPECT_GT(refracted, 10000);
	EXPECT_GT(reflected, 1000);
}

TEST(Trace, GoesTheSameWayBackAndKeepsTheSkewInvariant)
{
	const Prescription lens = Gauss45();
	std::mt19937 random(3);
	std::uniform_real_distribution<double> number(-1, 1);
	int passed = 0, blocked = 0;
	for (int k = 0; k < 5000; ++k)
	{
		const Ray<double> start = RayFrom(14 * number(random), 14 * number(random), 5.0, 0.4 * number(random), 0.4 * number(random));
		Ray<double> ray = start;
		const Fate fate = TraceToSensor(lens, ray);
		passed += fate == Fate::PASSED;
		blocked += fate == Fate::BLOCKED;
		if (fate != Fate::PASSED)
			continue;
		EXPECT_NEAR(Length(ray.direction), 1, 1e-14);
		// n (x d_y - y d_x) is kept by every surface of revolution.
		EXPECT_NEAR(ray.point.x * ray.direction.y - ray.point.y * ray.direction.x, start.point.x * start.direction.y - start.point.y * start.direction.x, 1e-13);
		ray.direction = -1.0 * ray.direction;
		ASSERT_EQ(TraceToScene(lens, ray), Fate::PASSED);
		const double along = (start.point.z - ray.point.z) / ray.direction.z;
		EXPECT_LT(Length(ray.point + along * ray.direction - start.point), 1e-12);
		EXPECT_LT(Length(ray.direction + start.direction), 1e-13);
	}
	EXPECT_GT(passed, 300);
	EXPECT_GT(blocked, 1000);
}

TEST(Trace, NearTheAxisItIsTheMatrix)
{
	using Number = long double;
	const Prescription lens = Gauss45();
	const Paraxial p = ParaxialOf(lens);
	const Number y = 1e-6L;
	Ray<Number> ray = RayFrom<Number>(y, 0, 1, 0, 0);
	ASSERT_EQ(TraceToSensor(lens, ray), Fate::PASSED);
	const Number slope = ray.direction.x / ray.direction.z, crossing = ray.point.z - ray.point.x / slope;
	// What is left over is of order (y / f)^2 = 5e-16, and what long double loses of a height of 1e-6.
	EXPECT_NEAR(double(y / slope), p.focal_length, 1e-11);
	EXPECT_NEAR(double(static_cast<Number>(p.last_vertex) - crossing), p.back_focus, 1e-11);
}

TEST(Trace, SaysWhatBecameOfARay)
{
	const Prescription bare = Singlet(5, -5, 10, 1.6, 0), rimmed = Singlet(5, -5, 10, 1.6, 1);
	Ray<double> ray = RayFrom(6., 0., 1., 0., 0.);
	EXPECT_EQ(TraceToSensor(bare, ray), Fate::MISSED);
	ray = RayFrom(2., 0., 1., 0., 0.);
	EXPECT_EQ(TraceToSensor(rimmed, ray), Fate::BLOCKED);
	ray = RayFrom(2., 0., 1., 0., 0.);
	EXPECT_EQ(TraceToSensor(rimmed, ray, Rims::OPEN), Fate::PASSED);
	// Out of a flat rear at 60 degrees within the glass.
	Prescription hemisphere = Singlet(5, 1, 5, 1.6, 0);
	hemisphere.surfaces[2].curvature = 0;
	ray.direction = Vec3<double>{ std::sin(M_PI / 3), 0, -std::cos(M_PI / 3) };    // to the sphere's centre: not bent there
	ray.point = Vec3<double>{ 0, 0, -5 } - 8.0 * ray.direction;
	EXPECT_EQ(TraceToSensor(hemisphere, ray), Fate::REFLECTED);
	// Not a number is no ray.
	ray = RayFrom(std::numeric_limits<double>::quiet_NaN(), 0., 1., 0., 0.);
	EXPECT_EQ(TraceToSensor(bare, ray), Fate::MISSED);
}

// --- the table -----------------------------------------------------------------------------------------------------------------

TEST(ParsePrescription, ReadsWhatPatentsPrint)
{
	const char* const plain = "29.475 3.76 1.67 25.2\n0 4.5 1.0 17.1\n-39.73 0 1 20\n";
	// Its stop is in glass: refused. In air:
	EXPECT_THROW(ParsePrescription(plain, "p"), Error);
	const Prescription a = ParsePrescription("29.475 3.76 1.67 25.2\n84 0.1\n0 4.5 1.0 17.1\n-39.73 0 1.5\ninf 0 1\n", "a");
	ASSERT_EQ(a.surfaces.size(), 5u);
	EXPECT_EQ(a.stop, 2u);
	EXPECT_DOUBLE_EQ(a.surfaces[0].curvature, 1 / 29.475);
	EXPECT_EQ(a.surfaces[1].index, 1);
	EXPECT_EQ(a.surfaces[4].curvature, 0);
	EXPECT_EQ(a.StopRadius(), 8.55);
	EXPECT_EQ(a.surfaces[4].clear_radius, 0);
	// The same otherwise written: CR LF, commas, Unicode's minus and infinity, comments, the stop by name, five columns.
	const Prescription b = ParsePrescription("# a lens\r\n29.475, 3.76, 1.67, 50.1, 25.2 // glass\r\n\r\n84, 0.1\r\nSTOP 4.5 17.1\r\n\u221239.73 | 0 | 1.5\r\n\u221e - AIR\r\n", "b");
	ASSERT_EQ(b.surfaces.size(), 5u);
	EXPECT_EQ(b.stop, 2u);
	EXPECT_EQ(b.surfaces[0].abbe, 50.1);
	for (size_t k = 0; k < 5; ++k)
	{
		EXPECT_EQ(a.surfaces[k].curvature, b.surfaces[k].curvature) << k;
		EXPECT_EQ(a.surfaces[k].distance, b.surfaces[k].distance) << k;
		EXPECT_EQ(a.surfaces[k].index, b.surfaces[k].index) << k;
		EXPECT_EQ(a.surfaces[k].clear_radius, b.surfaces[k].clear_radius) << k;
	}
}

TEST(ParsePrescription, SaysFileLineAndWhat)
{
	const auto fault = [](const std::string& text)
	{
		try
		{
			ParsePrescription(text, "lens.txt");
		}
		catch (const Error& e)
		{
			EXPECT_EQ(e.Code(), EXIT_FILE);
			return std::string(e.what());
		}
		return std::string("none");
	};
	using testing::AllOf;
	using testing::HasSubstr;
	const std::string good = "10 2 1.5\n-10 1\nstop 1 4\n";
	EXPECT_THAT(fault(good + "8 2 1.6\nx 0 1\n"), AllOf(HasSubstr("lens.txt:5"), HasSubstr("'x' is no number"), HasSubstr("radius")));
	EXPECT_THAT(fault(good + "8 2 1.6\n"), AllOf(HasSubstr("lens.txt:4"), HasSubstr("air")));
	EXPECT_THAT(fault(good + "8 -2 1.6\n9 0\n"), AllOf(HasSubstr("lens.txt:4"), HasSubstr("below 0")));
	EXPECT_THAT(fault(good + "8 2 16\n9 0\n"), AllOf(HasSubstr("lens.txt:4"), HasSubstr("refractive index")));
	EXPECT_THAT(fault(good + "stop 2 5\n9 0\n"), AllOf(HasSubstr("lens.txt:4"), HasSubstr("second stop"), HasSubstr("line 3")));
	EXPECT_THAT(fault("10 2 1.5\n-10 0\n"), HasSubstr("no stop"));
	EXPECT_THAT(fault("10 2 1.5\n-10 1\nstop 1\n5 0\n"), AllOf(HasSubstr("lens.txt:3"), HasSubstr("diameter")));
	EXPECT_THAT(fault("10 2 1.5\nstop 2 1.6 5\n-10 0\n"), AllOf(HasSubstr("lens.txt:2"), HasSubstr("between two glasses")));
	EXPECT_THAT(fault(good + "8 2 1.6 20\n9 0\n"), AllOf(HasSubstr("lens.txt:4"), HasSubstr("whole sphere")));
	EXPECT_THAT(fault(good + "8\n"), AllOf(HasSubstr("lens.txt:4"), HasSubstr("is no surface")));
	EXPECT_THAT(fault(good + "conic -1\n"), HasSubstr("aspheric"));
	EXPECT_THAT(fault("columns radius index\n"), AllOf(HasSubstr("lens.txt:1"), HasSubstr("needs radius")));
	EXPECT_THAT(fault("columns radius distance index colour\n"), HasSubstr("`colour` is no column"));
	EXPECT_THAT(fault("columns radius distance index\n1 2 3 4\n"), AllOf(HasSubstr("lens.txt:2"), HasSubstr("names 3")));
	EXPECT_THAT(fault(""), HasSubstr("0 surfaces"));
	EXPECT_THAT(fault("nan 1 1\n2 2 2\n"), HasSubstr("lens.txt:1"));
}

TEST(ParsePrescription, DispersionByAbbeNumber)
{
	const Prescription lens = ReadPrescription(COOKE_TRIPLET);
	const double blue = lens.AtWavelength(486.1327).surfaces[0].index, red = lens.AtWavelength(656.2725).surfaces[0].index;
	EXPECT_NEAR((lens.surfaces[0].index - 1) / (blue - red), 60.3, 1e-9);
	EXPECT_EQ(lens.AtWavelength(587.5618).surfaces[0].index, lens.surfaces[0].index);
	EXPECT_EQ(lens.AtWavelength(486.1327).surfaces[1].index, 1);
}

}
