// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Damaged picture files against tiltcal's reader and detector, in this process: what is read
// must be read or refused as a file at fault, by name, in one line, within seconds. The file
// at hand is WORK/current; after a crash or a hang it is the culprit.
// Exit code 0: no failure, 1: some, 2: hang (or the sanitizer's own).

#include "damage.h"
#include "support/picture_seeds.h"

#include <tiltcal/error.h>
#include "picture/exif.h"
#include "picture/image_io.h"
#include "measure/measure.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <opencv2/core/utils/logger.hpp>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <unistd.h>

namespace
{

struct Options
{
	std::string work = "fuzz-images";
	int files = 10000, timeout_s = 20, detect_every = 10;
	std::uint64_t seed = 1, only = ~0ull;
};

struct Counts
{
	int read = 0, refused = 0, measured = 0, no_board = 0, failures = 0;
	double slowest = 0;
	std::map<std::string, int> reasons;
};

void OnAlarm(int)
{
	const char text[] = "fuzz_images: hang on WORK/current\n";
	if (write(STDERR_FILENO, text, sizeof(text) - 1) < 0)
		_exit(3);
	_exit(2);
}

/// One line that names the file.
bool IsGood(const tiltcal::Error& e, const std::string& file)
{
	const std::string what = e.what();
	return what.find(file) != std::string::npos && what.find('\n') == std::string::npos && what.size() < 1000;
}

/// Words up to the second colon, without digits: a kind of refusal.
std::string Reason(const std::string& what, const std::string& file)
{
	std::string text = what.substr(std::min(what.size(), file.size() + 2), 60), kind;
	for (const char c : text.substr(0, text.find(':')))
		if (!std::isdigit(static_cast<unsigned char>(c)) && static_cast<unsigned char>(c) >= ' ')
			kind += c;
	return kind;
}

void Try(const std::string& file, bool detect, Counts& counts)
{
	bool read = false;
	try
	{
		// Before the pixels, as calibrate does without --pitch: a damaged file may have them.
		tiltcal::Describe(tiltcal::ReadFacts(file));
		const cv::Mat image = tiltcal::ReadLinear(file, tiltcal::Transfer());
		read = true;
		++counts.read;
		// What is as large as a photograph says nothing more and takes its time.
		if (!detect || image.total() > 4'000'000)
			return;
		tiltcal::MeasurePhoto(file, tiltcal::ParseBoard("7x5", 25), tiltcal::Transfer(), {});
		++counts.measured;
	}
	catch (const tiltcal::Error& e)
	{
		if (!IsGood(e, file) || (!read && e.Code() != tiltcal::EXIT_FILE) || (read && e.Code() != tiltcal::EXIT_REFUSED))
			throw std::runtime_error(fmt::format("bad refusal, exit code {}: {}", int(e.Code()), e.what()));
		++(read ? counts.no_board : counts.refused);
		if (!read)
			++counts.reasons[Reason(e.what(), file)];
	}
}

void RunOne(const Options& o, const std::vector<PictureSeed>& seeds, std::uint64_t index, Counts& counts)
{
	Random random(o.seed, index);
	const PictureSeed& seed = seeds[size_t(random.Below(int(seeds.size())))];
	const PictureSeed& other = seeds[size_t(random.Below(int(seeds.size())))];
	const std::string file = o.work + "/current";
	std::ofstream(file, std::ios::binary) << Damaged(seed.bytes, other.bytes, random);
	const auto start = std::chrono::steady_clock::now();
	alarm(unsigned(o.timeout_s));
	try
	{
		Try(file, index % std::uint64_t(o.detect_every) == 0, counts);
	}
	catch (const std::exception& e)
	{
		++counts.failures;
		const std::string kept = fmt::format("{}/failure-{}-{}", o.work, index, seed.name);
		std::filesystem::copy_file(file, kept, std::filesystem::copy_options::overwrite_existing);
		fmt::print("FAILURE {}: {}\n", kept, e.what());
	}
	alarm(0);
	const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
	if (seconds > 5)
		fmt::print("slow: index {} ({}): {:.1f} s\n", index, seed.name, seconds);
	counts.slowest = std::max(counts.slowest, seconds);
}

/// The undamaged ones must be read and the board be found: else the fuzzer tests nothing.
int Control(const Options& o, const std::vector<PictureSeed>& seeds)
{
	int bad = 0;
	for (const PictureSeed& seed : seeds)
	{
		Counts counts;
		try
		{
			Try(o.work + "/" + seed.name, true, counts);
		}
		catch (const std::exception& e)
		{
			fmt::print("{}: {}\n", seed.name, e.what());
		}
		if (counts.measured != 1)
		{
			fmt::print("FAILURE {}: the undamaged file is not measured\n", seed.name);
			++bad;
		}
	}
	return bad;
}

int Run(const Options& o)
{
	std::filesystem::create_directories(o.work);
	std::signal(SIGALRM, OnAlarm);
	const std::vector<PictureSeed> seeds = PictureSeeds(o.work);
	Counts counts;
	counts.failures = Control(o, seeds);
	if (o.only != ~0ull)
		RunOne(o, seeds, o.only, counts);
	else
		for (int i = 0; i < o.files; ++i)
			RunOne(o, seeds, std::uint64_t(i), counts);
	for (const auto& [reason, n] : counts.reasons)
		fmt::print("{:6} refused: {}\n", n, reason);
	fmt::print("{} damaged files of seed {} from {} whole ones: {} read, {} refused; of those looked at, board measured in {}, none in {}; slowest {:.2f} s; {} failures\n",
		o.only != ~0ull ? 1 : o.files, o.seed, seeds.size(), counts.read, counts.refused, counts.measured, counts.no_board, counts.slowest, counts.failures);
	return counts.failures ? 1 : 0;
}

}

int main(int argc, char** argv)
{
	cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
	Options o;
	CLI::App app("Damages picture files and has tiltcal read them.", "fuzz_images");
	app.add_option("--work", o.work, "Folder for the files")->capture_default_str();
	app.add_option("--files", o.files, "How many")->envname("TILT_LENS_FUZZ_IMAGES")->capture_default_str();
	app.add_option("--seed", o.seed, "Of the random numbers")->envname("TILT_LENS_FUZZ_SEED")->capture_default_str();
	app.add_option("--only", o.only, "This index alone, to look at it");
	app.add_option("--timeout", o.timeout_s, "Seconds for one file")->capture_default_str();
	app.add_option("--detect-every", o.detect_every, "Look for the board in each n-th")->capture_default_str()->check(CLI::PositiveNumber);
	CLI11_PARSE(app, argc, argv);
	try
	{
		return Run(o);
	}
	catch (const std::exception& e)
	{
		fmt::print(stderr, "fuzz_images: {}\n", e.what());
		return 1;
	}
}
