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
	// Every pixel asks for 25 of them.
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
	bool known = false;
};

/// Means of the first samples of a rectangle of pixels, row by row, from pixel (left, top) on.
struct FirstMeans
{
	const float *first;
	int left, top, columns, channels;

	const float *operator()(int x, int y) const { return first + (size_t(y - top) * columns + (x - left)) * channels; }
};

/// Compares a pixel's first `samples` with those of the eight around it. Pixels beyond left..right, top..bottom (inclusive), the
/// picture, do not count.
inline Between BetweenNeighbours(const FirstMeans& of, int samples, int x, int y, int left, int top, int right, int bottom)
{
	const float *own = of(x, y);
	Between between;
	int count = 0;

	for(int ny = std::max(y - 1, top); ny <= std::min(y + 1, bottom); ny++)
		for(int nx = std::max(x - 1, left); nx <= std::min(x + 1, right); nx++)
		{
			const float *other = of(nx, ny);
			if(other == own)
				continue;
			count++;
			for(int c = 0; c < of.channels; c++)
			{
				const double square = (double(other[c]) - own[c]) * (double(other[c]) - own[c]) * 0.5 * samples;
				between.most = std::max(between.most, square);
				if(c < 3)
					between.mean += square / 3.0;
			}
		}
	between.mean /= std::max(count, 1);
	between.known = true;
	return between;
}

/// Variance of a sample by which a pixel of so many is judged, `own` that of its own samples.
inline double VarianceToJudgeBy(int samples, double own, const Between& between)
{
	return samples >= LeastOwnVariance ? own : samples > 1 ? std::max(between.most, own) : between.most;
}

/// Uncertainties of a rectangle of pixels, row by row, from pixel (left, top) on.
struct UncertaintyMap
{
	const Uncertainty *first;
	int left, top, columns;

	Uncertainty operator()(int x, int y) const { return first[(y - top) * columns + (x - left)]; }
};

/// Pixels this far away count in a pixel's decision.
const int NeighbourReach = 2;

/// Variance per sample that the statistics assume of a pixel, from what it and its neighbours
/// found by themselves. A few samples can miss what covers a few percent of the lens
/// and then find nothing to be uncertain about; of 25 pixels hardly all miss it. Near
/// neighbours count most. Pixels beyond left..right, top..bottom (inclusive), the
/// picture, do not count.
inline double NeighbourhoodVariance(const UncertaintyMap& of, int x, int y, int left, int top, int right, int bottom)
{
	double near_sum = 0.0, far_sum = 0.0;
	int near_count = 0, far_count = 0;

	for(int ny = std::max(y - NeighbourReach, top); ny <= std::min(y + NeighbourReach, bottom); ny++)
		for(int nx = std::max(x - NeighbourReach, left); nx <= std::min(x + NeighbourReach, right); nx++)
		{
			const double v = FromUncertainty(of(nx, ny));
			far_sum += v;
			far_count++;
			if((std::abs(nx - x) <= 1) && (std::abs(ny - y) <= 1))
			{
				near_sum += v;
				near_count++;
			}
		}
	return 0.5 * (near_sum / near_count + far_sum / far_count);
}

/// What the eight pixels around one and the sixteen around these found at most.
struct MostAround
{
	Uncertainty near, far;
};

inline MostAround MostUncertainAround(const UncertaintyMap& of, int x, int y, int left, int top, int right, int bottom)
{
	MostAround most = { 0, 0 };

	for(int ny = std::max(y - NeighbourReach, top); ny <= std::min(y + NeighbourReach, bottom); ny++)
		for(int nx = std::max(x - NeighbourReach, left); nx <= std::min(x + NeighbourReach, right); nx++)
		{
			const bool near = (std::abs(nx - x) <= 1) && (std::abs(ny - y) <= 1);
			Uncertainty& m = near ? most.near : most.far;
			if((nx != x) || (ny != y))
				m = std::max(m, of(nx, ny));
		}
	return most;
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
inline size_t NeighbourhoodLevel(const std::vector<SampleLevel>& levels, size_t own_level, const MostAround& around)
{
	const double near = ShareOfNear * levels[LevelFor(levels, FromUncertainty(around.near))].samples;
	const double far = ShareOfFar * levels[LevelFor(levels, FromUncertainty(around.far))].samples;
	size_t level = own_level;
	while((level + 1 < levels.size()) && (levels[level].samples < std::max(near, far)))
		level++;
	return level;
}

}

#endif
