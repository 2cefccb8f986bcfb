// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exr_io.h"

#include "error.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImathBox.h>
#include <fmt/format.h>

#include <vector>

namespace tiltcal
{

namespace
{

const char* const CHANNELS_RGB[] = { "B", "G", "R" };
const char* const CHANNELS_Y[] = { "Y" };

/// A damaged header can ask for any size; a camera's picture has not that many pixels.
const long long MAX_PIXELS = 1LL << 29;

}

cv::Mat ReadExr(const std::string& file)
{
	try
	{
		Imf::InputFile input(file.c_str());
		const Imath::Box2i window = input.header().dataWindow();
		const long long width = static_cast<long long>(window.max.x) - window.min.x + 1;
		const long long height = static_cast<long long>(window.max.y) - window.min.y + 1;
		if (width < 1 || height < 1 || width > MAX_PIXELS / height)
			throw FileError(fmt::format("{}: {} x {} pixels is not a size this program reads", file, width, height));

		const Imf::ChannelList& channels = input.header().channels();
		const bool rgb = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
		if (!rgb && !channels.findChannel("Y"))
			throw FileError(fmt::format("{}: has neither a channel Y nor channels R, G, B; export one of these", file));

		const int count = rgb ? 3 : 1;
		cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_MAKETYPE(CV_32F, count));
		Imf::FrameBuffer buffer;
		for (int c = 0; c < count; ++c)
		{
			// OpenEXR addresses pixels by data-window coordinates, hence the offset.
			char* base = reinterpret_cast<char*>(image.ptr<float>() + c)
				- (static_cast<ptrdiff_t>(window.min.y) * static_cast<ptrdiff_t>(image.step[0])
				+ static_cast<ptrdiff_t>(window.min.x) * static_cast<ptrdiff_t>(image.elemSize()));
			buffer.insert(rgb ? CHANNELS_RGB[c] : CHANNELS_Y[c],
				Imf::Slice(Imf::FLOAT, base, image.elemSize(), image.step[0]));
		}
		input.setFrameBuffer(buffer);
		input.readPixels(window.min.y, window.max.y);
		return image;
	}
	catch (const Error&)
	{
		throw;
	}
	catch (const std::exception& e)
	{
		throw FileError(fmt::format("{}: not a complete OpenEXR picture: {}", file, e.what()));
	}
}

}
