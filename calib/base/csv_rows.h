// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Lists of numbers as text.

#ifndef TILTCAL_CSV_ROWS_H
#define TILTCAL_CSV_ROWS_H

#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

struct CsvRow
{
	std::string text;   ///< without blanks beside commas and at its ends
	int line = 0;       ///< of the file, for messages
};

/// The rows below the header, which must be `header`. Empty lines and lines that begin with # are passed over. `file` "-": standard
/// input. Throws FileError with file:line: unreadable, another header.
std::vector<CsvRow> ReadCsvRows(const std::string& file, const std::string& header);

/// The finite numbers that text[at..] is, `count` of them between commas, or none.
std::optional<std::vector<double>> NumbersBetweenCommas(const std::string& text, size_t count, size_t at = 0);

}

#endif
