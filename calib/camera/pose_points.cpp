// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/pose_points.h"

#include <tiltcal/error.h>
#include "base/csv_rows.h"
#include "base/plain_text.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <vector>

namespace tiltcal
{

namespace
{

const char* const HEADER = "u_px,v_px,x,y,z";

PosePoint PointOf(const CsvRow& row, const std::string& file)
{
	const bool nowhere = row.text.rfind(",,", 0) == 0;
	const std::optional<std::vector<double>> v = nowhere ? NumbersBetweenCommas(row.text, 3, 2) : NumbersBetweenCommas(row.text, 5);
	if (!v)
		throw FileError(fmt::format("{}:{}: '{}' is not five numbers {}; a point whose pixel is to be found begins with two commas", file, row.line,
			OneLine(row.text.substr(0, 60)), HEADER));
	const double none = std::numeric_limits<double>::quiet_NaN();
	if (nowhere)
		return { none, none, { (*v)[0], (*v)[1], (*v)[2] }, row.line, Placed::NOWHERE };
	return { (*v)[0], (*v)[1], { (*v)[2], (*v)[3], (*v)[4] }, row.line, Placed::GIVEN };
}

}

std::vector<PosePoint> ReadPosePoints(const std::string& file)
{
	std::vector<PosePoint> points;
	for (const CsvRow& row : ReadCsvRows(file, HEADER))
		points.push_back(PointOf(row, file));
	return points;
}

}
