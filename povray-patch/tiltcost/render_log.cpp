// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is read from POV-Ray's message stream.

#include "tiltcost/pilot_run.h"

#include "lens/pilot.h"

#include <algorithm>
#include <cctype>
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

/// Whether `text` begins with these letters, large or small.
bool BeginsWith(const std::string& text, const std::string& letters)
{
	return text.size() >= letters.size() && std::equal(letters.begin(), letters.end(), text.begin(), [](char a, char b) { return std::tolower(a) == std::tolower(b); });
}

/// The number of a frame that the last of the options +`letters`N and `word`N says; none where none does, or it says a part of the animation (0.5).
std::optional<int> FrameNamed(const std::vector<std::string>& options, const std::string& letters, const std::string& word)
{
	std::optional<int> number;
	for (const std::string& option : options)
		for (const std::string& name : {"+" + letters, "-" + letters, word})
			if (BeginsWith(option, name))
			{
				char* end = nullptr;
				const long said = std::strtol(option.c_str() + name.size(), &end, 10);
				number = *end == '\0' && said > 0 ? std::optional<int>(int(said)) : std::nullopt;
			}
	return number;
}

}

std::optional<FrameRange> RenderedFrames(const RenderLog& log, const std::vector<std::string>& options)
{
	const int others = log.rendered_frames - 1;
	if (log.first_frame + others == log.last_frame)
		return FrameRange{log.first_frame, log.last_frame};
	// Which part is on the command line, or nowhere that POV-Ray tells of: an ini file may say where it begins, and these options where it ends.
	if (const std::optional<int> last = FrameNamed(options, "EF", "Subset_End_Frame="))
	{
		const int end = std::min(*last, log.last_frame);
		return FrameRange{end - others, end};
	}
	if (const std::optional<int> first = FrameNamed(options, "SF", "Subset_Start_Frame="))
	{
		const int begin = std::max(*first, log.first_frame);
		return FrameRange{begin, begin + others};
	}
	return {};
}

RenderLog ReadRenderLog(const std::string& log)
{
	RenderLog read;
	bool tracing = false;
	for (const std::string& line : Lines(log))
	{
		int top, bottom, left, right, threads;
		if (std::sscanf(line.c_str(), " Image resolution.....%d by %d (rows %d to %d, columns %d to %d", &read.width, &read.height, &top, &bottom, &left, &right) == 6)
		{
			read.pixels = double(bottom - top + 1) * (right - left + 1);
			read.rows = bottom - top + 1;
		}
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
