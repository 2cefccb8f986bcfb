// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/tiltcost_table.h"

#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

std::vector<TiltcostRow> ReadTiltcostTable(const std::filesystem::path& csv)
{
	std::vector<TiltcostRow> rows;
	std::ifstream in(csv);
	std::string line;
	std::getline(in, line);
	while (std::getline(in, line))
	{
		const std::string rest = line.substr(line.rfind('"') + 2); // the scene's name is quoted
		TiltcostRow row;
		if (std::sscanf(rest.c_str(), "%*[^,],%lf,%*f,%lf,%*f,%lf,%*f,%d,%d,%lf,%lf,%*f,%lf,%lf,%lf,%lf,%lf", &row.error, &row.rays, &row.cpu, &row.min, &row.max, &row.variance,
			&row.confidence, &row.denoised_error, &row.denoise_cpu,
			&row.error_sigma, &row.denoised_sigma, &row.time_sigma) != 12)
			throw std::runtime_error("tiltcost wrote " + line);
		rows.push_back(row);
	}
	if (rows.empty())
		throw std::runtime_error("tiltcost wrote no rows into " + csv.string());
	return rows;
}
