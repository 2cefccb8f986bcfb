// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/point_lists.h"

#include "base/csv_rows.h"
#include "base/plain_text.h"
#include "exchange/maps.h"

#include <tiltcal/error.h>

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace tiltcal
{

namespace
{

std::vector<double> NumbersOf(const CsvRow& row, size_t count, const std::string& header, const std::string& file)
{
	const std::optional<std::vector<double>> values = NumbersBetweenCommas(row.text, count);
	if (!values)
		throw FileError(fmt::format("{}:{}: '{}' is not {} numbers {}", file, row.line, OneLine(row.text.substr(0, 60)), count, header));
	return *values;
}

}

std::string ProjectedPoints(const StateCamera& camera, const std::string& file)
{
	const std::string header = "x,y,z";
	std::string out = header + ",u_px,v_px,blur_px\n";
	for (const CsvRow& row : ReadCsvRows(file, header))
	{
		const std::vector<double> x = NumbersOf(row, 3, header, file);
		const Vec3<double> P{ x[0], x[1], x[2] };
		const std::optional<Point> pixel = Project(camera, P);
		out += fmt::format("{:.12g},{:.12g},{:.12g},", P.x, P.y, P.z);
		// 1e-9 px: more digits than any camera has.
		out += pixel ? fmt::format("{:.9f},{:.9f},{}\n", (*pixel)[0], (*pixel)[1], camera.KnowsFocus() ? fmt::format("{:.9f}", BlurWidth(camera, P)) : "") : ",,\n";
	}
	return out;
}

std::string UnprojectedPixels(const StateCamera& camera, const std::string& file)
{
	const std::string header = "u_px,v_px";
	std::string out = header + ",x,y,z,focus_z_mm\n";
	for (const CsvRow& row : ReadCsvRows(file, header))
	{
		const std::vector<double> p = NumbersOf(row, 2, header, file);
		const std::optional<Vec3<double>> v = Unproject(camera, { p[0], p[1] });
		const double length = v ? std::sqrt(Dot(*v, *v)) : 0;
		out += fmt::format("{:.12g},{:.12g},", p[0], p[1]);
		out += v ? fmt::format("{:.15g},{:.15g},{:.15g},{}\n", v->x / length, v->y / length, v->z / length, camera.KnowsFocus() ? fmt::format("{:.12g}", FocusDepth(camera, *v)) : "") : ",,,\n";
	}
	return out;
}

}
