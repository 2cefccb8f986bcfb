// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The table of the block's words, and what must agree with it: REFERENCE.md and the fuzzer.

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "camera_blocks.h"
#include "lens/words.h"

using namespace tilt_lens;

namespace
{

/// "vignetting optical R, Z": a word as the reference writes it.
std::string Written(const WordRow& row)
{
	return row.values[0] != '\0' ? row.Name() + " " + row.values : row.Name();
}

std::vector<std::string> Cells(const std::string& line)
{
	std::vector<std::string> cells;
	std::istringstream text(line);
	std::string cell;
	// A bar in a cell is written \|.
	for(std::string part; std::getline(text, part, '|'); )
	{
		cell += part;
		if(!cell.empty() && cell.back() == '\\')
			continue;
		const size_t first = cell.find_first_not_of(' '), last = cell.find_last_not_of(' ');
		cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
		cell.clear();
	}
	return cells;
}

/// The reference's table: words as written, with their units.
std::map<std::string, std::string> UnitsInReference()
{
	std::map<std::string, std::string> units;
	std::ifstream file(TILT_LENS_REFERENCE);
	bool inside = false;
	for(std::string line; std::getline(file, line); )
	{
		if(line.compare(0, 2, "##") == 0)
			inside = line == "## Words of the block";
		if(!inside || line.compare(0, 3, "| `") != 0)
			continue;
		const std::vector<std::string> cells = Cells(line);
		// One row may have two words: `show focus`, `show plane`.
		std::istringstream words(cells.at(1));
		std::string word;
		for(bool quoted = false; std::getline(words, word, '`'); quoted = !quoted)
			if(quoted)
				units[word] = cells.at(3);
	}
	return units;
}

}

TEST(Words, RowsAreFoundByTheirId)
{
	for(int i = 0; i < WordCount; i++)
		EXPECT_EQ(int(Words[i].id), i) << Words[i].Name();
}

TEST(Words, EachIsFoundAndListedOnce)
{
	std::map<std::string, int> listed;
	std::istringstream list(ListOfWords());
	for(std::string word; list >> word; )
		listed[word.substr(0, word.find(','))]++;
	for(const WordRow& row : Words)
	{
		ASSERT_NE(FindWord(row.word), nullptr) << row.word;
		EXPECT_STREQ(FindWord(row.word)->word, row.word);
		EXPECT_EQ(listed[row.word], 1) << row.word;
		EXPECT_NE(std::string(row.help), "") << row.Name();
	}
	EXPECT_EQ(FindWord("aperture"), nullptr);
	EXPECT_EQ(FindWord(""), nullptr);
}

/// Two rows for one member would be one word that overwrites another.
TEST(Words, EachNumberHasItsOwnMember)
{
	LensSpec spec;
	std::set<const void*> members;
	for(const WordRow& row : Words)
	{
		const bool is_new = row.number == NULL || members.insert(&(spec.*row.number)).second;
		EXPECT_TRUE(is_new) << row.Name();
	}
}

TEST(Words, ReferenceHasARowOfEachAndNoOther)
{
	std::map<std::string, std::string> units;
	for(const WordRow& row : Words)
		units[Written(row)] = row.unit;
	EXPECT_EQ(UnitsInReference(), units);
}

TEST(Words, FuzzerSaysEachOfThem)
{
	std::string scenes;
	for(int i = 0; i < 500; i++)
		scenes += CameraBlock(1, i).scene + "\n";
	for(const WordRow& row : Words)
		EXPECT_THAT(scenes, testing::HasSubstr(" " + row.Name() + " ")) << row.Name();
}

TEST(Words, WhatWasMeantIsFound)
{
	EXPECT_EQ(WordLike("focal_distence"), "focal_distance");
	EXPECT_EQ(WordLike("focal_lenght"), "focal_length");
	EXPECT_EQ(WordLike("aperture_diametre"), "aperture_diameter");
	EXPECT_EQ(WordLike("Shift"), "shift");
	EXPECT_EQ(WordLike("fstop"), "f_stop");
	EXPECT_EQ(WordLike("focalpoint"), "focal_point");
	for(const char* const far : { "", "x", "banana", "sphere", "tilt" })
		EXPECT_EQ(WordLike(far), "") << far;
	// Each word is nearest to itself, and to itself without its last letter.
	for(const WordRow& row : Words)
	{
		const std::string word = row.word;
		EXPECT_EQ(WordLike(word), word);
		const std::string shortened = word.substr(0, word.size() - 1);
		EXPECT_EQ(WordLike(shortened), word == "focal_points" ? "focal_point" : word);
	}
}

TEST(Words, AdviceSaysWhatToDo)
{
	EXPECT_THAT(AdviceOn("focal_distence"), testing::HasSubstr("did you mean 'focal_distance'?"));
	EXPECT_THAT(AdviceOn("focal_distence"), testing::Not(testing::HasSubstr("the words are")));
	EXPECT_THAT(AdviceOn("location"), testing::HasSubstr("'location' belongs outside the tilt_lens block, behind its '}'; is that missing?"));
	EXPECT_THAT(AdviceOn("focal_pont"), testing::HasSubstr("'focal_point' belongs outside"));
	EXPECT_THAT(AdviceOn("natural"), testing::HasSubstr("'vignetting natural'"));
	EXPECT_THAT(AdviceOn("rotation"), testing::HasSubstr("'blades 5 rotation'"));
	EXPECT_THAT(AdviceOn("banana"), testing::HasSubstr("the words are " + ListOfWords()));
}
