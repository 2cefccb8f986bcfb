// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a camera does not know is not told: where its distortion turns back, aperture and focus of an imported one, channels that are not read.

#include "base/files.h"
#include "calibrate/verdict.h"
#include "camera/state_camera.h"
#include "exchange/maps.h"
#include "exchange/point_lists.h"
#include "exchange/scene_files.h"
#include "exchange/view.h"
#include "picture/image_io.h"
#include "support/in_temporary_folder.h"
#include "support/picture_seeds.h"
#include "support/posed_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <cmath>
#include <fstream>

namespace
{

using namespace tiltcal;
using testing::HasSubstr;

class UnknownViews : public InTemporaryFolder {};

/// k1 = -0.3: the image radius r (1 - 0.3 r²) is greatest at r = 1 / sqrt(0.9), 0.7027 of w; the picture's corners are 0.95 of w away.
StateCamera Folding()
{
	StateCamera c;
	c.state = "wide";
	c.model = "curved";
	c.width = 160;
	c.height = 120;
	c.pitch_mm = 0.1;
	c.image_distance_mm = 10.5;
	c.principal_point = { 79.5, 59.5 };
	c.distortion = { -0.3 };
	c.focus_distance_mm = 500;
	c.aperture_diameter_mm = 4;
	return c;
}
const double FOLD_AT = 1 / std::sqrt(0.9), FOLD_SEEN_AT = FOLD_AT * (1 - 0.3 * FOLD_AT * FOLD_AT);

TEST_F(UnknownViews, WhereTheDistortionTurnsBackNothingIsSeen)
{
	const StateCamera c = Folding();
	// At the fold itself Newton's method has no slope to go by: half a per cent before it is left out.
	int none = 0, seen = 0;
	for (int y = 0; y < c.height; ++y)
		for (int x = 0; x < c.width; ++x)
		{
			const double radius = std::hypot(x - 79.5, y - 59.5) / c.ImageDistancePx();
			const std::optional<Vec3<double>> v = Unproject(c, { double(x), double(y) });
			if (radius > FOLD_SEEN_AT)
			{
				EXPECT_FALSE(v) << x << " " << y;
				++none;
			}
			else if (radius < 0.995 * FOLD_SEEN_AT)
			{
				ASSERT_TRUE(v) << x << " " << y;
				const double r = std::hypot(v->x, v->y) / v->z;
				EXPECT_LT(r, FOLD_AT);
				EXPECT_NEAR(r * (1 - 0.3 * r * r), radius, 1e-12);
				++seen;
			}
		}
	EXPECT_GT(none, 100);
	EXPECT_GT(seen, 10000);
	EXPECT_TRUE(Project(c, { 0.999 * FOLD_AT, 0, 1 }));
	EXPECT_FALSE(Project(c, { 1.001 * FOLD_AT, 0, 1 }));
	EXPECT_THAT(FoldWarning(c), HasSubstr("state wide: the distortion turns back"));
	EXPECT_EQ(FoldWarning(TiltedCamera()), "");
	std::ofstream(At("pixels.csv")) << "u_px,v_px\n0,0\n79.5,59.5\n";
	EXPECT_EQ(UnprojectedPixels(c, At("pixels.csv")), "u_px,v_px,x,y,z,focus_z_mm\n0,0,,,,\n79.5,59.5,0,0,1,500\n");
	FileSet set;
	WriteRayMap(c, At("rays.exr"), set);
	set.Commit();
}

TEST_F(UnknownViews, TheVerdictTellsADistortionThatTurnsBack)
{
	Calibration c;
	const StateCamera folding = Folding();
	c.task.width = folding.width;
	c.task.height = folding.height;
	c.task.pitch_mm = folding.pitch_mm;
	c.task.states = { State{} };
	c.task.states[0].name = "wide";
	c.refined = true;
	c.solution.model = Model::PLANE;
	c.solution.states.resize(1);
	c.solution.w_mm = { folding.image_distance_mm, 0.001 };
	c.geometry.w_px = folding.ImageDistancePx();
	c.geometry.states.resize(1);
	c.geometry.states[0].principal_point = folding.principal_point;
	c.geometry.states[0].lens_normal = { 0, 0, 1 };
	c.effects = { Effect{} };
	c.effects[0].id = EffectId::DISTORTION;
	c.effects[0].used = true;
	const auto tells = [&]
	{
		for (const Remark& r : Judge(c).remarks)
			if (r.text.find("turns back") != std::string::npos)
				return r.grade == Grade::POOR;
		return false;
	};
	EXPECT_FALSE(tells());
	c.geometry.distortion = folding.distortion;
	EXPECT_TRUE(tells());
	c.effects[0].used = false;
	EXPECT_FALSE(tells()) << "it is not written";
}

TEST_F(UnknownViews, AnImportedCameraKnowsNoFocus)
{
	StateCamera c = TiltedCamera();
	c.focus_distance_mm = std::numeric_limits<double>::infinity();
	WriteText(At("camera.json"), StateCameraJson(c, "camera.yml"));
	c = ReadStateCamera(At("camera.json"), "");
	EXPECT_FALSE(c.KnowsFocus());
	EXPECT_TRUE(std::isnan(BlurWidth(c, { 0, 0, 500 })));
	EXPECT_FALSE(Footprint(c, { 0, 0, 500 }));
	EXPECT_FALSE(ViewOf(c).has_plane);
	EXPECT_THAT(BlenderScript(c, 1), testing::AllOf(HasSubstr("unknown"), testing::Not(HasSubstr("use_dof")), testing::Not(HasSubstr("vertices"))));
	std::ofstream(At("points.csv")) << "x,y,z\n0,0,500\n";
	EXPECT_THAT(ProjectedPoints(c, At("points.csv")), testing::EndsWith(",\n"));
	std::ofstream(At("pixels.csv")) << "u_px,v_px\n9,9\n";
	EXPECT_THAT(UnprojectedPixels(c, At("pixels.csv")), testing::EndsWith(",\n"));
	FileSet set;
	WriteRayMap(c, At("rays.exr"), set);
	set.Commit();
	const Imf::InputFile rays(At("rays.exr").c_str());
	EXPECT_TRUE(rays.header().channels().findChannel("ray.X"));
	EXPECT_FALSE(rays.header().channels().findChannel("focus.Z"));
}

/// A calibration whose `effects` leave distortion out is the camera that was fitted without it.
TEST_F(UnknownViews, TheCameraReadIsTheOneThatIsWritten)
{
	const StateCamera with = Folding();
	StateCamera without = with;
	without.distortion = {};
	without.image_distance_mm = 10.1;
	without.aperture_diameter_mm = 3.5;
	without.focus_distance_mm = 480;
	without.principal_point = { 79, 60 };
	nlohmann::json json = nlohmann::json::parse(StateCameraJson(with, "x"));
	json["render"] = nlohmann::json::parse(StateCameraJson(without, "x"));
	for (const bool used : { true, false })
	{
		json["effects"] = { { { "name", "distortion" }, { "used", used } }, { { "name", "blades" }, { "used", true } } };
		// Twice as wide a circle through their corners, to see it multiplied.
		json["blades"] = { { "count", 6 }, { "rotation_deg", 0 }, { "curvature", 0 }, { "aperture_diameter_mm", 8 } };
		WriteText(At("calibration.json"), json.dump());
		const StateCamera read = ReadStateCamera(At("calibration.json"), "wide"), &expected = used ? with : without;
		EXPECT_EQ(read.distortion, expected.distortion);
		EXPECT_EQ(read.image_distance_mm, expected.image_distance_mm);
		EXPECT_EQ(read.focus_distance_mm, expected.focus_distance_mm);
		EXPECT_EQ(read.principal_point, expected.principal_point);
		EXPECT_EQ(read.aperture_diameter_mm, 2 * expected.aperture_diameter_mm);
	}
}

TEST_F(UnknownViews, BladesThatOtherProgramsDoNotGetAreNamed)
{
	StateCamera c = Folding();
	EXPECT_EQ(LostBlades(c, 16), "");
	c.blades = { 8, 22.5, 0.5 };
	EXPECT_THAT(BlenderScript(c, 1), testing::AllOf(HasSubstr("rotation and curvature of the 8 blades"), HasSubstr("aperture_blades = 8")));
	EXPECT_THAT(ArnoldText(c, 1), testing::AllOf(HasSubstr("rotation and curvature of the 8 blades"), HasSubstr("aperture_blades 8")));
	c.blades.count = 18;
	EXPECT_THAT(BlenderScript(c, 1), testing::AllOf(HasSubstr("the 18 blades (a disc instead)"), HasSubstr("aperture_blades = 0")));
}

TEST_F(UnknownViews, ChannelsThatAreNotReadAreNamed)
{
	for (const PictureSeed& seed : PictureSeeds(folder.Path()))
	{
		PhotographFacts facts;
		ReadLinear(At(seed.name), Transfer(), &facts);
		const bool alpha = seed.name == "rgba8.png", a = seed.name == "rgba-tiled.exr";
		EXPECT_EQ(facts.left_out, alpha ? "alpha" : a ? "A" : "") << seed.name;
	}
}

}
