// SPDX-License-Identifier: AGPL-3.0-or-later
//
// One scene, raced: at zero tilt against stock's focal blur, or tilted against averaged pinholes.
#pragma once
#include "race_curve.h"
#include "race_errors.h"
#include "race_render.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

struct Contest
{
	RaceScene scene;
	bool tilted = false;
	Picture truth;
	double truth_error = 0; // RMS, of the truth itself
	int truth_samples = 0;
	double pinhole_distance = 0, pinhole_error = 0; // truth to averaged pinholes of stock; what their halves differ by, / 2
	int pinhole_frames = 0;
	// How far apart the two may be: each error is known to a factor of 1.58 (LIMITS.md).
	double PinholeBound() const { return 1.58 * std::hypot(truth_error, pinhole_error); }
	double pinholes_paid = 1; // CPU time of the pinholes with parsing and start-up, over that without
	Offset stock_offset; // of stock's own limit
	double limit_distance = 0, limit_error = 0; // stock's limit to the truth; its own error
	std::map<Opponent, double> start_up;
	std::map<Opponent, std::vector<RacePoint>> points;

	std::string Name() const { return scene.name + (tilted ? "-tilted" : ""); }
	std::string Title() const { return scene.title + (scene.tilted ? tilted ? ", tilted" : ", not tilted" : ""); }
	// Whether the truth is known well enough for times to an RMS error: its own, squared, is a quarter of that at most.
	bool Tells(double error) const { return truth_error <= 0.5 * error; }
	std::vector<double> Told(std::vector<double> errors) const
	{
		errors.erase(std::remove_if(errors.begin(), errors.end(), [this](double error) { return !Tells(error); }), errors.end());
		return errors;
	}
	Opponent Rival() const { return tilted ? Opponent::PINHOLES : Opponent::STOCK; }
	// OURS is the best of all settings, fixed ones too, as STOCK is.
	std::vector<CurvePoint> RmsHull(Opponent opponent) const;
	// Of the root, which falls like an RMS error.
	std::vector<CurvePoint> RelMseHull(Opponent opponent) const;
};

// Which of our settings run against an opponent: all of them, or those that trace only, as stock and pinholes do.
enum class Side
{
	BEST, // the quickest, with denoise or without
	RAW // without denoise
};

// Time of the opponent over ours at an error. Over FIXED it is our adaptive settings alone that are asked.
struct Ratio
{
	double error = 0, value = 0;
	bool at_least = false; // the opponent did not get there: its time is extrapolated, to its advantage
	bool at_most = false; // ours did not get there: extrapolated, to its disadvantage
	bool theirs_at_floor = false, own_at_floor = false; // a time of which is known only that it is not longer (NetTime)
	bool AtFloor() const { return theirs_at_floor || own_at_floor; }
};
Ratio RatioAt(const Contest& contest, Opponent opponent, double error, Side side);
Ratio RelMseRatioAt(const Contest& contest, Opponent opponent, double rel_mse, Side side);

// `say` receives a line at every step.
Contest RunContest(const Renderer& renderer, const RaceScene& scene, bool tilted, const RaceSettings& settings,
	Reuse reuse, const std::function<void(const std::string&)>& say);
