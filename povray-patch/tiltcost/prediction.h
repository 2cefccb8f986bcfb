// SPDX-License-Identifier: AGPL-3.0-or-later
//
// From a pilot render to what a setting of blur_samples and variance costs and gives.
//
// The pilot knows of each of its pixels the means m(n) and sample variances at n = 1, 2,
// 4, ... N. The number of samples n that the renderer would take follows from the
// functions that the renderer decides with (lens/adaptive.h). The expected square
// of the error left is then (m(n) - m(N))^2 + v(N), v(N) the variance of m(N) by
// lens/convergence.h over all pixels that take n; beyond N, v(N) (N/n)^a. Means are
// clipped to 0 .. 1, as in a picture file.

#ifndef TILTCOST_PREDICTION_H
#define TILTCOST_PREDICTION_H

#include "tiltcost/pilot_file.h"

#include "lens/adaptive.h"
#include "lens/convergence.h"
#include "lens/denoise.h"
#include "lens/neighbourhood.h"

#include <string>
#include <vector>

namespace tiltcost
{

/// POV-Ray's own, where a scene says none.
const double DefaultConfidence = 0.9;

/// What a scene says. variance 0: always `max`. min 0: none named.
struct Setting
{
	int min = 0, max = 128;
	double variance = 0.0001, confidence = DefaultConfidence;
	bool denoise = false;           ///< as tilt_lens { denoise }
};

/// As to be written into the camera block.
std::string SceneText(const Setting& setting);

struct Prediction
{
	double error = 0;               ///< RMS over pixels and channels, linear, white = 1
	double encoded_error = 0;       ///< the same of display-encoded (sRGB) values
	double samples_per_pixel = 0;
	double seconds_per_pixel = 0;   ///< CPU, tracing only
	double extrapolated = 0;        ///< share of the error's square that lies beyond the pilot's samples

	/// RMS in steps of an 8-bit picture.
	double Levels() const { return 255 * encoded_error; }
};

/// What a block of the pilot costs.
struct BlockCost
{
	double x = 0, y = 0;            ///< its centre
	double seconds_per_pixel = 0;
};

/// A pilot render, prepared for many predictions.
class Pilot
{
public:
	/// Blocks as of ParsePilot, at least one; of each of their pictures, what they were chosen from.
	explicit Pilot(const std::vector<PilotBlock>& blocks, const std::vector<Population>& pictures = {});

	Prediction Predict(const Setting& setting) const { return Predict(setting, 0, 1); }

	/// Leaves out every block whose index is `part` modulo `parts` (parts > 1): for the jackknife.
	Prediction Predict(const Setting& setting, int part, int parts) const;

	/// What a setting costs at each block.
	std::vector<BlockCost> BlockCosts(const Setting& setting) const;

	int Samples() const { return samples; }
	int Blocks() const { return int(blocks.size()); }
	/// Pixels that predictions rest on: those inside blocks, whose neighbours are known.
	int Pixels() const { return pixel_count; }

	/// RMS error of a setting's picture when it is denoised, by denoising the pilot's blocks: slow.
	/// Each block is denoised as a picture of its own, so the error is a little too large. `left_out`, where not null, receives what it would be
	/// without each of `parts` parts of the blocks.
	double PredictDenoised(const Setting& setting, std::vector<double>* left_out = nullptr, int parts = 1) const;

private:
	/// The two ways an error is measured in.
	enum Scale { LINEAR, ENCODED, SCALES };

	/// A pixel at a power of two.
	struct Level
	{
		float mean[tilt_lens::PictureChannels]; ///< linear, not clipped
		double variance;                ///< of a sample
		double off[SCALES];             ///< squared distance from m(N), averaged over the channels
	};

	struct Pixel
	{
		std::vector<Level> levels;      ///< index k: 2^k samples
		tilt_lens::LevelChanges changes[SCALES];    ///< up to N samples
	};

	struct Block
	{
		double x, y;                    ///< its centre
		SampledBlock sampled;
		size_t picture;
		int width, height;
		double seconds_per_pixel;       ///< for its first sample and what a pixel costs once
		double seconds_per_sample;      ///< for each of the others
		std::vector<Pixel> pixels;

		double Seconds(double of_pixels, double of_samples) const { return of_pixels * seconds_per_pixel + (of_samples - of_pixels) * seconds_per_sample; }
	};

	/// Pixels that take the same number of samples.
	struct Class
	{
		double pixels = 0;
		double off[SCALES] = {};
		tilt_lens::LevelChanges changes[SCALES];
	};

	/// Pixels that stop at the same level, denoised.
	struct DenoisedClass
	{
		double off = 0, raw_off = 0;                ///< squared distances of the denoised ones, and of the others, from m(N)
		tilt_lens::LevelChanges changes, kept, kept_squared;    ///< all, and by the shares that pixels keep of their own means, and the shares' squares

		double SquaredErrors() const;
		double RawSquaredErrors() const { return raw_off + changes.SumOfVariances(); }
	};

	std::vector<double> Weights(int part, int parts) const;
	static Pixel Prepare(const std::vector<tilt_lens::PilotLevel>& levels);
	std::vector<tilt_lens::Between> CompareFirst(const Block& block, int first) const;
	std::vector<size_t> LevelsOf(const Block& block, const std::vector<tilt_lens::SampleLevel>& levels) const;
	static bool IsInside(const Block& block, int x, int y, int reach = tilt_lens::NeighbourReach);
	size_t Known(int count) const;
	void AddDenoised(const Block& block, const std::vector<size_t>& known, std::vector<DenoisedClass>& classes) const;
	void AddErrors(const Class& of, int count, Prediction& sum) const;

	std::vector<Block> blocks;
	std::vector<Population> populations;    ///< of the pictures
	int samples = 0, pixel_count = 0;
};

/// The value that a chi-squared variable of df degrees of freedom exceeds with
/// probability c: POV-Ray's chdtri.
double Chi2(double df, double c);

}

#endif
