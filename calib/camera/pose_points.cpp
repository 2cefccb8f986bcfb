// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose_points.h"

#include <tiltcal/error.h>
#include "base/files.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>

namespace tiltcal
{

namespace
{

const char* const HEADER = "u_px,v_px,x,y,z";

/// Without blanks, a carriage return and a byte order mark.
std::string Stripped(const std::string& line)
{
	std::string out;
	for (const char c : line.rfind("\xEF\xBB\xBF", 0) == 0 ? line.substr(3) : line)
		if (c != ' ' && c != '\t' && c != '\r')
			out += c;
	return out;
}

PosePoint ParsePoint(const std::string& text, const std::string& file, int line)
{
	double values[5];
	const bool nowhere = text.rfind(",,", 0) == 0;
	values[0] = values[1] = std::numeric_limits<double>::quiet_NaN();
	const char* at = text.c_str() + (nowhere ? 2 : 0);
	for (int k = nowhere ? 2 : 0; k < 5; ++k)
	{
		char* end = nullptr;
		values[k] = std::strtod(at, &end);
		const char expected = k < 4 ? ',' : '\0';
		if (end == at || *end != expected || !std::isfinite(values[k]))
			throw FileError(fmt::format("{}:{}: '{}' is not five numbers {}; a point whose pixel is to be found begins with two commas", file, line, text, HEADER));
		at = end + 1;
	}
	return { values[0], values[1], { values[2], values[3], values[4] }, line, nowhere ? Placed::NOWHERE : Placed::GIVEN };
}

}

std::vector<PosePoint> ReadPosePoints(const std::string& file)
{
	std::istringstream in(ReadText(file, fmt::format("a CSV file with the header {}", HEADER)));
	std::vector<PosePoint> points;
	std::string text;
	bool header = false;
	for (int line = 1; std::getline(in, text); ++line)
	{
		const std::string stripped = Stripped(text);
		if (stripped.empty() || stripped[0] == '#')
			continue;
		if (header)
			points.push_back(ParsePoint(stripped, file, line));
		else if (stripped != HEADER)
			throw FileError(fmt::format("{}:{}: '{}' is not the header {}", file, line, stripped.substr(0, 60), HEADER));
		header = true;
	}
	if (!header)
		throw FileError(fmt::format("{}:1: is empty; the header is {}", file, HEADER));
	return points;
}

}
