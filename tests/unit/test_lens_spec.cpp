// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From the words of the camera to the lens: what is meant, what is refused, and
// with which words.

#include <cmath>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lens/lens_spec.h"
#include "lens/optics.h"
#include "unit/resolved_lens.h"

using namespace tilt_lens;
using testing::HasSubstr;

namespace
{

const CameraVectors Plain = { { 0, 0, 0 }, { 0, 0, 1.5 }, { 1.33, 0, 0 }, { 0, 1, 0 } };

LensSpec Spec(const std::function<void(LensSpec&)>& set = [](LensSpec&) {})
{
	LensSpec s;
	s.enabled = true;
	set(s);
	return s;
}

TiltLens Resolved(const LensSpec& spec, const CameraVectors& camera = Plain) { return ResolvedFor(spec, camera); }

std::string ErrorOf(const LensSpec& spec, const CameraVectors& camera = Plain)
{
	TiltLens lens;
	std::string error;
	EXPECT_FALSE(ResolveTiltLens(spec, camera, lens, error));
	EXPECT_TRUE(std::isfinite(lens.power)) << "a refused lens must not leave a NaN";
	return error;
}

}

TEST(LensSpec, EmptyBlockIsThePerspectiveCamera)
{
	const TiltLens lens = Resolved(Spec());
	EXPECT_TRUE(lens.IsPinhole());
	EXPECT_EQ(lens.direction.z, 1.5);
	EXPECT_EQ(lens.image_distance, 1.5);
	EXPECT_EQ(lens.normal_camera.z, 1.0);
}

TEST(LensSpec, FocalPlaneTiltAndLensTiltAreTheSameLens)
{
	const TiltLens a = Resolved(Spec([](LensSpec& s) { s.focal_plane_tilt = 60.0; s.tilt_direction = 25.0; s.focal_distance = 8.0; }));
	const double tilt = AngleFromAxis(a.normal_camera) * 180.0 / M_PI;
	const TiltLens b = Resolved(Spec([=](LensSpec& s) { s.lens_tilt = tilt; s.tilt_direction = 25.0; s.focal_distance = 8.0; }));
	EXPECT_NEAR(Length(a.inverse_focus_camera - b.inverse_focus_camera), 0.0, 1e-14);
}

TEST(LensSpec, FocalPointLiesOnThePlaneOffTheAxisToo)
{
	const Vec3d P = { 3.0, -2.0, 9.0 };
	for(const char* words : { "plain", "plane tilt", "lens tilt" })
	{
		const TiltLens lens = Resolved(Spec([&](LensSpec& s) {
			s.focal_point = P;
			if(words[0] == 'p' && words[5] == ' ') s.focal_plane_tilt = -40.0;
			if(words[0] == 'l') { s.lens_tilt = 7.0; s.tilt_direction = 110.0; }
		}));
		EXPECT_NEAR(Dot(lens.inverse_focus_camera, P), 1.0, 1e-13) << words;
	}
}

TEST(LensSpec, WorldPlaneIsTheSameFromEveryCameraFrame)
{
	// Mirrored, sheared and scaled vectors; the plane y = -1.5 in the world.
	const CameraVectors cameras[] = {
		{ { 5, 2, -3 }, { 0, 0, 1.5 }, { 1.33, 0, 0 }, { 0, 1, 0 } },
		{ { 5, 2, -3 }, { 0, 0, 1.5 }, { -1.33, 0, 0 }, { 0, 1, 0 } },
		{ { 5, 2, -3 }, { 300, 100, 1500 }, { 1330, 0, 0 }, { 400, 1000, 0 } },
		{ { 5, 2, -3 }, { 0, -0.5, 1.5 }, { 1.33, 0, 0.3 }, { 0, 1, 0.2 } } };
	for(const CameraVectors& camera : cameras)
	{
		const TiltLens lens = Resolved(Spec([](LensSpec& s) {
			s.focal_plane_point = Vec3d{ 100, -1.5, 40 };
			s.focal_plane_normal = { 0, -3, 0 };
		}), camera);
		for(const Vec3d& P : { Vec3d{ 0, -1.5, 0 }, Vec3d{ 50, -1.5, 900 }, Vec3d{ -7, -1.5, 3 } })
			EXPECT_NEAR(Dot(lens.inverse_focus, P - camera.location), 1.0, 1e-12);
	}
}

TEST(LensSpec, ThreePointsLieOnThePlane)
{
	const Vec3d P[3] = { { -2, 1, 6 }, { 3, 2, 11 }, { 0, -1, 20 } };
	const TiltLens lens = Resolved(Spec([&](LensSpec& s) { for(int i = 0; i < 3; i++) s.focal_points[i] = P[i]; }));
	for(const Vec3d& p : P)
		EXPECT_NEAR(Dot(lens.inverse_focus, p), 1.0, 1e-13);
}

