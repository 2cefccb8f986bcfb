// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/gnuplot.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "program/process.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <fstream>
#include <iterator>

namespace tiltcal
{

namespace
{

const int NOT_FOUND = 127;   // of a child that could not be started (program/process.h)

bool EndsWith(const std::string& text, const std::string& end) { return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0; }

/// gnuplot does not see a full disk: the end of a PNG or SVG file is there?
bool IsWhole(const std::string& file, bool svg)
{
	std::ifstream in(file, std::ios::binary);
	const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
	return svg ? text.find("</svg>") != std::string::npos : EndsWith(text, "IEND\xAE\x42\x60\x82");
}

bool RunGnuplot(const std::string& file, const std::string& script, int width, int height)
{
	const bool svg = EndsWith(file, ".svg");
	ProcessSetup gnuplot{{"gnuplot"}};
	gnuplot.input = fmt::format("set encoding utf8\nset terminal {} size {},{} font 'Sans,11' noenhanced\nset output {}\n{}\n",
		svg ? "svg background 'white'" : "pngcairo", width, height, GnuplotString(file), script);
	const int code = RunProcess(gnuplot).exit_code;
	if (code == NOT_FOUND)
		throw Refused("install gnuplot-nox for plots");
	if (code != 0)
		throw Refused(fmt::format("gnuplot ended with exit code {}", code));
	return IsWhole(file, svg);
}

}

std::string GnuplotString(const std::string& text)
{
	std::string quoted = "'";
	for (const char c : text)
		if (c == '\'')
			quoted += "''";
		else if (static_cast<unsigned char>(c) < 0x20)
			quoted += fmt::format("'.\"\\{:03o}\".'", c);
		else
			quoted += c;
	return quoted + "'";
}

bool Plot(FileSet& set, const std::string& file, const std::string& script, int width, int height)
{
	try
	{
		// Beside the set: a plot that fails leaves the set as it is.
		FileSet alone;
		alone.Write(file, [&](const std::string& temporary) { return RunGnuplot(temporary, script, width, height); });
		set.Join(alone);
		return true;
	}
	catch (const Error& e)
	{
		spdlog::warn("{}: not plotted: {}", file, e.what());
		set.Remove(file);   // that of older results
		return false;
	}
}

bool Plot(const std::string& file, const std::string& script, int width, int height)
{
	FileSet set;
	if (!Plot(set, file, script, width, height))
		return false;
	set.Commit();
	return true;
}

}
