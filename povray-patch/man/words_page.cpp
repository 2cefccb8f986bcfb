// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The man page povray-tilt.1 from its frame on stdin: @VERSION@ is replaced by the first argument,
// and the line @WORDS@ by a list of the block's words, from the table that the parser has.

#include <iostream>
#include <string>

#include "lens/words.h"

namespace
{

void Replace(std::string& text, const std::string& what, const std::string& by)
{
	for(size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
		text.replace(at, what.size(), by);
}

/// What roff would take for its own, and what is not ASCII.
std::string Roff(std::string text)
{
	Replace(text, "-", "\\-");
	Replace(text, "'", "\\(aq");
	Replace(text, "…", "...");
	return text;
}

void PrintWords()
{
	for(const tilt_lens::WordRow& row : tilt_lens::Words)
	{
		const std::string unit = row.unit;
		std::cout << ".TP\n\\fB" << Roff(row.Name()) << "\\fR \\fI" << Roff(row.values) << "\\fR\n" << Roff(row.help);
		if(unit.find("–") == std::string::npos)
			std::cout << " (" << Roff(unit) << ")";
		std::cout << "\n";
	}
}

}

int main(int count, char** arguments)
{
	for(std::string line; std::getline(std::cin, line); )
	{
		if(line == "@WORDS@")
		{
			PrintWords();
			continue;
		}
		Replace(line, "@VERSION@", count > 1 ? arguments[1] : "");
		std::cout << line << "\n";
	}
	return std::cout.flush() ? 0 : 1;
}
