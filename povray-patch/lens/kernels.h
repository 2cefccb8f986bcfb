// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Smoothing kernels on planes of numbers, for denoise.cpp. Free of POV-Ray.

#ifndef TILT_LENS_KERNELS_H
#define TILT_LENS_KERNELS_H

#include <cstddef>
#include <vector>

// Elementwise arithmetic in a fixed order: any width of vectors gives the same bits.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__SANITIZE_ADDRESS__)
	#define TILT_LENS_VECTORS __attribute__((target_clones("avx2", "default")))
#else
	#define TILT_LENS_VECTORS
#endif

namespace tilt_lens
{

/// Numbers of a rectangle of pixels, row by row.
struct PixelPlane
{
	int width, height;
	std::vector<float> v;

	explicit PixelPlane(int w = 0, int h = 0) : width(w), height(h), v(size_t(w) * h, 0.0f) {}
	float& At(int x, int y) { return v[size_t(y) * width + x]; }
};

/// Index within 0 .. n - 1 that i has when the row is continued by reflection about
/// its first and last element; any i, n >= 1.
int Reflected(int i, int n);

/// Kernels reach no farther than this, in pixels.
const int KernelReach = 10;

/// What a kernel takes of the pixel at (+dx, +dy).
struct Tap
{
	int dx, dy;
	float weight;
};

/// A kernel of sum 1 whose centre weighs nothing. Results hold KernelReach pixels inside a
/// plane's edges; nearer to them they mean nothing.
class Kernel
{
	public:
		/// Gaussian along `angle` (radians) and across; equal widths make it round.
		Kernel(double sigma_along, double sigma_across, double angle);

		/// p and result are of one size, as is `rows`, which is for the function's own use.
		void Apply(const PixelPlane& p, PixelPlane& rows, PixelPlane& result) const { Apply(p, false, rows, result); }
		/// With squared weights: variance of what Apply gives, from the variances of pixels.
		void ApplySquared(const PixelPlane& p, PixelPlane& rows, PixelPlane& result) const { Apply(p, true, rows, result); }
	private:
		std::vector<float> half;        // a round one in two passes: weights at 0, 1, 2, ...
		std::vector<Tap> taps, squares; // a stroke, and with squared weights

		void Apply(const PixelPlane& p, bool squared, PixelPlane& rows, PixelPlane& result) const;
};

/// Round kernels from half a pixel to four, and strokes in four directions.
std::vector<Kernel> AllKernels();

/// Smooth reaches so far, in pixels.
const int SmoothingReach = 6;

/// Gaussian average, sigma 2 pixels. As with kernels, nothing holds so near to the edges.
void Smooth(const PixelPlane& p, PixelPlane& rows, PixelPlane& result);

/// Keeps `keep` of `sum` and adds `credit` of the plane, in which the smoothed one takes `weight` of the place. Where credit is 0
/// nothing changes.
void Blend(const PixelPlane& plane, const PixelPlane& smooth, const PixelPlane& weight, const PixelPlane& credit, const PixelPlane& keep, PixelPlane& sum);

}

#endif
