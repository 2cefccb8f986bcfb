// SPDX-License-Identifier: AGPL-3.0-or-later
//
// This program in a German locale, of C and of C++, while it lives: decimal commas, points between thousands.
#pragma once
#include "program/process.h"
#include "program/temporary_folder.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <cstring>
#include <locale>
#include <string>

class CommaLocale
{
public:
	CommaLocale()
	{
		const tiltcal::ProcessResult made = tiltcal::RunProcess({ { "localedef", "-i", "de_DE", "-f", "UTF-8", folder.File("de_DE.UTF-8") } });
		EXPECT_EQ(made.exit_code, 0) << "no locale could be made; cmake/setup.sh installs the package locales: " << made.said;
		setenv("LOCPATH", folder.Path().c_str(), 1);
		const char* const set = std::setlocale(LC_ALL, "de_DE.UTF-8");
		EXPECT_TRUE(set && std::strcmp(std::localeconv()->decimal_point, ",") == 0);
		if (set)
			std::locale::global(std::locale("de_DE.UTF-8"));
	}
	~CommaLocale()
	{
		std::locale::global(std::locale::classic());
		std::setlocale(LC_ALL, "C");
		unsetenv("LOCPATH");
	}
	CommaLocale(const CommaLocale&) = delete;
	CommaLocale& operator=(const CommaLocale&) = delete;

private:
	const tiltcal::TemporaryFolder folder{ "tiltcal-locale" };
};
