// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A program that hosts the library may have a locale with decimal commas: what is read and written stays the same.

#include "base/files.h"
#include "base/numbers.h"
#include "camera/opencv_yaml.h"
#include "camera/pose.h"
#include "profile/profile.h"
#include "report/write_csv.h"
#include "support/comma_locale.h"
#include "support/in_temporary_folder.h"
#include "support/posed_camera.h"
#include "target/target.h"
#include <tiltcal/transfer.h>

#include <regex>
#include <string>
#include <vector>

namespace
{

using namespace tiltcal;

class LocaleOfTheHost : public InTemporaryFolder
{
protected:
	/// What a program reads and writes, without the names of files.
	std::vector<std::string> Everything(const std::string& name) const
	{
		const StateCamera camera = TiltedCamera();
		std::vector<std::string> texts{ StateCameraJson(camera, "source"), CameraBlockOf(camera, {}, 10), PoseInc(camera, CameraPose(), 2.5) };
		WriteText(At(name + ".json"), texts[0]);
		texts.push_back(StateCameraJson(ReadStateCamera(At(name + ".json"), ""), "source"));
		for (const std::string suffix : { ".yml", ".xml" })
		{
			double lost = 0;
			WriteOpenCv(camera, At(name + suffix));
			texts.push_back(ReadText(At(name + suffix), "a file"));
			texts.push_back(StateCameraJson(ReadOpenCv(At(name + suffix), 0.02, "state", lost), "source"));
		}
		WriteText(At(name + ".csv"), "u_px,v_px,x,y,z\n1.5,+2.25e0,-3.125,1e-400,1234567.5\n");
		for (const PosePoint& p : ReadPosePoints(At(name + ".csv")))
			for (const double x : { p.u, p.v, p.world.x, p.world.y, p.world.z })
				texts.push_back(std::to_string(std::lround(1e6 * x)));
		const Line line = ParseLine("0.5,660.25,1799.5,660");
		texts.push_back(std::to_string(std::lround(100 * (line.x0 + line.y0 + line.x1 + line.y1))) + TransferName(ParseTransfer("2.25")));
		const TargetPage page = LayOut(MakeBoard(TargetKind::CHECKERBOARD, "12x9", 25.5, 0, ""), "420.5x297.5", 10);
		texts.push_back(TargetInc(page));
		WriteTarget(page, At(name + ".svg"));
		// cairo counts its surfaces.
		texts.push_back(std::regex_replace(ReadText(At(name + ".svg"), "a file"), std::regex("surface[0-9]+"), "surface"));
		Photo photo;
		photo.file = "a,b.png";
		photo.corners.push_back({});
		photo.edges.push_back({});
		texts.push_back(CornersCsv({ photo }) + EdgesCsv({ photo }));
		return texts;
	}
};

TEST_F(LocaleOfTheHost, ChangesNothing)
{
	const std::vector<std::string> plain = Everything("plain");
	const CommaLocale comma;
	const std::vector<std::string> here = Everything("comma");
	ASSERT_EQ(here.size(), plain.size());
	for (size_t k = 0; k < plain.size(); ++k)
		EXPECT_EQ(here[k], plain[k]);
}

TEST(Numbers, AreWholeTexts)
{
	const auto number = [](const char* text) { return FiniteNumber(text).value_or(-99); };
	EXPECT_EQ(number("1.5"), 1.5);
	EXPECT_EQ(number(" +2e-3"), 0.002);
	EXPECT_EQ(number("-4"), -4);
	EXPECT_EQ(number("1e-400"), 0);
	for (const char* const bad : { "", " ", "1,5", "1.5 ", "1.5x", "+-1", "++1", "0x10", "nan", "inf", "1e400", "1e400e-1", "e5" })
		EXPECT_EQ(number(bad), -99) << bad;
}

}
