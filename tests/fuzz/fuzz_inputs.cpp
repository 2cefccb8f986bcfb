// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Damaged JSON, CSV, YAML, XML and lines against tiltcal's readers, in this process: what is given is taken or refused by name, in one
// line, within seconds, and what comes out holds numbers. The input at hand is WORK/current.*; after a crash or a hang it is the culprit.
// Exit code 0: no failure, 1: some, 2: hang (or the sanitizer's own).

#include "damage_text.h"
#include "inputs.h"

#include "calibrate/quiet.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <unistd.h>

namespace
{

struct Options
{
	std::string work = "fuzz-inputs";
	int inputs = 100000, timeout_s = 20;
	std::uint64_t seed = 1, only = ~0ull;
};

struct Counts
{
	int taken = 0, refused = 0;
};

void OnAlarm(int)
{
	const char text[] = "fuzz_inputs: hang on WORK/current.*\n";
	if (write(STDERR_FILENO, text, sizeof(text) - 1) < 0)
		_exit(3);
	_exit(2);
}

/// False on a failure, which is kept.
bool RunOne(const Options& o, const Input& input, const std::string& name, Counts& counts)
{
	alarm(unsigned(o.timeout_s));
	bool good = true;
	try
	{
		++(TryInput(input, o.work) ? counts.taken : counts.refused);
	}
	catch (const std::exception& e)
	{
		good = false;
		const std::string kept = fmt::format("{}/failure-{}.{}", o.work, name, NameOf(input.kind));
		std::ofstream(kept, std::ios::binary) << input.bytes;
		fmt::print("FAILURE {}: {}\n", kept, std::string(e.what()).substr(0, 600));
	}
	alarm(0);
	return good;
}

Input DamagedInput(const std::vector<Input>& seeds, std::uint64_t seed, std::uint64_t index)
{
	Random random(seed, index);
	const Input& input = seeds[size_t(random.Below(int(seeds.size())))];
	const Input& other = seeds[size_t(random.Below(int(seeds.size())))];
	return { input.kind, DamagedText(input.bytes, other.bytes, random) };
}

int Run(const Options& o)
{
	std::filesystem::create_directories(o.work);
	std::signal(SIGALRM, OnAlarm);
	const std::vector<Input> seeds = InputSeeds(o.work);
	std::map<InputKind, Counts> counts;
	int failures = 0;
	// The undamaged ones must be taken: else the fuzzer tests nothing.
	for (const Input& seed : seeds)
	{
		Counts whole;
		if (!RunOne(o, seed, "whole", whole) || whole.taken != 1)
		{
			fmt::print("FAILURE: the undamaged {} is not taken\n", NameOf(seed.kind));
			++failures;
		}
	}
	const std::uint64_t first = o.only != ~0ull ? o.only : 0, end = o.only != ~0ull ? o.only + 1 : std::uint64_t(o.inputs);
	for (std::uint64_t i = first; i < end; ++i)
	{
		const Input input = DamagedInput(seeds, o.seed, i);
		failures += !RunOne(o, input, std::to_string(i), counts[input.kind]);
	}
	for (const auto& [kind, n] : counts)
		fmt::print("{:5} taken {:6}, refused {:6}\n", NameOf(kind), n.taken, n.refused);
	fmt::print("{} damaged inputs of seed {}: {} failures\n", end - first, o.seed, failures);
	return failures ? 1 : 0;
}

}

int main(int argc, char** argv)
{
	const tiltcal::QuietLibraries quiet;
	Options o;
	CLI::App app("Damages JSON, CSV, YAML and XML files and has tiltcal read them.", "fuzz_inputs");
	app.add_option("--work", o.work, "Folder for the files")->capture_default_str();
	app.add_option("--inputs", o.inputs, "How many")->envname("TILT_LENS_FUZZ_INPUTS")->capture_default_str();
	app.add_option("--seed", o.seed, "Of the random numbers")->envname("TILT_LENS_FUZZ_SEED")->capture_default_str();
	app.add_option("--only", o.only, "This index alone, to look at it");
	app.add_option("--timeout", o.timeout_s, "Seconds for one input")->capture_default_str();
	CLI11_PARSE(app, argc, argv);
	try
	{
		return Run(o);
	}
	catch (const std::exception& e)
	{
		fmt::print(stderr, "fuzz_inputs: {}\n", e.what());
		return 1;
	}
}
