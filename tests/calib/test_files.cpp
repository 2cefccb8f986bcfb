// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/error.h>
#include "base/files.h"
#include "report/write_csv.h"
#include "support/in_temporary_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace
{

using namespace tiltcal;
namespace fs = std::filesystem;

class Files : public InTemporaryFolder
{
protected:
	void Touch(const std::string& name) const { std::ofstream(At(name)) << "x"; }
};

TEST_F(Files, GlobsCountNumbersAsNumbers)
{
	for (const char* const name : { "a-10.png", "a-9.png", "a-1.png", "b-1.png" })
		Touch(name);
	const std::vector<std::string> found = ExpandGlobs({ At("a-*.png"), At("a-1.png") }, "--untilted");
	EXPECT_EQ(found, (std::vector<std::string>{ At("a-1.png"), At("a-9.png"), At("a-10.png") }));
}

TEST_F(Files, ANameWithBracketsIsTakenAsItIs)
{
	Touch("photo[1].png");
	EXPECT_EQ(ExpandGlobs({ At("photo[1].png") }, "x").size(), 1u);
}

TEST_F(Files, AnEmptyGlobNamesTheOption)
{
	try
	{
		ExpandGlobs({ At("*.tif") }, "--tilted plus5");
		FAIL() << "not refused";
	}
	catch (const Error& e)
	{
		EXPECT_EQ(e.Code(), EXIT_FILE);
		EXPECT_NE(std::string(e.what()).find("--tilted plus5"), std::string::npos);
	}
}

TEST_F(Files, AFailedWriteLeavesTheOldFileAlone)
{
	WriteText(At("result.txt"), "old");
	EXPECT_THROW(WriteAtomically(At("result.txt"), [](const std::string& t) { std::ofstream(t) << "half"; return false; }), Error);
	std::string text;
	std::ifstream(At("result.txt")) >> text;
	EXPECT_EQ(text, "old");
	EXPECT_EQ(std::distance(fs::directory_iterator(folder.Path()), fs::directory_iterator()), 1);
}

TEST(Csv, QuotesWhatNeedsIt)
{
	EXPECT_EQ(CsvField("plain.png"), "plain.png");
	EXPECT_EQ(CsvField("a,\"b\".png"), "\"a,\"\"b\"\".png\"");
}

}
