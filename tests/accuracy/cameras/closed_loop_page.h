// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the closed loops found, as one page.

#ifndef CLOSED_LOOP_PAGE_H
#define CLOSED_LOOP_PAGE_H

#include "closed_loop.h"

#include <string>
#include <vector>

namespace cameras
{

struct Result
{
	Camera camera;
	std::string light;
	Answer answer;
};

/// Of all numbers found, with what they miss the truth by.
struct Coverage
{
	int inside = 0, all = 0;   ///< inside 2 sigma
	double rms = 0, mean = 0, worst = 0;   ///< sigmas; squares count 100 at most
	double Share() const { return all ? double(inside) / all : 0; }
};

/// Of each kind of number: w, f, d, U, tilt along, tilt across, cx, cy, k1.
std::vector<std::pair<std::string, Coverage>> CoverageByKind(const std::vector<Result>& results);
Coverage CoverageOfAll(const std::vector<Result>& results);

/// How many cameras the calibrator refused.
int Refused(const std::vector<Result>& results);

/// Markdown; written whole or not at all.
void WritePage(const std::string& file, const std::string& command, const std::vector<Result>& results);

}

#endif
