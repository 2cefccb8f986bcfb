// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What tilt_lens costs where it has nothing to do, and how its cost grows: a fragment for the race's report.
//
//   race_nothing --ours POVRAY --stock POVRAY --scenes DIR --out DIR --work DIR
//
// Exit 0: all within the limits, or --only-report; 1: not; 2: wrong usage or a program failed.
#include "support/callgrind.h"
#include "support/picture.h"
#include "race_curve.h"
#include "support/run_measured.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace
{

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Bench
{
	fs::path ours, stock, scenes, work;
};

Words Command(const Bench& bench, const fs::path& program, const std::string& scene, int width, const Words& more)
{
	Words command = {program.string(), "-D", "-A", "+FP16", "File_Gamma=1", "+Opicture.ppm",
		"+I" + (bench.scenes / (scene + ".pov")).string(), "+L" + bench.scenes.string(), fmt::format("+W{}", width),
		fmt::format("+H{}", std::max(width * 3 / 4, 1))};
	command.insert(command.end(), more.begin(), more.end());
	if (std::none_of(more.begin(), more.end(), [](const std::string& word) { return word.compare(0, 3, "+WT") == 0; }))
		command.push_back("+WT1");
	return command;
}

Cost Run(const Bench& bench, const fs::path& program, const std::string& scene, int width, const Words& more, Picture* picture = nullptr)
{
	const Cost cost = RunMeasured(Command(bench, program, scene, width, more), bench.work, bench.work / "povray.log");
	if (picture)
		*picture = ReadPpm((bench.work / "picture.ppm").string());
	return cost;
}

// The least of three: what disturbs makes longer.
Cost Least(const Bench& bench, const fs::path& program, const std::string& scene, int width, const Words& more)
{
	Cost least = Run(bench, program, scene, width, more);
	for (int i = 0; i < 2; ++i)
	{
		const Cost cost = Run(bench, program, scene, width, more);
		least = {std::min(least.cpu, cost.cpu), std::min(least.wall, cost.wall), std::max(least.rss, cost.rss)};
	}
	return least;
}

Words Camera(int camera, int samples = 0, double variance = 0, int min = 0)
{
	return {fmt::format("Declare=Race_Camera={}", camera), fmt::format("Declare=Race_Max={}", samples),
		fmt::format("Declare=Race_Min={}", min), fmt::format("Declare=Race_Variance={:g}", variance)};
}

double Instructions(const Bench& bench, const std::string& scene, int width, int camera)
{
	return RunCallgrind(Command(bench, bench.ours, scene, width, Camera(camera)), bench.work).instructions;
}

struct Row
{
	std::string what, found, limit;
	bool good;
};

// Rays of a lens without an aperture are those of perspective, to the pixel and to the instruction.
void Pinhole(const Bench& bench, std::vector<Row>& rows)
{
	for (const std::string scene : {"plain", "glass"})
	{
		Picture perspective, tilt_lens;
		Run(bench, bench.ours, scene, 320, Camera(3), &perspective);
		Run(bench, bench.ours, scene, 320, Camera(4), &tilt_lens);
		const double difference = LargestDifference(perspective, tilt_lens);
		rows.push_back({"aperture 0 against perspective, " + scene + ": largest difference of a pixel",
			fmt::format("{:g}", difference), "0", difference == 0});
		// Less a picture of four pixels: of the parser and of the program's start both have the same.
		const double a = Instructions(bench, scene, 80, 3) - Instructions(bench, scene, 2, 3);
		const double b = Instructions(bench, scene, 80, 4) - Instructions(bench, scene, 2, 4);
		rows.push_back({"the same: instructions of the render (callgrind), ratio", fmt::format("{:.4f} ({:.1f} million)", b / a, b / 1e6),
			"1.01", b / a <= 1.01});
	}
}

// In focus everywhere: what is left is anti-aliasing, and POV-Ray's +A is the peer.
void InFocus(const Bench& bench, std::vector<Row>& rows)
{
	const int width = 160;
	const std::string scene = "focus", sharp = "Declare=Race_Stop=1e-6";
	Picture truth, picture;
	Words words = Camera(1, 4096);
	words.push_back(sharp);
	Run(bench, bench.ours, scene, width, words, &truth);
	const double start_ours = Least(bench, bench.ours, scene, 1, words).cpu, start_stock = Least(bench, bench.stock, scene, 1, Camera(3)).cpu;
	std::vector<CurvePoint> ours, theirs;
	const auto add = [&](std::vector<CurvePoint>& points, const fs::path& program, const Words& options, double start) {
		const double cpu = std::min(Run(bench, program, scene, width, options).cpu, Run(bench, program, scene, width, options, &picture).cpu);
		points.push_back({NetTime(cpu, start), RmsDifference(picture, truth)});
	};
	for (const int samples : {4, 8, 16, 32, 64, 128, 256})
		for (const double variance : {0.0, 1e-3, 1e-4, 1e-5})
		{
			words = Camera(1, samples, variance, variance > 0 ? 4 : 0);
			words.push_back(sharp);
			add(ours, bench.ours, words, start_ours);
		}
	for (const int method : {1, 2})
		for (const double threshold : {0.3, 0.1, 0.03, 0.01})
			for (const int depth : method == 1 ? std::vector<int>{2, 4, 6, 9} : std::vector<int>{2, 3, 4})
				for (const char* jitter : {"+J", "-J"})
				{
					words = Camera(3);
					words.insert(words.end(), {fmt::format("+AM{}", method), fmt::format("+A{:g}", threshold), fmt::format("+R{}", depth), jitter});
					add(theirs, bench.stock, words, start_stock);
				}
	for (const double error : {0.01, 0.005, 0.003})
	{
		const TimeAt own = TimeToReach(Hull(ours), error, false), rival = TimeToReach(Hull(theirs), error, true);
		rows.push_back({fmt::format("in focus everywhere, RMS error {:g}: time of a stock pinhole with the best +A, over ours", error),
			fmt::format("{}{:.2f} ({:.3f} s over {:.3f} s)", rival.reached ? "" : "> ", rival.time / own.time, rival.time, own.time),
			"told", true});
	}
}

// Cost = a + b pixels: the largest departure from the line, in shares of the cost.
void Pixels(const Bench& bench, std::vector<Row>& rows)
{
	std::vector<double> n, t;
	for (const int width : {80, 120, 160, 240})
	{
		n.push_back(width * width * 0.75);
		t.push_back(Least(bench, bench.ours, "foreground", width, Camera(1, 64, 1e-4, 16)).cpu);
	}
	double sn = 0, st = 0, snn = 0, snt = 0;
	for (std::size_t i = 0; i < n.size(); ++i)
	{
		// Weighted by 1/t^2, so that small pictures count.
		const double weight = 1 / (t[i] * t[i]) ;
		sn += weight * n[i];
		st += weight * t[i];
		snn += weight * n[i] * n[i];
		snt += weight * n[i] * t[i];
	}
	double sw = 0, departure = 0;
	for (const double time : t)
		sw += 1 / (time * time);
	const double b = (sw * snt - sn * st) / (sw * snn - sn * sn), a = (st - b * sn) / sw;
	for (std::size_t i = 0; i < n.size(); ++i)
		departure = std::max(departure, std::abs(a + b * n[i] - t[i]) / t[i]);
	rows.push_back({"cost over pixels, 80 × 60 to 240 × 180, adaptive: largest departure from a line",
		fmt::format("{:.1f} % ({:.0f} ms + {:.2f} µs a pixel)", 100 * departure, 1000 * a, 1e6 * b), "10 %", departure <= 0.1});
}

void ThreadsAndMemory(const Bench& bench, std::vector<Row>& rows)
{
	Words one = Camera(1, 64), two = one;
	one.push_back("+WT1");
	two.push_back("+WT2");
	Picture a, b;
	Run(bench, bench.ours, "foreground", 240, one, &a);
	Run(bench, bench.ours, "foreground", 240, two, &b);
	rows.push_back({"two threads against one: largest difference of a pixel", fmt::format("{:g}", LargestDifference(a, b)), "0",
		LargestDifference(a, b) == 0});
	const Cost with_one = Least(bench, bench.ours, "foreground", 320, one), with_two = Least(bench, bench.ours, "foreground", 320, two);
	Words stock_one = one, stock_two = two;
	stock_one[0] = stock_two[0] = "Declare=Race_Camera=0";
	const double stock = Least(bench, bench.stock, "foreground", 320, stock_one).wall / Least(bench, bench.stock, "foreground", 320, stock_two).wall;
	rows.push_back({"the same: wall-clock speed-up (stock's, on the same machine then)",
		fmt::format("{:.2f} ({:.2f})", with_one.wall / with_two.wall, stock), "told", true});
	for (const int width : {160, 640})
	{
		const double ours = Least(bench, bench.ours, "foreground", width, Camera(1, 16)).rss;
		const double theirs = Least(bench, bench.stock, "foreground", width, Camera(0, 16)).rss;
		rows.push_back({fmt::format("memory at {} × {}, largest resident set, ours over stock", width, width * 3 / 4),
			fmt::format("{:.3f} ({:.1f} MiB over {:.1f} MiB)", ours / theirs, ours, theirs), "1.05", ours / theirs <= 1.05});
	}
}

}

