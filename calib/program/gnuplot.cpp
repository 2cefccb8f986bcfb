// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/gnuplot.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "program/process.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace tiltcal
{

std::string GnuplotString(const std::string& text)
{
	std::string quoted = "'";
	for (const char c : text)
		quoted += c == '\'' ? "''" : std::string(1, c);
	return quoted + "'";
}

bool Plot(const std::string& file, const std::string& script, int width, int height)
{
	const bool svg = file.size() > 4 && file.compare(file.size() - 4, 4, ".svg") == 0;
	try
	{
		WriteAtomically(file, [&](const std::string& temporary)
		{
			const std::string whole = fmt::format("set encoding utf8\nset terminal {} size {},{} font 'Sans,11' noenhanced\nset output {}\n{}\n",
				svg ? "svg background 'white'" : "pngcairo", width, height, GnuplotString(temporary), script);
			ProcessSetup gnuplot{{"gnuplot"}};
			gnuplot.input = whole;
			return RunProcess(gnuplot).exit_code == 0;
		});
		return true;
	}
	catch (const Error& e)
	{
		spdlog::warn("{}: not plotted; install gnuplot-nox for plots", file);
		return false;
	}
}

}
