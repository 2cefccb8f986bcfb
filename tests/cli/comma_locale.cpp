// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Preloaded (LD_PRELOAD) into a program: puts it into the locale of the environment, as a program with a window toolkit does.

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <locale>

namespace
{

struct Start
{
	Start()
	{
		if (!std::setlocale(LC_ALL, "") || std::strcmp(std::localeconv()->decimal_point, ",") != 0)
		{
			std::fputs("comma_locale: LC_ALL has no decimal comma\n", stderr);
			std::_Exit(99);
		}
		std::locale::global(std::locale(""));
	}
} start;

}