int main(int argc, char** argv)
try
{
	Bench bench;
	fs::path out;
	bool only_report = false;
	CLI::App app{"What tilt_lens costs where it has nothing to do."};
	app.add_option("--ours", bench.ours, "the patched povray")->required();
	app.add_option("--stock", bench.stock, "an unpatched povray")->required();
	app.add_option("--scenes", bench.scenes, "folder of the race's scenes")->required();
	app.add_option("--out", out, "folder of the fragment")->required();
	app.add_option("--work", bench.work, "folder of everything else")->required();
	app.add_flag("--only-report", only_report, "exit 0 whatever is found");
	try
	{
		app.parse(argc, argv);
	}
	catch (const CLI::ParseError& error)
	{
		return app.exit(error) == 0 ? 0 : 2;
	}
	for (fs::path* path : {&bench.ours, &bench.stock, &bench.scenes, &bench.work})
		*path = fs::absolute(*path);
	fs::create_directories(bench.work);
	fs::create_directories(out);

	std::vector<Row> rows;
	const std::pair<const char*, void (*)(const Bench&, std::vector<Row>&)> parts[] = {
		{"aperture 0", Pinhole}, {"threads and memory", ThreadsAndMemory}, {"pixels", Pixels}, {"in focus", InFocus}};
	for (const auto& [name, part] : parts)
	{
		std::fprintf(stderr, "race_nothing: %s\n", name);
		const std::size_t first = rows.size();
		part(bench, rows);
		for (std::size_t i = first; i < rows.size(); ++i)
			std::printf("%s%s: %s (%s)\n", rows[i].good ? "" : "MISSED: ", rows[i].what.c_str(), rows[i].found.c_str(), rows[i].limit.c_str());
		std::fflush(stdout);
	}
	std::ofstream file(out / "cost-of-nothing.html");
	file << "<h2>The cost of nothing, and how cost grows</h2>\n<table><tr><th>what</th><th>found</th><th>at most</th></tr>\n";
	bool good = true;
	for (const Row& row : rows)
	{
		file << "<tr><td>" << row.what << "</td><td" << (row.good ? "" : " class=\"lost\"") << ">" << row.found << "</td><td>" << row.limit << "</td></tr>\n";
		good = good && row.good;
	}
	file << "</table>\n";
	if (!file.flush())
		throw std::runtime_error("cannot write " + (out / "cost-of-nothing.html").string());
	return good || only_report ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "race_nothing: %s\n", error.what());
	return 2;
}