TEST(LensSpec, FocalLengthGivesTheImageDistanceAndTheLensItself)
{
	const CameraVectors slr = { { 0, 0, 0 }, { 0, 0, 1 }, { 36, 0, 0 }, { 0, 24, 0 } };
	const TiltLens straight = Resolved(Spec([](LensSpec& s) { s.focal_length = 45.0; s.focal_distance = 618.0; s.f_stop = 2.8; }), slr);
	EXPECT_NEAR(straight.image_distance, 1.0 / (1.0 / 45.0 - 1.0 / 618.0), 1e-12);
	EXPECT_NEAR(straight.direction.z, straight.image_distance, 1e-12) << "focus breathing: the window moves with the image distance";
	EXPECT_NEAR(straight.aperture_diameter, 45.0 / 2.8, 1e-12);
	const TiltLens tilted = Resolved(Spec([](LensSpec& s) { s.focal_length = 45.0; s.focal_distance = 618.0; s.focal_plane_tilt = 55.0; }), slr);
	EXPECT_NEAR(1.0 / tilted.power, 45.0, 1e-11);
	const TiltLens by_lens = Resolved(Spec([](LensSpec& s) { s.focal_length = 45.0; s.focal_distance = 618.0; s.lens_tilt = 5.0; }), slr);
	EXPECT_NEAR(1.0 / by_lens.power, 45.0, 1e-11);
	EXPECT_NEAR(AngleFromAxis(by_lens.normal_camera) * 180.0 / M_PI, 5.0, 1e-12);
	EXPECT_NEAR(by_lens.inverse_focus_camera.z, 1.0 / 618.0, 1e-15);
}

TEST(LensSpec, AngleKeepsTheFieldOfViewWhateverTheImageDistance)
{
	const TiltLens lens = Resolved(Spec([](LensSpec& s) { s.angle_given = true; s.image_distance = 50.0; s.shift = Vec3d{ 5, -2, 0 }; }));
	EXPECT_EQ(lens.direction.z, 1.5);
	// 5 in a sensor that is 50/1.5 times the window.
	EXPECT_NEAR(lens.direction.x, 5.0 * 1.5 / 50.0, 1e-15);
	EXPECT_NEAR(lens.direction.y, -2.0 * 1.5 / 50.0, 1e-15);
	const TiltLens window = Resolved(Spec([](LensSpec& s) { s.image_distance = 50.0; s.shift = Vec3d{ 5, -2, 0 }; }));
	EXPECT_EQ(window.direction.z, 50.0);
	EXPECT_EQ(window.direction.x, 5.0);
}

TEST(LensSpec, ApertureIsStocksAndApertureDiameterIsHonest)
{
	EXPECT_EQ(Resolved(Spec([](LensSpec& s) { s.aperture = 0.8; })).aperture_diameter, 0.4);
	const TiltLens lens = Resolved(Spec([](LensSpec& s) { s.aperture_diameter = 0.8; s.focal_plane_tilt = 30.0; s.focal_distance = 4.0; }));
	EXPECT_NEAR(Length(lens.lens_x), 0.4, 1e-15);
	EXPECT_NEAR(Dot(lens.lens_x, lens.normal), 0.0, 1e-15);
	EXPECT_NEAR(Dot(lens.lens_y, lens.normal), 0.0, 1e-15);
}

// Same picture at every scale: all that rays depend on scales with the scene.
TEST(LensSpec, ScaledScenesScale)
{
	const auto words = [](double k) { return Spec([k](LensSpec& s) {
		s.focal_plane_point = Vec3d{ 1 * k, -2 * k, 7 * k }; s.focal_plane_normal = { 0, 1, 0.4 };
		s.image_distance = 2.0 * k; s.aperture_diameter = 0.3 * k; }); };
	const TiltLens one = Resolved(words(1.0));
	for(double k : { 1e-7, 1e7, 1e-30, 1e30 })
	{
		const CameraVectors camera = { { 0, 0, 0 }, { 0, 0, 1.5 * k }, { 1.33 * k, 0, 0 }, { 0, k, 0 } };
		const TiltLens lens = Resolved(words(k), camera);
		EXPECT_NEAR(Length(k * lens.inverse_focus - one.inverse_focus), 0.0, 1e-15);
		EXPECT_NEAR(Length(lens.normal - one.normal), 0.0, 1e-15);
		EXPECT_NEAR(lens.lens_x.x / k, one.lens_x.x, 1e-15);
		EXPECT_NEAR(lens.direction.z / k, one.direction.z, 1e-15);
	}
}

TEST(LensSpec, RefusalsNameTheInequality)
{
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.focal_length = 45.0; s.focal_plane_point = Vec3d{ 0, -31.2, 0 }; s.focal_plane_normal = { 0, 1, 0 }; })),
	            HasSubstr("the hinge lies 31.2 from the lens, nearer than focal_length 45"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.focal_length = 45.0; s.focal_distance = 40.0; })),
	            HasSubstr("1/image_distance would be -0.00277778, which must be greater than 0"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.focal_plane_point = Vec3d{ 0, 0, 0 }; s.focal_plane_normal = { 0, 1, 0 }; })),
	            HasSubstr("passes through the lens centre"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.focal_distance = -1.5; })), HasSubstr("lies on the sensor (1.5 behind the lens)"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.focal_plane_tilt = 90.0; })), HasSubstr("between -90 and 90"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.focal_distance = 0.0; })), HasSubstr("focal_distance must not be 0"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.aperture_diameter = -1.0; })), HasSubstr("aperture_diameter must not be negative"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { s.image_distance = 0.0; })), HasSubstr("image_distance must be greater than 0"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { for(auto& p : s.focal_points) p = Vec3d{ 1, 2, 3 }; })), HasSubstr("are the same"));
	EXPECT_THAT(ErrorOf(Spec([](LensSpec& s) { for(int i = 0; i < 3; i++) s.focal_points[i] = Vec3d{ 1.0 * i, 2.0 * i, 3.0 }; })), HasSubstr("on one line"));
}

