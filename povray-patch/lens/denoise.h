// SPDX-License-Identifier: AGPL-3.0-or-later
//
// `denoise`: pixels of a blurred picture know something about each other. Free of
// POV-Ray.
//
// Every pixel keeps two means, of the first and of the later part of its samples.
// A smoothing kernel that leaves the pixel itself out is tried on both parts: the
// product of (smoothed first - later) and (smoothed later - first) is on average the
// square of what smoothing would falsify, free of noise because the parts' noise is
// not common. With the pixel's own variance that gives the weight at which own mean
// and smoothed neighbours together have the least squared error, and that error. Of
// eighteen kernels, round ones and strokes in four directions, each pixel takes the
// one that promises most; where none promises anything it stays as it was. With fewer than
// sixteen samples the promises themselves are so noisy that the best of them is often but lucky:
// then all kernels' results are averaged, each the more the less error it promises. In the end
// blocks of 8 x 8 pixels are judged as they are shown: one in which the two halves,
// smoothed like the whole, do not predict each other stays as it was.
//
// Sources: C. Stein, "Estimation of the mean of a multivariate normal distribution"
// (1981) for the weight; Rousselle, Knaus, Zwicker, "Adaptive sampling and
// reconstruction using greedy error minimization" (2011) and "Adaptive rendering with
// non-local means filtering" (2012) for choosing kernels by two buffers.

#ifndef TILT_LENS_DENOISE_H
#define TILT_LENS_DENOISE_H

#include <cstddef>
#include <vector>

namespace tilt_lens
{

const int PictureChannels = 5;      ///< red, green, blue, filter, transmit

/// Side of the blocks of the picture, counted from its corner, that are denoised or not.
const int JudgedBlock = 8;

/// A pixel depends on others at most this far away.
const int DenoiseReach = 24;

/// Threads of a render that denoise at a time, each a band of rows of its own: a band takes 32 kB for a pixel of the picture's width,
/// 44 kB where it is transparent.
const int DenoiseThreads = 4;
const int DenoiseBand = 128;                ///< rows: enough that their margins hardly count

/// A sampled picture of width x height pixels, planes row by row, linear light.
struct NoisyPicture
{
	int width = 0, height = 0;
	int left = 0, top = 0;                      ///< where its corner lies in the whole picture
	std::vector<float> mean[PictureChannels];   ///< of all samples
	std::vector<float> first[PictureChannels];  ///< of the first part of them
	std::vector<float> count;                   ///< of samples; the first part are as many as the last power of two below

	void Resize(int w, int h);
};

/// Denoises rows top..bottom (inclusive) into the same rows of `denoised`, planes of
/// the picture's size. Rows beyond are looked at where the picture has them. Returns
/// the sum over those pixels of the estimated squared error (mean of red, green,
/// blue; what is transparent is judged with them, and is not in it), and puts each pixel's into `squared_error`, a plane of the picture's size, where that is not null, and what the
/// pixel keeps of its own mean, 1 where it stays as it was, into `own_share`. The result for a row does not depend on top and bottom.
double DenoiseRows(const NoisyPicture& picture, int top, int bottom, std::vector<float> (&denoised)[PictureChannels],
                   std::vector<float> *squared_error = nullptr, std::vector<float> *own_share = nullptr);

}

#endif
