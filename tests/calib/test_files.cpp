// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/error.h>
#include "base/csv_rows.h"
#include "base/file_set.h"
#include "base/files.h"
#include "base/plain_text.h"
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

TEST_F(Files, AFoldersBracketsAreNoPattern)
{
	for (const char* const name : { "set[12]", "set1" })
	{
		fs::create_directory(At(name));
		Touch(std::string(name) + "/a.png");
	}
	EXPECT_EQ(ExpandGlobs({ AsPattern(At("set[12]")) + "/*.png" }, "x"), std::vector<std::string>{ At("set[12]/a.png") });
}

TEST_F(Files, BlanksInsideOfANumberStay)
{
	std::ofstream(At("rows.csv")) << "x, y\n1 200,50\n 3 ,\t4 \n";
	const std::vector<CsvRow> rows = ReadCsvRows(At("rows.csv"), "x,y");
	ASSERT_EQ(rows.size(), 2u);
	EXPECT_EQ(rows[0].text, "1 200,50");
	EXPECT_EQ(rows[1].text, "3,4");
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

class Sets : public Files
{
protected:
	std::string Text(const std::string& name) const { return fs::exists(At(name)) ? ReadText(At(name), "a text") : "none"; }
	size_t Entries() const { return size_t(std::distance(fs::directory_iterator(folder.Path()), fs::directory_iterator())); }
};

TEST_F(Sets, AppearTogether)
{
	WriteText(At("a"), "old a");
	WriteText(At("gone"), "old");
	FileSet set;
	set.Text(At("a"), "new a");
	set.Text(At("b"), "new b");
	set.Remove(At("gone"));
	set.Remove(At("never"));
	EXPECT_EQ(Text("a"), "old a");
	EXPECT_EQ(Text("b"), "none");
	set.Commit();
	EXPECT_EQ(Text("a"), "new a");
	EXPECT_EQ(Text("b"), "new b");
	EXPECT_EQ(Entries(), 2u);
}

TEST_F(Sets, MayOnlyTakeAway)
{
	WriteText(At("gone"), "old");
	FileSet set;
	set.Remove(At("gone"));
	EXPECT_EQ(Text("gone"), "old");
	set.Commit();
	EXPECT_EQ(Entries(), 0u);
}

TEST_F(Sets, ThatAreGivenUpLeaveNothing)
{
	WriteText(At("a"), "old a");
	{
		FileSet set;
		set.Text(At("a"), "new a");
		EXPECT_THROW(set.Write(At("b"), [](const std::string&) { return false; }), Error);
	}
	EXPECT_EQ(Text("a"), "old a");
	EXPECT_EQ(Entries(), 1u);
}

TEST_F(Sets, ThatFailAtTheEndPutTheOldBack)
{
	for (const char* const name : { "a", "c", "gone" })
		WriteText(At(name), std::string("old ") + name);
	{
		FileSet set;
		set.Text(At("a"), "new a");
		set.Text(At("b"), "new b");
		set.Remove(At("gone"));
		fs::remove(set.Text(At("c"), "new c"));   // somebody cleans up
		EXPECT_THROW(set.Commit(), Error);
	}
	EXPECT_EQ(Text("a"), "old a");
	EXPECT_EQ(Text("b"), "none");
	EXPECT_EQ(Text("c"), "old c");
	EXPECT_EQ(Text("gone"), "old gone");
	EXPECT_EQ(Entries(), 3u);
}

TEST_F(Sets, OfMoreThanOneFullDeviceTouchNothing)
{
	WriteText(At("a"), "old a");
	fs::create_symlink("/dev/full", At("full"));
	FileSet set;
	set.Text(At("a"), "new a");
	set.Text(At("full"), "x");
	EXPECT_THROW(set.Commit(), Error);
	EXPECT_EQ(Text("a"), "old a");
}

TEST(PlainText, IsUtf8OfOneLine)
{
	EXPECT_EQ(CleanUtf8("na\xC3\xAFve\n"), "na\xC3\xAFve\n");
	EXPECT_EQ(CleanUtf8("na\xEFve \xC3"), "na\xEF\xBF\xBDve \xEF\xBF\xBD");
	EXPECT_EQ(OneLine("a\r\n\x7F" "b"), "a\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD" "b");
	EXPECT_EQ(WithUnixLines("\xEF\xBB\xBF" "a\r\nb\rc\n\r"), "a\nb\nc\n\n");
}

TEST(Csv, QuotesWhatNeedsIt)
{
	EXPECT_EQ(CsvField("plain.png"), "plain.png");
	EXPECT_EQ(CsvField("a,\"b\".png"), "\"a,\"\"b\"\".png\"");
	EXPECT_EQ(CsvField("f\xFCr\n"), "\"f\xEF\xBF\xBDr\n\"");
}

}
