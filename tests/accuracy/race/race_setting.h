// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What is raced: opponents, their settings, and the scenes. Settings come from settings.json.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

enum class Opponent
{
	STOCK, // stock focal blur
	OURS, // tilt_lens, denoised
	RAW, // tilt_lens, not denoised
	FIXED, // tilt_lens, every pixel the same number of samples
	GRID, // the same, with stock's grids of points on area lights
	PINHOLES // the mean of stock pinhole frames
};

struct Setting
{
	Opponent opponent = Opponent::OURS;
	int min = 0, max = 37; // blur_samples; min 0: a maximum alone. Pinholes: max frames
	double variance = 0, confidence = 0.9;
	bool bokeh = false; // stock with a round bokeh pigment
	bool denoise = false, grid = false; // tilt_lens
	bool every_point = false; // pinholes: area lights do not save points
	bool tilted = false;
	int seed = 0; // another set of samples
};

// As a scene would write it, for tables and keys.
std::string Label(const Setting& setting);
const char* Name(Opponent opponent);

// What is taken of an earlier race with the same programs, scenes and settings.
enum class Reuse
{
	NOTHING,
	STOCK, // its pictures and times
	ALL // of both sides: a race that was stopped goes on
};

struct RaceScene
{
	std::string name; // of the file
	std::string title, shows;
	bool tilted = false; // can be raced tilted too
	bool area_lights = false; // has some
	std::filesystem::path file;
};

// Every *.pov of the folder, by name. Throws std::runtime_error for one without a title.
std::vector<RaceScene> ReadScenes(const std::filesystem::path& folder);

struct RaceSettings
{
	int width = 0, height = 0;
	int judged_width = 0, judged_height = 0; // of the part in the middle that is rendered, timed and judged
	int repeats = 0;
	int short_repeats = 0; // of settings that take less than short_run CPU seconds, whose runs scatter most; never fewer than the others
	double short_run = 0;
	double longest_run = 0; // CPU seconds; settings that would need more are left out
	double enough = 0; // an opponent's ladder of fixed N ends below this error
	int reference_samples = 0, reference_seeds = 0; // samples of one set, sets at most
	double reference_error = 0; // sets are added until the reference is this good
	int limit_samples = 0; // of stock's own limit, twice
	int pinhole_frames = 0, check_frames = 0; // 0: no tilted contests, truths are not checked
	std::vector<double> errors; // at which times are compared
	std::vector<double> rel_mse;
	std::vector<Setting> stock, ours, raw, fixed, grid;
};

// `mode` is "full", "quick", "bench" or a size, "640x360" or "1920x1080". Throws std::exception that names what is wrong.
RaceSettings ReadSettings(const std::filesystem::path& file, const std::string& mode);
