// SPDX-License-Identifier: AGPL-3.0-or-later

#include "damage_text.h"

#include "damage.h"

#include <cctype>
#include <vector>

namespace
{

const char* const NastyValues[] = {
	"0", "-0", "1", "-1", "1e-310", "5e-324", "1e-300", "1e-160", "1e-16", "1e16", "1e155", "-1e155", "1e300", "1.7976931348623157e308", "-1e308", "1e400", "-1e400", "1e99999999999", "0x10", "1,5", "1.",
	".5", "+1", "--1", "1e", "2147483647", "2147483648", "4294967296", "9223372036854775807", "9223372036854775808", "18446744073709551615", "99999999999999999999999", "89.99999999", "90", "1000000", "1000001",
	"nan", "NaN", ".Nan", ".nan", "inf", "-.Inf", ".inf", "Infinity", "null", "~", "true", "false", "\"\"", "\"text\"", "text", "[]", "{}", "[1]", "{\"a\":1}", "[ 1., 2., 3. ]", "!!opencv-matrix", "!!opencv-nd-matrix",
	"!!float", "&a", "*a", "|", ">", "%YAML:1.0", "---", "...", "#", "\"", "'", "\\", "\\u0000", "\\ud800", "<", "</", "<!--", "-->", "<?xml", "&lt;", "&#0;", "]]>", "type_id=\"opencv-matrix\"", "dt: u", "dt: 3d", "dt: \"64d\"",
	"rows: 0", "rows: -1", "rows: 100000", "cols: 2147483647", ",", ",,", ":", ": :", "-", "- -", "\t", "\xEF\xBB\xBF", "\xff", "u_px,v_px,x,y,z" };

std::vector<size_t> LineStarts(const std::string& text)
{
	std::vector<size_t> starts{ 0 };
	for (size_t i = 0; i + 1 < text.size(); ++i)
		if (text[i] == '\n')
			starts.push_back(i + 1);
	return starts;
}

/// From, and behind the line.
std::pair<size_t, size_t> ALine(const std::string& text, Random& random)
{
	const std::vector<size_t> starts = LineStarts(text);
	const size_t k = size_t(random.Below(int(starts.size())));
	return { starts[k], k + 1 < starts.size() ? starts[k + 1] : text.size() };
}

bool IsWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' || c == '_'; }

/// The word at or behind a random place.
void ReplaceWord(std::string& text, Random& random)
{
	size_t from = size_t(random.Below(int(text.size())));
	while (from < text.size() && !IsWord(text[from]))
		++from;
	while (from > 0 && from <= text.size() && IsWord(text[from - 1]))
		--from;
	size_t to = from;
	while (to < text.size() && IsWord(text[to]))
		++to;
	text.replace(from, to - from, random.Pick(NastyValues));
}

void InsertMany(std::string& text, Random& random)
{
	static const char* const pieces[] = { "[", "{", "(", "<a>", "- ", "{\"a\":", "[[", " ", "a", "9", "\n", "\r\n", "-\n ", ",", "<!-- -->", "\"", "\\" };
	const std::string piece = random.Pick(pieces);
	std::string many;
	for (int n = 1 << random.Below(17); n > 0; --n)
		many += piece;
	text.insert(size_t(random.Below(int(text.size()) + 1)), many);
}

void DamageOnce(std::string& text, Random& random)
{
	const auto [from, to] = ALine(text, random);
	const std::string line = text.substr(from, to - from);
	switch (random.Below(10))
	{
	case 0: text.erase(from, to - from); break;
	case 1: text.insert(from, line); break;
	case 2: text.erase(from, to - from); text.insert(ALine(text + "\n", random).first, line); break;
	case 3: InsertMany(text, random); break;
	case 4: text.insert(size_t(random.Below(int(text.size()) + 1)), random.Pick(NastyValues)); break;
	case 5: text.insert(to > from ? to - 1 : to, "\r"); break;
	default: ReplaceWord(text, random);
	}
	if (text.empty())
		text = "x";
}

}

std::string DamagedText(std::string text, const std::string& other, Random& random)
{
	if (random.Chance(0.33))
		return Damaged(text, other, random);
	for (int n = random.Chance(0.6) ? 1 : 2 + random.Below(4); n > 0; --n)
		DamageOnce(text, random);
	return text;
}
