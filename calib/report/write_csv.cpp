// SPDX-License-Identifier: AGPL-3.0-or-later

#include "report/write_csv.h"

#include <tiltcal/photo.h>
#include "base/plain_text.h"
#include <fmt/format.h>

namespace tiltcal
{

std::string CsvField(const std::string& any)
{
	const std::string text = CleanUtf8(any);
	if (text.find_first_of(",\"\r\n") == std::string::npos)
		return text;
	std::string quoted = "\"";
	for (const char c : text)
		quoted += c == '"' ? "\"\"" : std::string(1, c);
	return quoted + "\"";
}

std::string CornersCsv(const std::vector<Photo>& photos)
{
	std::string csv = "file,column,row,x_px,y_px,sigma_px\n";
	for (const Photo& photo : photos)
		for (const Corner& c : photo.corners)
			csv += fmt::format("{},{},{},{:.4f},{:.4f},{:.4f}\n", CsvField(photo.file), c.column, c.row, c.x, c.y, c.sigma);
	return csv;
}

std::string PhotographsCsv(const Calibration& c)
{
	std::string csv = "state,file,edges,corners_px,corners_of_others_px,blur_px,blur_of_others_px,stands_out,fits_state,same_as\n";
	for (const PhotographCheck& p : c.photographs)
		csv += fmt::format("{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{}\n", c.task.states[p.state].name, CsvField(c.task.states[p.state].photos[p.photo].file), p.edges, p.rms_places,
			p.places_typical, p.rms_blur, p.blur_typical, int(p.odd_places || p.odd_blur), p.fits_state ? c.task.states[*p.fits_state].name : "",
			p.same_as ? CsvField(c.task.states[p.same_as->first].photos[p.same_as->second].file) : "");
	return csv;
}

std::string EdgesCsv(const std::vector<Photo>& photos)
{
	std::string csv = "file,x_px,y_px,nx,ny,blur_px,sigma_px\n";
	for (const Photo& photo : photos)
		for (const Edge& e : photo.edges)
			csv += fmt::format("{},{:.4f},{:.4f},{:.6f},{:.6f},{:.4f},{:.4f}\n", CsvField(photo.file), e.x, e.y, e.nx, e.ny, e.blur, e.blur_sigma);
	return csv;
}

}
