// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose_points.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "base/numbers.h"
#include "base/plain_text.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace tiltcal
{

namespace
{

const char* const HEADER = "u_px,v_px,x,y,z";

/// Without blanks.
std::string Stripped(const std::string& line)
{
	std::string out;
	for (const char c : line)
		if (c != ' ' && c != '\t')
			out += c;
	return out;
}

PosePoint ParsePoint(const std::string& text, const std::string& file, int line)
{
	double values[5];
	const bool nowhere = text.rfind(",,", 0) == 0;
	values[0] = values[1] = std::numeric_limits<double>::quiet_NaN();
	size_t at = nowhere ? 2 : 0;
	for (int k = nowhere ? 2 : 0; k < 5; ++k)
	{
		const std::optional<double> value = NumberAt(text, at);
		if (!value || !std::isfinite(*value) || (k < 4 ? text[at] != ',' : at != text.size()))
			throw FileError(fmt::format("{}:{}: '{}' is not five numbers {}; a point whose pixel is to be found begins with two commas", file, line,
				OneLine(text.substr(0, 60)), HEADER));
		values[k] = *value;
		++at;
	}
	return { values[0], values[1], { values[2], values[3], values[4] }, line, nowhere ? Placed::NOWHERE : Placed::GIVEN };
}

}

std::vector<PosePoint> ReadPosePoints(const std::string& file)
{
	std::istringstream in(WithUnixLines(ReadText(file, fmt::format("a CSV file with the header {}", HEADER))));
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
			throw FileError(fmt::format("{}:{}: '{}' is not the header {}", file, line, OneLine(stripped.substr(0, 60)), HEADER));
		header = true;
	}
	if (!header)
		throw FileError(fmt::format("{}:1: is empty; the header is {}", file, HEADER));
	return points;
}

}
