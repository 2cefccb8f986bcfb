// SPDX-License-Identifier: AGPL-3.0-or-later
//
// How far from the truth a picture is that was sampled with digital nets. Free of
// POV-Ray.
//
// The n samples of a pixel are 2^k blocks that are alike in distribution, so with
// v(n) the variance of their mean m(n), the expected square of m(n/2) - m(n) is
// v(n/2) - v(n), without assuming that samples are independent. Fitting v(n) ~ n^-a
// to the squares of successive changes, summed over many pixels, gives a and v(n).
// (s^2/n, the rule for independent samples, is too much here: nets are better than that.)

#ifndef TILT_LENS_CONVERGENCE_H
#define TILT_LENS_CONVERGENCE_H

#include <algorithm>
#include <cmath>

namespace tilt_lens
{

/// Successive halvings that the fit looks back on. The nets' quality alternates
/// from one power of two to the next; five smooth that out.
const int ChangesKept = 5;

/// Variance of the mean that follows from `change[j]`, the mean squared change from
/// n/2^(j+1) to n/2^j samples, j = 0 .. changes - 1 (latest first). `exponent`, where
/// not null, receives a. The bounds of a: independent samples have 1, and nets in
/// four dimensions of pictures with edges stay below 1.8. 0 for no change at all.
inline double VarianceFromChanges(const double *change, int changes, double *exponent = nullptr)
{
	// The sums of changes span orders of magnitude: fit their logarithms.
	double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
	int count = 0;

	for(int j = 0; (j < changes) && (change[j] > 0.0); j++, count++)
	{
		const double y = std::log2(change[j]);
		sx += j;
		sy += y;
		sxx += double(j) * j;
		sxy += j * y;
	}
	double a = 1.0;
	if(count > 1)
		a = std::min(1.8, std::max(1.0, (count * sxy - sx * sy) / (count * sxx - sx * sx)));
	if(exponent)
		*exponent = a;
	if(count == 0)
		return 0.0;
	return std::exp2((sy - a * sx) / count) / (std::exp2(a) - 1.0);
}

/// Squared changes of the pixels that stopped at one level, summed up.
struct LevelChanges
{
	double pixels = 0.0;
	double change[ChangesKept] = {};
	int changes = ChangesKept;      ///< how many of them all pixels have

	LevelChanges& operator+=(const LevelChanges& o)
	{
		pixels += o.pixels;
		changes = std::min(changes, o.changes);
		for(int j = 0; j < ChangesKept; j++)
			change[j] += o.change[j];
		return *this;
	}

	/// Of pixels that count as so much each.
	LevelChanges operator*(double weight) const
	{
		LevelChanges weighted = *this;
		weighted.pixels *= weight;
		for(double& c : weighted.change)
			c *= weight;
		return weighted;
	}

	/// Sum over the pixels of the variance of their means.
	double SumOfVariances(double *exponent = nullptr) const { return VarianceFromChanges(change, changes, exponent); }
};

}

#endif
