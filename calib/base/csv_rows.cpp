// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/csv_rows.h"

#include "base/files.h"
#include "base/numbers.h"
#include "base/plain_text.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

#include <iostream>
#include <iterator>
#include <sstream>

namespace tiltcal
{

namespace
{

/// Without blanks beside commas and at the ends. Those inside of a field stay: `1 200` is no number.
std::string Stripped(const std::string& line)
{
	std::string out, blanks;
	for (const char c : line)
		if (c == ' ' || c == '\t')
			blanks += c;
		else
		{
			if (c != ',' && !out.empty() && out.back() != ',')
				out += blanks;
			blanks.clear();
			out += c;
		}
	return out;
}

std::string TextOf(const std::string& file, const std::string& header)
{
	if (file != "-")
		return ReadText(file, fmt::format("a CSV file with the header {}", header));
	return { std::istreambuf_iterator<char>(std::cin), std::istreambuf_iterator<char>() };
}

}

std::vector<CsvRow> ReadCsvRows(const std::string& file, const std::string& header)
{
	std::istringstream in(WithUnixLines(TextOf(file, header)));
	std::vector<CsvRow> rows;
	std::string text;
	bool begun = false;
	for (int line = 1; std::getline(in, text); ++line)
	{
		const std::string stripped = Stripped(text);
		if (stripped.empty() || stripped[0] == '#')
			continue;
		if (begun)
			rows.push_back({ stripped, line });
		else if (stripped != header)
			throw FileError(fmt::format("{}:{}: '{}' is not the header {}", file, line, OneLine(stripped.substr(0, 60)), header));
		begun = true;
	}
	if (!begun)
		throw FileError(fmt::format("{}:1: is empty; the header is {}", file, header));
	return rows;
}

std::optional<std::vector<double>> NumbersBetweenCommas(const std::string& text, size_t count, size_t at)
{
	std::vector<double> values;
	for (size_t k = 0; k < count; ++k, ++at)
	{
		const std::optional<double> value = NumberAt(text, at);
		if (!value || !std::isfinite(*value) || (k + 1 < count ? text[at] != ',' : at != text.size()))
			return std::nullopt;
		values.push_back(*value);
	}
	return values;
}

}
