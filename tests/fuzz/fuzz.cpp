// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Renders random camera blocks, each by a POV-Ray process of its own, and demands that each either gives finite pixels or
// ends with a parse error that names file and line. What does neither is kept with its log in WORK/failures.
//
//   fuzz --povray build/asan/bin/povray --work /tmp/fuzz --blocks 20000 --seed 1
//   fuzz --povray build/asan/bin/povray --work /tmp/fuzz --seed 1 --only 4711     one block again
//   fuzz --povray build/asan/bin/povray --work /tmp/fuzz --scene FILE             a scene of your own

#include <sys/resource.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <list>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "run_block.h"

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Run
{
	std::uint64_t index;
	Block block;
	fs::path folder;
	Clock::time_point start;
	int attempts = 1;
};

struct Running
{
	Run run;
	tiltcal::Process process;
};

struct Settings
{
	std::string povray;
	fs::path work, scene;
	std::uint64_t seed = 1, blocks = 20000, only = 0;
	int jobs = 0;
	double timeout = 20;
};

class Fuzzer
{
	public:
		explicit Fuzzer(const Settings& s) : settings(s), began(Clock::now()) {}

		int Go()
		{
			fs::remove_all(settings.work / "failures");
			for (int slot = 0; slot < settings.jobs; slot++)
				free_folders.push_back(settings.work / ("slot-" + std::to_string(slot)));

			const std::uint64_t first = settings.only ? settings.only : 1;
			const std::uint64_t last = settings.only ? settings.only : settings.blocks;
			for (std::uint64_t next = first; next <= last || !running.empty();)
			{
				while (next <= last && !free_folders.empty())
					Launch(next++);
				Collect();
			}
			Summary();
			for (const fs::path& folder : free_folders)
				fs::remove_all(folder);
			return failures == 0 && SawPictures() ? 0 : 1;
		}

	private:
		Block BlockAt(std::uint64_t index) const
		{
			if (settings.scene.empty())
				return CameraBlock(settings.seed, index);
			std::ifstream file(settings.scene, std::ios::binary);
			return { std::string(std::istreambuf_iterator<char>(file), {}), {} };
		}

		void Launch(std::uint64_t index)
		{
			Run run{ index, BlockAt(index), free_folders.back(), Clock::now(), 1 };
			free_folders.pop_back();
			Begin(std::move(run));
		}

		void Begin(Run run)
		{
			run.start = Clock::now();
			tiltcal::Process process = Start(run.block, settings.povray, run.folder, settings.timeout);
			running.push_back({ std::move(run), std::move(process) });
		}

		// Takes what has ended, and sleeps where nothing has.
		void Collect()
		{
			bool any = false;
			for (auto one = running.begin(); one != running.end();)
			{
				const std::optional<tiltcal::ProcessResult> result = one->process.Poll();
				if (!result)
				{
					++one;
					continue;
				}
				any = true;
				Run ended = std::move(one->run);
				one = running.erase(one);
				const Outcome outcome = Judge(ended.block, *result, ended.folder);
				if (outcome == Outcome::NotStarted && ended.attempts++ < 5)
					Begin(std::move(ended));
				else
					Finish(ended, outcome);
			}
			if (!any)
				std::this_thread::sleep_for(std::chrono::milliseconds(2));
		}

		void Finish(const Run& run, Outcome outcome)
		{
			counts[int(outcome)]++;
			done++;
			slowest = std::max(slowest, Seconds(run.start));
			if (IsFailure(outcome) || settings.only)
			{
				const fs::path kept = settings.work / "failures" / (std::to_string(run.index) + "-" + Name(outcome));
				failures += IsFailure(outcome);
				fs::create_directories(kept.parent_path());
				fs::rename(run.folder, kept);
				std::string options;
				for (const std::string& option : run.block.options)
					options += option + " ";
				std::printf("%s: block %llu: %s (%s)\n", IsFailure(outcome) ? "FAILED" : "kept", static_cast<unsigned long long>(run.index),
					kept.c_str(), options.c_str());
			}
			if (done % std::max<std::uint64_t>(1, settings.blocks / 20) == 0 && !settings.only)
				std::printf("%6llu blocks, %.0f s, %d failures\n", static_cast<unsigned long long>(done), Seconds(began), failures);
			std::fflush(stdout);
			free_folders.push_back(run.folder);
		}

