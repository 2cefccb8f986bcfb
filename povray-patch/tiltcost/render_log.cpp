// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is read from POV-Ray's message stream.

#include "tiltcost/pilot_run.h"

#include "lens/pilot.h"

#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace tiltcost
{

namespace
{

bool Contains(const std::string& text, const char* what) { return text.find(what) != std::string::npos; }

/// POV-Ray returns the carriage in its progress.
std::vector<std::string> Lines(const std::string& log)
{
	std::vector<std::string> lines(1);
	for (const char c : log)
		if (c == '\n' || c == '\r')
			lines.emplace_back();
		else
			lines.back() += c;
	return lines;
}

}

RenderLog ReadRenderLog(const std::string& log)
{
	RenderLog read;
	bool tracing = false;
	for (const std::string& line : Lines(log))
	{
		int top, bottom, left, right, threads;
		if (std::sscanf(line.c_str(), " Image resolution.....%d by %d (rows %d to %d, columns %d to %d", &read.width, &read.height, &top, &bottom, &left, &right) == 6)
			read.pixels = double(bottom - top + 1) * (right - left + 1);
		std::sscanf(line.c_str(), " Initial Frame: %d Final Frame: %d", &read.first_frame, &read.last_frame);
		std::sscanf(line.c_str(), " Frame Step: %d", &read.frame_step);
		std::sscanf(line.c_str(), "Rendering frame 1 of %d", &read.rendered_frames);
		if (Contains(line, "Photon Time:"))
			read.photons = !Contains(line, "No photons");
		if (Contains(line, "Radiosity Time:"))
			read.radiosity = !Contains(line, "No radiosity");
		if (Contains(line, "Trace Time:"))
			tracing = true;
		if (tracing && std::sscanf(line.c_str(), " using %d thread", &threads) == 1 && threads > 0)
			read.threads = threads;
		const size_t rays = line.find("Camera Rays:");
		if (rays != std::string::npos)
			read.camera_rays = std::atof(line.c_str() + rays + 12);
		if (line.compare(0, 9, "Aperture:") == 0)
			read.pinhole = Contains(line, "pinhole");
	}
	// The console breaks lines at spaces, and indents.
	std::string words;
	for (const char c : log)
		if (c != '\n' && (c != ' ' || words.empty() || words.back() != ' '))
			words += c;
		else if (c == '\n' && !words.empty() && words.back() != ' ')
			words += ' ';
	read.writes = Contains(words, tilt_lens::PilotWritesNothing);
	return read;
}

std::string ErrorLines(const std::string& log)
{
	const std::vector<std::string> lines = Lines(log);
	const size_t most = 14, last_words = 6;
	size_t from = 0;
	while (from < lines.size() && !Contains(lines[from], "Error") && !Contains(lines[from], "error") && lines[from].compare(0, 6, "File '") != 0 &&
		!Contains(lines[from], "roblem"))
		++from;
	if (from == lines.size())
		from = lines.size() > last_words ? lines.size() - last_words : 0;
	std::string text;
	for (size_t i = from, shown = 0; i < lines.size() && shown < most; ++i)
		if (!lines[i].empty() && lines[i] != "Render failed" && lines[i].compare(0, 4, "----") != 0)
		{
			text += (shown++ ? "\n  " : "  ") + lines[i];
		}
	return text;
}

}
