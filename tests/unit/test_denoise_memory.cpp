// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The memory that denoise takes, as REFERENCE.md says it.

#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "lens/denoise.h"

using namespace tilt_lens;

// What REFERENCE.md says: 16 floats, 64 bytes a pixel.
TEST(Denoise, KeepsSixteenFloatsAPixel)
{
	NoisyPicture p;
	p.Resize(10, 7);
	size_t floats = p.count.size();
	for(const auto& plane : p.mean)
		floats += plane.size();
	for(const auto& plane : p.first)
		floats += plane.size();
	floats += 70 * PictureChannels;         // denoised (tilt_lens/denoised_picture.h)
	EXPECT_EQ(floats * sizeof(float), 70u * 64u);
}

#ifndef __SANITIZE_ADDRESS__
// REFERENCE.md says so: 32 and 44 kB for a pixel of the width, of which allocation takes back or adds a twentieth at the most.
TEST(Denoise, BandsTakeTheMemoryThatIsSaid)
{
	const auto peak = []
	{
		rusage usage;
		getrusage(RUSAGE_SELF, &usage);
		return 1024.0 * double(usage.ru_maxrss);
	};
	for(const bool transparent : { false, true })
	{
		NoisyPicture p;
		p.Resize(2000, 2 * DenoiseBand + 20);
		p.count.assign(p.count.size(), 16.0f);
		if(transparent)
			for(int c : { 3, 4 })
				p.mean[c] = p.first[c] = p.count;
		std::vector<float> denoised[PictureChannels];
		for(auto& plane : denoised)
			plane.assign(p.count.size(), 1.0f);
		const double before = peak();
		DenoiseRows(p, DenoiseBand, 2 * DenoiseBand - 1, denoised);
		// The transparent one's memory begins where the opaque one's ended.
		const double said = transparent ? 44e3 - 32e3 : 32e3;
		EXPECT_NEAR((peak() - before) / p.width, said, 0.05 * (transparent ? 44e3 : 32e3));
	}
}
#endif