		// Blocks that are all refused show nothing: the generator, or the program, has changed.
		bool SawPictures() const
		{
			if (settings.only || counts[int(Outcome::Rendered)] > 0)
				return true;
			std::printf("FAILED: no block was rendered\n");
			return false;
		}

		void Summary() const
		{
			const double seconds = Seconds(began);
			std::printf("seed %llu, %llu blocks in %.0f s (%.0f ms each, the slowest %.1f s)\n",
				static_cast<unsigned long long>(settings.seed), static_cast<unsigned long long>(done), seconds,
				1000.0 * seconds / double(std::max<std::uint64_t>(1, done)), slowest);
			for (int i = 0; i < Outcomes; i++)
				std::printf("%8llu %s%s\n", static_cast<unsigned long long>(counts[i]), Name(Outcome(i)), IsFailure(Outcome(i)) ? " (failure)" : "");
		}

		static double Seconds(Clock::time_point since)
		{
			return std::chrono::duration<double>(Clock::now() - since).count();
		}

		const Settings settings;
		const Clock::time_point began;
		std::vector<fs::path> free_folders;
		std::list<Running> running;
		std::uint64_t counts[Outcomes] = {}, done = 0;
		int failures = 0;
		double slowest = 0;
};

int main(int argc, char** argv)
try
{
	Settings settings;
	CLI::App app("Fuzzer of tilt_lens camera blocks");
	app.add_option("--povray", settings.povray, "The program to test")->required()->check(CLI::ExistingFile);
	app.add_option("--work", settings.work, "Folder for scenes and failures")->required();
	app.add_option("--blocks", settings.blocks, "Number of blocks")->envname("TILT_LENS_FUZZ_BLOCKS")->capture_default_str();
	app.add_option("--seed", settings.seed, "Seed of the blocks")->envname("TILT_LENS_FUZZ_SEED")->capture_default_str();
	app.add_option("--only", settings.only, "Run this block only, and keep what it leaves");
	app.add_option("--scene", settings.scene, "Run this scene file only, and keep what it leaves")->check(CLI::ExistingFile);
	app.add_option("--jobs", settings.jobs, "Processes at a time (default: 16 per core; they mostly sleep)");
	app.add_option("--timeout", settings.timeout, "Seconds after which a process hangs")->capture_default_str();
	CLI11_PARSE(app, argc, argv);
	if (!settings.scene.empty())
		settings.only = 1;
	if (settings.jobs <= 0)
		settings.jobs = 16 * std::max(1, int(std::thread::hardware_concurrency()));
	settings.povray = fs::absolute(settings.povray).string();
	settings.work = fs::absolute(settings.work);

	// Upstream leaves its memory behind at parse errors, and deletes its ShelloutProcessing, which lacks a virtual
	// destructor, through a pointer to the base at the end of every render: neither is looked for.
	// (Of an option that is given twice the last counts.)
	const char* given = std::getenv("ASAN_OPTIONS");
	setenv("ASAN_OPTIONS", (std::string(given ? given : "") + ":detect_leaks=0:new_delete_type_mismatch=0").c_str(), 1);
	setenv("UBSAN_OPTIONS", "print_stacktrace=1", 0);
	// What crashes is to leave no cores behind; limits are inherited.
	const rlimit no_core = { 0, 0 };
	setrlimit(RLIMIT_CORE, &no_core);
	return Fuzzer(settings).Go();
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "fuzz: %s\n", error.what());
	return 2;
}
