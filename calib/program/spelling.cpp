// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/spelling.h"

#include <algorithm>

namespace tiltcal
{

std::string SpelledAsOptions(const std::string& text)
{
	std::string out;
	for (size_t at = 0; at < text.size();)
	{
		const size_t end = text[at] == '`' ? text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 1) : std::string::npos;
		if (end == std::string::npos || text[end] != '`' || end == at + 1)
		{
			out += text[at++];
			continue;
		}
		std::string option = text.substr(at + 1, end - at - 1);
		std::replace(option.begin(), option.end(), '_', '-');
		out += "--" + option;
		at = end + 1;
	}
	return out;
}

}
