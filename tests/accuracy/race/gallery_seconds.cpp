// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Seconds at equal error for the pictures of the gallery, as their documents' commands make them: raw, and with denoise.
//
//   gallery_seconds --tiltcost TILTCOST --povray POVRAY --root REPOSITORY [--only FOLDER ...] --out DIR
//
// The commands are the lines of scenes/*/README.md that start with "    build/release/bin/povray scenes/" and write a picture there;
// what they would take is tiltcost's prediction. Writes gallery-seconds.html, a fragment for the report.

#include "base/plain_text.h"
#include "race_curve.h"
#include "support/run_measured.h"
#include "support/tiltcost_table.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

const double Errors[] = {0.01, 0.005, 0.003};

struct Shot
{
	std::string picture; // below scenes/
	std::vector<std::string> words; // scene file and options for tiltcost
};

// By folder, in the order of its document.
std::vector<Shot> Shots(const fs::path& root, const std::vector<std::string>& only)
{
	const std::string start = "    build/release/bin/povray scenes/";
	std::set<fs::path> folders;
	for (const auto& entry : fs::directory_iterator(root / "scenes"))
		if (fs::exists(entry.path() / "README.md") && (only.empty() || std::find(only.begin(), only.end(), entry.path().filename()) != only.end()))
			folders.insert(entry.path());
	std::vector<Shot> shots;
	for (const fs::path& folder : folders)
	{
		std::ifstream readme(folder / "README.md");
		for (std::string line; std::getline(readme, line);)
		{
			if (line.compare(0, start.size(), start) != 0)
				continue;
			Shot shot;
			std::istringstream in(line);
			std::string word;
			in >> word; // the program
			while (in >> word)
			{
				if (word.compare(0, 9, "+Oscenes/") == 0)
					shot.picture = word.substr(9);
				else if (word.compare(0, 2, "+F") != 0 && word.compare(0, 2, "+A") != 0 && word.compare(0, 2, "+O") != 0)
					shot.words.push_back(word);
			}
			if (!shot.picture.empty())
				shots.push_back(shot);
		}
	}
	return shots;
}

struct Seconds
{
	std::string why_not; // tiltcost's words, where there is no prediction
	std::vector<TimeAt> raw, denoised; // at Errors
};

// What the program said that it minds, or its last words.
std::string Complaint(const fs::path& file)
{
	const std::string error = "tiltcost: error: ";
	std::ifstream in(file);
	std::string said;
	for (std::string line; std::getline(in, line);)
	{
		if (line.compare(0, error.size(), error) == 0)
		{
			said = line.substr(error.size());
			// What it quotes stands on the next line.
			if (std::getline(in, line) && line.find_first_not_of(" \t\r") != std::string::npos)
				said += " " + line.substr(line.find_first_not_of(" \t\r"));
			return said;
		}
		if (line.find_first_not_of(" \t\r") != std::string::npos)
			said = line;
	}
	return said;
}

Seconds Ask(const std::string& tiltcost, const std::string& povray, const fs::path& root, const fs::path& work, const Shot& shot)
{
	const fs::path csv = work / "gallery.csv", log = work / "gallery.log";
	fs::remove(csv);
	std::vector<std::string> command = {tiltcost, "--povray", povray, "--csv", csv.string()};
	command.insert(command.end(), shot.words.begin(), shot.words.end());
	Seconds seconds;
	try
	{
		RunMeasured(command, root, log);
	}
	catch (const std::runtime_error&)
	{
		seconds.why_not = Complaint(log);
		return seconds;
	}
	std::vector<CurvePoint> raw, denoised;
	for (const TiltcostRow& row : ReadTiltcostTable(csv))
	{
		raw.push_back({row.cpu, row.error});
		if (row.denoised_error > 0)
			denoised.push_back({row.cpu + row.denoise_cpu, row.denoised_error});
	}
	denoised.insert(denoised.end(), raw.begin(), raw.end()); // where it is not quicker it is left out
	for (const double error : Errors)
	{
		seconds.raw.push_back(TimeToReach(Hull(raw), error, false));
		seconds.denoised.push_back(TimeToReach(Hull(denoised), error, false));
	}
	return seconds;
}

std::string Cell(const TimeAt& at)
{
	return fmt::format("<td>{}{:.3g}</td>", at.reached ? "" : "~", at.time);
}

void Write(const fs::path& file, const std::vector<std::pair<Shot, Seconds>>& rows)
{
	std::string html = "<h2>The gallery</h2>\n<p>CPU seconds of the gallery's pictures, in the sizes of their commands, at equal RMS error, as tiltcost predicts: raw, and with <code>denoise</code> where that is "
		"quicker. ~: beyond its table.</p>\n<table><tr><th></th>";
	for (const double error : Errors)
		html += fmt::format("<th>{0:g}, raw</th><th>denoised</th>", error);
	html += "</tr>\n";
	for (const auto& [shot, seconds] : rows)
	{
		html += "<tr><td>" + shot.picture + "</td>";
		for (std::size_t i = 0; i < seconds.raw.size(); ++i)
			html += Cell(seconds.raw[i]) + Cell(seconds.denoised[i]);
		html += seconds.why_not.empty() ? "</tr>\n" : fmt::format("<td colspan=\"{}\">{}</td></tr>\n", 2 * std::size(Errors), tiltcal::HtmlText(seconds.why_not));
	}
	const fs::path partial = fs::path(file) += ".partial";
	std::ofstream(partial) << html << "</table>\n";
	fs::rename(partial, file);
}

}

int main(int argc, char** argv)
try
{
	std::string tiltcost, povray;
	fs::path root, out;
	std::vector<std::string> only;
	CLI::App app{"Seconds at equal error for the gallery"};
	app.add_option("--tiltcost", tiltcost)->required();
	app.add_option("--povray", povray)->required();
	app.add_option("--root", root, "the repository")->required();
	app.add_option("--only", only, "these folders of scenes alone");
	app.add_option("--out", out, "folder of gallery-seconds.html")->required();
	CLI11_PARSE(app, argc, argv);
	fs::create_directories(out);
	std::vector<std::pair<Shot, Seconds>> rows;
	const std::vector<Shot> shots = Shots(root, only);
	if (shots.empty())
		throw std::runtime_error("no commands in " + (root / "scenes").string());
	bool any = false;
	for (const Shot& shot : shots)
	{
		const Seconds s = Ask(fs::absolute(tiltcost).string(), fs::absolute(povray).string(), root, fs::absolute(out), shot);
		fmt::print("{:<34}", shot.picture);
		for (std::size_t i = 0; i < s.raw.size(); ++i)
			fmt::print("  {:g}: {:.3g} / {:.3g} s", Errors[i], s.raw[i].time, s.denoised[i].time);
		fmt::print("{}\n", s.why_not);
		std::fflush(stdout);
		any |= s.why_not.empty();
		rows.emplace_back(shot, s);
	}
	Write(out / "gallery-seconds.html", rows);
	return any ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "gallery_seconds: %s\n", error.what());
	return 2;
}