TEST(LensSpec, ContradictionsAreRefused)
{
	const std::function<void(LensSpec&)> contradictions[] = {
		[](LensSpec& s) { s.focal_plane_tilt = 1.0; s.lens_tilt = 1.0; },
		[](LensSpec& s) { s.focal_plane_point = Vec3d{ 0, 0, 5 }; s.focal_distance = 5.0; },
		[](LensSpec& s) { s.focal_plane_point = Vec3d{ 0, 0, 5 }; s.focal_point = Vec3d{ 0, 0, 5 }; },
		[](LensSpec& s) { s.focal_distance = 5.0; s.focal_point = Vec3d{ 0, 0, 5 }; },
		[](LensSpec& s) { s.tilt_direction = 5.0; },
		[](LensSpec& s) { s.focal_length = 1.0; s.image_distance = 1.2; },
		[](LensSpec& s) { s.aperture_diameter = 1.0; s.f_stop = 2.0; },
		[](LensSpec& s) { s.aperture_diameter = 1.0; s.aperture = 2.0; } };
	for(const auto& words : contradictions)
		EXPECT_THAT(ErrorOf(Spec(words)), testing::AnyOf(HasSubstr("give one"), HasSubstr("contradicts"), HasSubstr("needs"), HasSubstr("leave out")));
}

TEST(LensSpec, WordsAroundABlockThatReplacesAnotherStayUnlessItContradictsThem)
{
	const LensSpec before = Spec([](LensSpec& s)
	{
		s.focal_plane_tilt = 20.0;
		s.shift = Vec3d{ 0.1, 0.0, 0.0 };
		s.denoise = true;
		s.angle_given = s.right_given = true;
		s.look_at = Vec3d{ 0, 0, 7 };
		s.focal_point = Vec3d{ 0, 1, 9 };
		s.aperture = 0.8;
	});
	const auto after = [&](const std::function<void(LensSpec&)>& set) { LensSpec s = Spec(set); s.Take_Words_Around(before); return s; };

	const LensSpec empty = after([](LensSpec&) {});
	EXPECT_FALSE(empty.focal_plane_tilt || empty.shift || empty.denoise) << "words of the block";
	EXPECT_TRUE(empty.angle_given && empty.right_given && empty.look_at && empty.focal_point);
	EXPECT_EQ(empty.focal_point.value.z, 9.0);
	EXPECT_EQ(empty.aperture, 0.8);

	// What focal_point would contradict (ContradictionsAreRefused).
	EXPECT_FALSE(after([](LensSpec& s) { s.focal_distance = 5.0; }).focal_point);
	EXPECT_FALSE(after([](LensSpec& s) { s.focal_plane_point = Vec3d{ 0, 0, 5 }; }).focal_point);
	EXPECT_FALSE(after([](LensSpec& s) { s.focal_points[0] = s.focal_points[1] = s.focal_points[2] = Vec3d{ 0, 0, 5 }; }).focal_point);
	EXPECT_FALSE(after([](LensSpec& s) { s.lens_tilt = 3.0; s.focal_length = 1.0; s.image_distance = 1.2; }).focal_point);
	EXPECT_TRUE(after([](LensSpec& s) { s.lens_tilt = 3.0; s.focal_length = 1.0; }).focal_point);
	EXPECT_EQ(after([](LensSpec& s) { s.aperture_diameter = 0.1; }).aperture, 0.0);
	EXPECT_EQ(after([](LensSpec& s) { s.f_stop = 4.0; }).aperture, 0.0);
}

TEST(LensSpec, NotANumberIsRefusedByName)
{
	const double nan = std::nan(""), inf = HUGE_VAL;
	EXPECT_THAT(ErrorOf(Spec([=](LensSpec& s) { s.focal_plane_tilt = nan; })), HasSubstr("focal_plane_tilt"));
	EXPECT_THAT(ErrorOf(Spec([=](LensSpec& s) { s.focal_distance = nan; })), HasSubstr("focal_distance"));
	EXPECT_THAT(ErrorOf(Spec([=](LensSpec& s) { s.shift = Vec3d{ nan, 0, 0 }; })), HasSubstr("shift"));
	EXPECT_THAT(ErrorOf(Spec([=](LensSpec& s) { s.image_distance = inf; })), HasSubstr("image_distance"));
	EXPECT_THAT(ErrorOf(Spec(), { { nan, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 } }), HasSubstr("location"));
	EXPECT_THAT(ErrorOf(Spec(), { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }), HasSubstr("direction lies in the plane"));
}
