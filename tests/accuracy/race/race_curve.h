// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Error against time, and what the best settings of an opponent reach.
#pragma once
#include "race_setting.h"

#include <vector>

struct RacePoint
{
	Setting setting;
	std::vector<double> times; // CPU seconds without the start-up, one a repeat
	bool at_floor = false; // the least of them is NetTime's least: how much shorter it really is is not known
	double rms_truth = 0; // against the truth; stock also against two easier ones
	double rms_shifted = 0, rms_limit = 0;
	double rel_mse = 0; // the least over the same truths
	double rss = 0;
	double worse_blocks = -1; // denoised: the share of blocks that are worse than without; -1 where that did not run

	// Another repeat, of which a `share` is this point's. Seconds.
	void Add(double cpu, double start_up, double share = 1);
	double Time() const; // the least of the repeats: what disturbs a run makes it longer
	double Spread() const; // longest over shortest, less 1
	double Rms() const; // the least of the three
};

// Seconds without those of the start-up. A machine's speed drifts by a third within minutes (COSTS.md), so that what is left is known no better than by
// a third of the start-up: no time counts as less.
double NetTime(double cpu, double start_up);

struct CurvePoint
{
	double time, error;
	bool at_floor = false; // as of a RacePoint
};

// The lower left of a cloud of points, convex in logarithms: what a user reaches who knows the best setting.
std::vector<CurvePoint> Hull(std::vector<CurvePoint> points);

struct TimeAt
{
	double time = 0;
	bool reached = true; // false: extrapolated
	bool at_floor = false; // read from such a point
};

// The time at which a hull reaches an error. Past its end it goes on with its last slope: `generous` not flatter than
// that of plain averaging, -1/2, otherwise not steeper. Before its start: the time of its first point.
TimeAt TimeToReach(const std::vector<CurvePoint>& hull, double error, bool generous);
