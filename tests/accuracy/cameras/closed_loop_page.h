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

/// Where a share lies with 95 %.
struct Interval
{
	double low = 0, high = 1;
	/// All of it below `least` or above `most`.
	bool IsOutside(double least, double most) const { return high < least || low > most; }
};

/// Of `inside` of `all` independent numbers: the binomial one (Wilson, "Probable inference", 1927). `all` need not be whole.
Interval IntervalOf(double inside, double all);

/// Of all numbers that are told, with what they miss the truth by.
struct Coverage
{
	int inside = 0, all = 0;   ///< inside 2 sigma
	int not_told = 0;          ///< left out of `all`
	double rms = 0, mean = 0, worst = 0;   ///< sigmas; each counts 10 at most, but for the worst
	/// Numbers of one set hang together: how much more the share scatters from set to set than that of independent numbers, as a variance; 1 at least.
	double clustering = 1;
	double Share() const { return all ? double(inside) / all : 0; }
	/// Binomial, of so many independent numbers as scatter as these.
	Interval Where() const { return IntervalOf(inside / clustering, all / clustering); }
};

/// Of each kind of number: w, f, d, U, tilt along, tilt across, cx, cy, k1.
std::vector<std::pair<std::string, Coverage>> CoverageByKind(const std::vector<Result>& results);
Coverage CoverageOfAll(const std::vector<Result>& results);

/// Of `all` independent numbers, each inside with the probability `share`, fewer than this are so once in a thousand: the binomial distribution. Of numbers that
/// hang together, as those of one camera do, more often.
int LeastInside(int all, double share);

/// Camera and light, by which a refusal is expected, and one that is not.
std::string NameOf(const Result& result);

/// Those without an answer, and among them those whose name begins with none of `expected`.
struct Refusals
{
	std::vector<const Result*> all, unexpected;
};
Refusals RefusalsOf(const std::vector<Result>& results, const std::vector<std::string>& expected);

/// Sets of thin lenses without rims, and how many of them were given one.
struct MadeUpRims
{
	int sets = 0, with = 0;
	/// More than one camera in a hundred, and not by chance.
	bool AreTooMany() const { return IntervalOf(with, sets).low > 0.01; }
};
MadeUpRims CountMadeUpRims(const std::vector<Result>& results);

/// Markdown; written whole or not at all.
void WritePage(const std::string& file, const std::string& command, const std::vector<Result>& results, const std::vector<std::string>& expected_refusals);

}

#endif
