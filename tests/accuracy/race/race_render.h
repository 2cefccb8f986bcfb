// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Renders a race's scene with a setting, and keeps what need not be rendered twice.
#pragma once
#include "support/picture.h"
#include "support/run_measured.h"
#include "race_setting.h"

#include <functional>
#include <optional>

struct Programs
{
	std::filesystem::path ours, stock;
	std::filesystem::path reference; // the tilt_lens that makes the truth; ours, unless that is being changed
	bool seed = true; // tilt_lens has the word `seed`; otherwise other samples come from other pixel coordinates
};

struct Rendered
{
	Picture picture; // linear, clipped to 0 ... 1
	Cost cost;
};

// What averaged pinholes are rendered for: to race, as a user would, or to check a truth. Those ask all points of area lights, whose mean `adaptive`
// only approximates, and other random numbers in every batch: stock repeats a pixel's in every frame, a noise that halves of the frames would share.
enum class PinholesFor
{
	RACE,
	CHECK
};

class Renderer
{
public:
	// Everything is written to the folder `name` below `folder`. Throws std::runtime_error when a program is missing.
	Renderer(const Programs& all, const RaceScene& shown, const std::filesystem::path& folder, const std::string& name,
		const RaceSettings& settings);

	// Renders, and measures, the part that is judged.
	Rendered Render(const Setting& setting) const;

	// The same by the reference's program. Kept on disk, and read from there when program, scene and setting are the same.
	Picture Reference(const Setting& setting) const;

	// As Render, or, when `reuse`, what an earlier race with the same program, scene and setting found.
	Rendered RenderOrReuse(const Setting& setting, bool reuse, int repeat) const;

	// CPU seconds of a run that traces one pixel of the picture: start, parsing, the file, end.
	double StartUp(Opponent opponent, bool tilted) const;

	// Averaged pinholes: `each` receives the mean of the first M frames for every power of two M up to `frames`.
	// Returns the cost of all; `start_up` receives what as many cost of which one pixel is traced, in a race.
	Cost Pinholes(int frames, bool tilted, PinholesFor purpose, double& start_up, const std::function<void(int, const Picture&)>& each) const;

private:
	// Pixels added on every side: the only way to other random numbers in stock, which derives them from the pixel's
	// coordinates, or from its place in its block.
	int Pad(const Setting& setting) const;
	// Of the rectangle `part` of a picture of w x h pixels.
	struct Part
	{
		int left, top, width, height;
	};
	std::vector<std::string> Command(const std::filesystem::path& program, const Setting& setting, int w, int h, const Part& part) const;
	Rendered Run(const std::filesystem::path& program, const Setting& setting) const;
	std::string Key(const std::filesystem::path& program, const Setting& setting) const;

	Programs programs;
	RaceScene scene;
	std::filesystem::path work, cache;
	int width, height;
	Part judged;
};
