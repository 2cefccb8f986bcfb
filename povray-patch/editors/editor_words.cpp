// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A syntax file for an editor from its frame on stdin: @VERSION@ is replaced by the first argument, @WORDS@ by the words
// of the tilt_lens block, as the second's editor wants them. They come from the table that the parser has.
//
//   editor_words VERSION vim|vscode < FRAME > FILE

#include <cctype>
#include <iostream>
#include <iterator>
#include <set>
#include <string>

#include "lens/words.h"

namespace
{

/// The words among the values of a row, such as `rotation` in "N [rotation A] [curvature C]": what stands for a value is a capital.
void AddWordsAmong(const std::string& values, std::set<std::string>& words)
{
	std::string word;
	for(char c : values + " ")
	{
		if(c == '_' || std::islower((unsigned char)c))
			word += c;
		else if(!word.empty())
		{
			words.insert(word);
			word.clear();
		}
	}
}

std::string Words(const std::string& separator)
{
	std::set<std::string> words(std::begin(tilt_lens::AberrationWords), std::end(tilt_lens::AberrationWords));
	words.insert(tilt_lens::EtendueWord);
	for(const tilt_lens::WordRow& row : tilt_lens::Words)
	{
		words.insert(row.word);
		if(row.option[0] != '\0')
			words.insert(row.option);
		AddWordsAmong(row.values, words);
	}
	std::string list;
	for(const std::string& word : words)
		list += (list.empty() ? "" : separator) + word;
	return list;
}

void Replace(std::string& text, const std::string& what, const std::string& by)
{
	for(size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
		text.replace(at, what.size(), by);
}

}

int main(int count, char** arguments)
{
	const std::string editor = count == 3 ? arguments[2] : "";
	if(editor != "vim" && editor != "vscode")
	{
		std::cerr << "usage: editor_words VERSION vim|vscode < FRAME > FILE\n";
		return 2;
	}
	std::string text((std::istreambuf_iterator<char>(std::cin)), std::istreambuf_iterator<char>());
	Replace(text, "@VERSION@", arguments[1]);
	Replace(text, "@WORDS@", Words(editor == "vim" ? " " : "|"));
	std::cout << text;
	return std::cout.flush() ? 0 : 1;
}
