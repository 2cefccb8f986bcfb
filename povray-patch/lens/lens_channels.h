// SPDX-License-Identifier: AGPL-3.0-or-later
//
// `channels`: what the lens knows of every pixel beside its colour, for picture files that can hold it.
// Free of POV-Ray.

#ifndef TILT_LENS_LENS_CHANNELS_H
#define TILT_LENS_LENS_CHANNELS_H

#include <cstddef>
#include <memory>
#include <vector>

namespace tilt_lens
{

/// In the order of LensChannels::Names.
struct ChannelValues
{
	double depth;       ///< z along the camera's axis of what the ray through the lens centre meets, world units
	double blur;        ///< signed blur width there, pixels: positive nearer than the focus
	double samples;     ///< traced for the pixel
	double error;       ///< estimated standard error of its colour, linear, RMS of red, green and blue
};

/// Of all pixels of one picture. Threads may set different pixels at the same time.
class LensChannels
{
	public:
		static const int Count = 4;
		/// As Nuke and Blender find them: Z for depth, and layers of one component each.
		static const char* const Names[Count];
		/// Depth where there is nothing, as Blender writes it. Infinity would be truer, and a NaN in the first product.
		static constexpr float NothingThere = 1e10f;

		/// Begins a picture of width x height pixels: nothing there, no samples.
		void Begin(int width, int height);
		void Set(int x, int y, const ChannelValues& values);
		/// Sets the error alone, of a pixel that was denoised.
		void SetError(int x, int y, double error) { planes[3][Index(x, y)] = float(error); }
		bool HasSize(int w, int h) const { return (width == w) && (height == h); }
		/// Channel 0 .. Count - 1, row by row from the top.
		const std::vector<float>& Plane(int channel) const { return planes[channel]; }

		/// Those of the picture that is being rendered and will be written next; null where it has none.
		static std::shared_ptr<LensChannels> Current();
		static void SetCurrent(const std::shared_ptr<LensChannels>& channels);
	private:
		int width = 0, height = 0;
		std::vector<float> planes[Count];

		size_t Index(int x, int y) const { return size_t(y) * width + x; }
};

}

#endif
