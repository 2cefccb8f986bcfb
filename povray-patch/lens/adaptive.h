// SPDX-License-Identifier: AGPL-3.0-or-later
//
// When a pixel has samples enough: what `blur_samples MIN, MAX`, `variance` and
// `confidence` mean. Free of POV-Ray: tiltcost predicts with the same functions
// that the renderer decides with.

#ifndef TILT_LENS_ADAPTIVE_H
#define TILT_LENS_ADAPTIVE_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tilt_lens
{

/// Samples per pixel before the first decision, where the scene names no MIN.
const int DefaultFirstLevel = 16;
/// The variance of fewer samples than this says nothing: until then a pixel is judged by how its first ones differ from its neighbours'.
const int LeastOwnVariance = 4;
/// What of `variance` such a pixel's samples may seem to vary by. (Of 1, 0.3, 0.1 and 0.03 it takes the fewest rays at equal error on
/// scenes of the race; the lower tenth of a chi-squared variable, which stands here for more samples, is 0.02 to 0.2 of one to three.)
const double ShareBetween = 0.1;

/// A number of samples at which a pixel may stop, and the measured variance of its
/// mean below which it does by itself.
struct SampleLevel
{
	int samples;
	double stop_below;
};

/// The levels of a scene: powers of two (whole digital nets) from `min_samples` to
/// `max_samples`, and `max_samples` itself, which always stops. 0 for `min_samples`
/// means that the scene names none. The measured variance is an estimate from n - 1
/// degrees of freedom, so its upper bound at `confidence` must be below `variance`;
/// `chi2(df, c)` is the value that a chi-squared variable exceeds with probability c.
/// Levels of fewer than LeastOwnVariance samples are decided by what BetweenNeighbours says. variance 0 asks for all samples everywhere: one level.
inline std::vector<SampleLevel> SampleLevels(int min_samples, int max_samples, double variance, double confidence,
                                             double (*chi2)(double df, double c))
{
	std::vector<SampleLevel> levels;
	const int last = std::max(max_samples, 1);
	const int first = min_samples > 0 ? min_samples : DefaultFirstLevel;

	for(int n = 1; (n < last) && (variance > 0.0); n *= 2)
	{
		if(n >= first)
			levels.push_back({ n, variance * (n < LeastOwnVariance ? ShareBetween : chi2(n - 1.0, confidence) / (n - 1.0)) });
		if(n > last / 2)
			break;
	}
	levels.push_back({ last, 0.0 });
	return levels;
}

/// A pixel's variance per sample in one byte, a quarter of an octave a step, so that
/// a whole picture of them is small. 0 is no variance at all.
typedef unsigned char Uncertainty;
const Uncertainty UnknownUncertainty = 255;

inline Uncertainty ToUncertainty(double variance)
{
	if(!(variance > 0.0))
		return 0;
	return Uncertainty(std::min(254.0, std::max(1.0, std::floor(4.0 * std::log2(variance) + 0.5) + 190.0)));
}

/// Inverse of ToUncertainty, within 2^(1/8) where variance lies in 2^-47 .. 2^16.
inline double FromUncertainty(Uncertainty u)
{
	// Every pixel asks for it.
	struct Table
	{
		double variance[256];
		Table()
		{
			variance[0] = 0.0;
			for(int i = 1; i < 256; i++)
				variance[i] = std::exp2((i - 190) * 0.25);
		}
	};
	static const Table table;
	return table.variance[u];
}

/// What a pixel's first samples differ by from those of the pixels around, as variances of a sample: half a squared difference is on
/// average the variance that two means have in common, and more where the picture itself changes.
struct Between
{
	double most = 0.0;              ///< of all neighbours and channels
	double mean = 0.0;              ///< over the neighbours and over red, green and blue
	bool known = false;             ///< whether there are neighbours
};

/// Variance of a sample by which a pixel of so many is judged, `own` that of its own samples. Of few samples and without neighbours nothing is known.
inline double VarianceToJudgeBy(int samples, double own, const Between& between)
{
	if((samples < LeastOwnVariance) && !between.known)
		return HUGE_VAL;
	return samples >= LeastOwnVariance ? own : samples > 1 ? std::max(between.most, own) : between.most;
}

/// Whether a pixel with this variance per sample has enough at a level.
inline bool StopsAt(const SampleLevel& level, double variance)
{
	return variance < level.stop_below * level.samples;
}

/// The first level at which a pixel of such a variance would stop.
inline size_t LevelFor(const std::vector<SampleLevel>& levels, double variance)
{
	size_t level = 0;
	while((level + 1 < levels.size()) && !StopsAt(levels[level], variance))
		level++;
	return level;
}

// A few samples can miss the edge that a neighbour has found, and then see nothing to be uncertain about: of what is wrong in a picture half
// lies in such pixels, next to others that take ten times as many samples. A half of what the most uncertain neighbour wants would hit that
// edge, an eighth for those farther off, and what the pixel then finds by itself decides. (Of halves, quarters and eighths
// these take the fewest rays at equal error on the race's scenes; the neighbourhood's mean variance takes more.)
const double ShareOfNear = 0.5, ShareOfFar = 0.125;

/// Index of the level to which a pixel is sampled at least, not below `own_level`, at which it would stop by itself.
/// `most_near`, `most_far`: the most uncertain of the pixels around it, as Neighbourhoods finds them.
inline size_t NeighbourhoodLevel(const std::vector<SampleLevel>& levels, size_t own_level, Uncertainty most_near, Uncertainty most_far)
{
	const double near = ShareOfNear * levels[LevelFor(levels, FromUncertainty(most_near))].samples;
	const double far = ShareOfFar * levels[LevelFor(levels, FromUncertainty(most_far))].samples;
	size_t level = own_level;
	while((level + 1 < levels.size()) && (levels[level].samples < std::max(near, far)))
		level++;
	return level;
}

}

#endif
