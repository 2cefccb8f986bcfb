// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The writer of OpenEXR files asks here whether the lens has channels to add.

#ifndef TILT_LENS_EXR_CHANNELS_H
#define TILT_LENS_EXR_CHANNELS_H

#include <memory>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfRgba.h>

#include "lens/lens_channels.h"

namespace tilt_lens
{

/// Colours as half, as stock writes them, which of them `rgba` says.
inline void AddColours(Imf::Header& header, Imf::FrameBuffer& frame, Imf::RgbaChannels rgba, Imf::Rgba *pixels, int width)
{
	const struct { const char *name; int of; half *first; } colours[] =
	{
		{ "R", Imf::WRITE_R, &pixels->r }, { "G", Imf::WRITE_G, &pixels->g }, { "B", Imf::WRITE_B, &pixels->b },
		{ "A", Imf::WRITE_A, &pixels->a }
	};
	for(const auto& c : colours)
		if(rgba & c.of)
		{
			header.channels().insert(c.name, Imf::Channel(Imf::HALF));
			frame.insert(c.name, Imf::Slice(Imf::HALF, (char *)c.first, sizeof(Imf::Rgba), sizeof(Imf::Rgba) * width));
		}
}

/// Writes the picture with the lens's channels, as 32 bit numbers. False, and nothing written, where it has none.
inline bool WriteWithChannels(Imf::OStream& os, Imf::Header& header, Imf::RgbaChannels rgba, Imf::Rgba *pixels, int width, int height)
{
	const std::shared_ptr<LensChannels> channels = LensChannels::Current();
	Imf::FrameBuffer frame;

	// Grey OpenEXR files are refused by POV-Ray's options.
	if(!channels || !channels->HasSize(width, height) || (rgba & Imf::WRITE_Y))
		return false;
	AddColours(header, frame, rgba, pixels, width);
	for(int c = 0; c < LensChannels::Count; c++)
	{
		header.channels().insert(LensChannels::Names[c], Imf::Channel(Imf::FLOAT));
		frame.insert(LensChannels::Names[c], Imf::Slice(Imf::FLOAT, (char *)channels->Plane(c).data(), sizeof(float), sizeof(float) * width));
	}
	Imf::OutputFile file(os, header);
	file.setFrameBuffer(frame);
	file.writePixels(height);
	return true;
}

}

#endif
