// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/options.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace tiltcost
{

namespace
{

/// The program's own folder.
std::string Beside(const std::string& name)
{
	std::error_code code;
	const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", code);
	return code ? name : (self.parent_path() / name).string();
}

/// Whether a word of the command line is meant for POV-Ray: +W640, -A, Declare=X=1.
bool IsForPovray(const std::string& word)
{
	if (word.size() > 1 && word[0] == '+')
		return true;
	if (word.size() > 1 && word[0] == '-')
		return word[1] != '-' && word != "-h";
	size_t letters = 0;
	while (letters < word.size() && (std::isalpha(static_cast<unsigned char>(word[letters])) || word[letters] == '_'))
		++letters;
	return letters > 0 && letters < word.size() && word[letters] == '=';
}

/// Splits the command line, the order within each part kept. Scene and ini files are in both: which of POV-Ray's options an ini file
/// overrides depends on where it stands among them.
void Split(int argc, char** argv, std::vector<std::string>& own, std::vector<std::string>& povray)
{
	bool first = true;
	for (int i = 1; i < argc; ++i)
	{
		const std::string word = argv[i];
		const bool option = word.compare(0, 2, "--") == 0;
		(IsForPovray(word) ? povray : own).push_back(word);
		if (!IsForPovray(word) && word[0] != '-')
		{
			povray.push_back(FileWord(word, first));
			first = false;
		}
		// An option's value is the option's, whatever it looks like.
		if (option && word.find('=') == std::string::npos && word != "--help" && word != "--version" && word != "--scene-may-write" && i + 1 < argc)
			own.emplace_back(argv[++i]);
	}
}

Setting ParseSetting(const std::string& text)
{
	Setting setting;
	std::vector<double> numbers;
	for (size_t at = 0; at <= text.size(); )
	{
		const size_t comma = std::min(text.find(',', at), text.size());
		const std::string number = text.substr(at, comma - at);
		char* end = nullptr;
		numbers.push_back(std::strtod(number.c_str(), &end));
		if (number.empty() || *end)
			numbers.push_back(-1);
		at = comma + 1;
	}
	bool good = numbers.size() >= 3 && numbers.size() <= 4;
	for (const double x : numbers)
		good = good && x >= 0 && x <= 1e8;
	good = good && numbers[2] <= 1;   // POV-Ray's own range
	if (good && numbers.size() == 4)
		good = numbers[3] > 0 && numbers[3] < 1;
	if (!good || numbers[1] < 1 || numbers[0] > numbers[1] || std::fmod(numbers[0], 1) != 0 || std::fmod(numbers[1], 1) != 0)
		throw CLI::ValidationError("--setting", fmt::format("'{}' is not MIN,MAX,VARIANCE[,CONFIDENCE], such as 16,256,0.0001", text));
	setting.min = int(numbers[0]);
	setting.max = int(numbers[1]);
	setting.variance = numbers[2];
	setting.confidence = numbers.size() == 4 ? numbers[3] : AsTheScene;
	return setting;
}

double Positive(const std::string& option, const std::string& text, double (*parse)(const std::string&), const char* example)
{
	const double value = parse(text);
	if (!(value > 0))
		throw CLI::ValidationError(option, fmt::format("'{}' is not {}", text, example));
	return value;
}

const char Footer[] =
	"SCENE is a .pov or .ini file; what begins with one + or -, and NAME=value, goes to POV-Ray (+W +H +L Declare=..).\n"
	"The picture itself is not rendered, and no file of yours is touched: photons and radiosity are not saved, and a scene that\n"
	"opens files for writing is refused unless --scene-may-write lets it.\n"
	"\n"
	"Example:\n"
	"  tiltcost scenes/first-tilt/first-tilt.pov +Lscenes/first-tilt +W1920 +H1080 --plot cost.svg\n"
	"  tiltcost scenes/first-tilt/first-tilt.pov +Lscenes/first-tilt +W1920 +H1080 --time 60s\n"
	"  tiltcost scenes/sweep/sweep.pov +Lscenes/sweep +KFF60 --frames 5 --time 2h       (all sixty frames in two hours)\n"
	"  tiltcost scenes/first-tilt/first-tilt.pov +Lscenes/first-tilt --page plane.html\n"
	"\n"
	"Error: RMS over pixels and channels of the linear picture, 0 to 1, against infinitely many samples. Levels: the same of\n"
	"the sRGB-encoded picture, times 255. Times are for an otherwise idle machine; confidence is the scene's (POV-Ray's default is 0.9).\n"
	"It stops paying at the first row whose error is below 0.29 levels: rounding to 8 bits alone errs by 1/sqrt(12) = 0.29.\n"
	"\n"
	"Exit codes: 0 done, 1 refused (the scene does not render, has no tilt_lens, or the bound cannot be met),\n"
	"2 wrong usage, 3 unreadable or unwritable file (but 1 for a scene that POV-Ray cannot open), 128 + signal interrupted.";

}

double ParseDuration(const std::string& text)
{
	char* end = nullptr;
	const double value = std::strtod(text.c_str(), &end);
	const std::string unit = end;
	const double factor = unit.empty() || unit == "s" ? 1 : unit == "m" || unit == "min" ? 60 : unit == "h" ? 3600 : 0;
	return end != text.c_str() && std::isfinite(value) && value > 0 ? value * factor : 0;
}

double ParseNumber(const std::string& text)
{
	char* end = nullptr;
	double value = std::strtod(text.c_str(), &end);
	if (end == text.c_str())
		return 0;
	if (*end == '/')
	{
		const char* below = end + 1;
		value /= std::strtod(below, &end);
		if (end == below)
			return 0;
	}
	return *end == '\0' && std::isfinite(value) && value > 0 ? value : 0;
}

Options ParseCommandLine(CLI::App& app, int argc, char** argv)
{
	Options options;
	std::vector<std::string> own, settings, files;
	std::string time, error, levels, stop, pilot_time;
	options.job.povray = Beside("povray");
	Split(argc, argv, own, options.job.options);

	app.set_version_flag("--version", "tiltcost " TILTCOST_VERSION);
	app.footer(Footer);
	app.add_option("SCENE", files, "the scene, and ini files")->required();
	auto* by_time = app.add_option("--time", time, "the least error within this render time, with denoise\nor without: 60s, 5m, 2h");
	auto* by_error = app.add_option("--error", error, "the cheapest settings with at most this RMS error: 0.004, 1/255");
	auto* by_levels = app.add_option("--levels", levels, "the same in levels of an 8-bit picture: 0.5");
	by_time->excludes(by_error, by_levels);
	by_error->excludes(by_levels);
	app.add_option("--setting", settings, "a row of its own, MIN,MAX,VARIANCE[,CONFIDENCE] as in the scene (MIN 0: none named); repeatable")
		->take_all()->expected(1);
	app.add_option("--stop-levels", stop, "where it stops paying, in 8-bit levels [0.29]");
	app.add_option("--plot", options.plot, "write time against error: FILE.svg or FILE.png");
	app.add_option("--csv", options.csv, "write the table: FILE.csv");
	app.add_option("--rows", options.rows, "write the seconds of every row, for the first --setting, else for what the scene\nitself says, and stop: FILE.json; povray-strips cuts pictures by it");
	app.add_option("--page", options.page, "write a page on which the scene's plane of focus can be tilted, with the tilt_lens\nblock to copy, and stop; nothing is rendered: FILE.html");
	app.add_option("--pilot-time", pilot_time, "how long pilots may trace, by the clock: blocks of 16 x 16 pixels that\nhave not begun by then are left out, all but the first 4 [10s]");
	app.add_option("--pilot-blocks", options.job.most_blocks, "at most so many blocks of 16 x 16 pixels [240]")->check(CLI::Range(1, 1000000));
	app.add_option("--frames", options.job.frames, "the scene is an animation (+KFI +KFF, or its ini file): pilots of so many of its\nframes, evenly spread; all figures are the film's")->check(CLI::Range(1, 1000));
	app.add_flag("--scene-may-write", options.job.may_write, "let a scene that opens files for writing (#fopen) do so: it is parsed twice, with --frames\ntwice a frame");
	app.add_option("--povray", options.job.povray, "POV-Ray with tilt_lens [the povray beside tiltcost]");

	// CLI11 takes them from the back.
	app.parse(std::vector<std::string>(own.rbegin(), own.rend()));
	options.job.scene = files[0];
	options.files = files;
	options.job.rows = !options.rows.empty();
	if (by_time->count())
		options.time = Positive("--time", time, ParseDuration, "a time such as 60s, 5m or 2h");
	if (by_error->count())
		options.error = Positive("--error", error, ParseNumber, "an error such as 0.004 or 1/255");
	if (by_levels->count())
		options.levels = Positive("--levels", levels, ParseNumber, "a number of levels such as 0.5");
	if (!stop.empty())
		options.stop_levels = Positive("--stop-levels", stop, ParseNumber, "a number of levels such as 0.29");
	if (!pilot_time.empty())
		options.job.pilot_seconds = Positive("--pilot-time", pilot_time, ParseDuration, "a time such as 10s");
	const std::string suffix = std::filesystem::path(options.plot).extension().string();
	if (!options.plot.empty() && suffix != ".svg" && suffix != ".png")
		throw CLI::ValidationError("--plot", fmt::format("'{}' ends neither in .svg nor in .png", options.plot));
	if (!options.rows.empty() && (options.time > 0 || options.error > 0 || options.levels > 0 || !options.csv.empty() || !options.plot.empty()))
		throw CLI::ValidationError("--rows", "goes with none of --time, --error, --levels, --csv and --plot");
	if (!options.rows.empty() && options.job.frames > 0)
		throw CLI::ValidationError("--rows", "is about one picture, and --frames about many; choose one with +SFn +EFn");
	if (!options.page.empty() && options.job.frames > 0)
		throw CLI::ValidationError("--page", "shows one lens, and --frames is about many; choose a frame with +SFn +EFn");
	if (!options.page.empty() && (options.time > 0 || options.error > 0 || options.levels > 0 || !options.csv.empty() || !options.plot.empty() || !options.rows.empty() || !settings.empty()))
		throw CLI::ValidationError("--page", "goes with none of --time, --error, --levels, --setting, --csv, --plot and --rows");
	const std::string page_suffix = std::filesystem::path(options.page).extension().string();
	if (!options.page.empty() && page_suffix != ".html" && page_suffix != ".htm")
		throw CLI::ValidationError("--page", fmt::format("'{}' does not end in .html", options.page));
	for (const std::string& setting : settings)
		options.own.push_back(ParseSetting(setting));
	return options;
}

}
