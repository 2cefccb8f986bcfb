// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/exr_io.h"

#include <tiltcal/error.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <Iex.h>
#include <ImathBox.h>
#include <fmt/format.h>

#include <cstring>
#include <vector>

namespace tiltcal
{

namespace
{

const char* const CHANNELS_RGB[] = { "B", "G", "R" };
const char* const CHANNELS_Y[] = { "Y" };

/// OpenEXR takes pixels by addresses counted from the data window's origin; a render's crop
/// window starts within some thousand pixels of it.
const int FARTHEST_ORIGIN = 1'000'000;

class MemoryStream : public Imf::IStream
{
public:
	explicit MemoryStream(const PictureFile& picture) : IStream(picture.name.c_str()), bytes(picture.bytes) {}

	bool read(char out[], int n) override
	{
		if (n < 0 || at > bytes.size() || static_cast<size_t>(n) > bytes.size() - at)
			throw Iex::InputExc("it ends too early");
		std::memcpy(out, bytes.data() + at, static_cast<size_t>(n));
		at += static_cast<size_t>(n);
		return at < bytes.size();
	}
	uint64_t tellg() override { return at; }
	void seekg(uint64_t position) override { at = static_cast<size_t>(position); }

private:
	const std::string& bytes;
	size_t at = 0;
};

void CheckWindow(const std::string& file, const Imath::Box2i& window)
{
	CheckPictureSize(file, static_cast<long long>(window.max.x) - window.min.x + 1, static_cast<long long>(window.max.y) - window.min.y + 1);
	for (const int origin : { window.min.x, window.min.y })
		if (origin < -FARTHEST_ORIGIN || origin > FARTHEST_ORIGIN)
			throw FileError(fmt::format("{}: its data window begins at ({}, {}); it is damaged", file, window.min.x, window.min.y));
}

/// Channels R, G, B, or else Y. Throws FileError.
bool HasRgb(const std::string& file, const Imf::ChannelList& channels)
{
	const bool rgb = channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B");
	if (!rgb && !channels.findChannel("Y"))
		throw FileError(fmt::format("{}: has neither a channel Y nor channels R, G, B; export one of these", file));
	for (const char* const name : { "R", "G", "B", "Y" })
		if (const Imf::Channel* channel = channels.findChannel(name); channel && (std::strcmp(name, "Y") != 0) == rgb)
			if (channel->type == Imf::UINT || channel->xSampling != 1 || channel->ySampling != 1)
				throw FileError(fmt::format("{}: channel {} is of whole numbers or subsampled; export it as half or float for every pixel", file, name));
	return rgb;
}

}

cv::Mat DecodeExr(const PictureFile& picture, std::string* left_out)
{
	const std::string& file = picture.name;
	try
	{
		// Before its own tables are made; what these let pass is checked below.
		static const bool limited = [] { Imf::Header::setMaxImageSize(MAX_SIDE, MAX_SIDE); Imf::Header::setMaxTileSize(4096, 4096); return true; }();
		(void) limited;
		MemoryStream stream(picture);
		Imf::InputFile input(stream);
		const Imath::Box2i window = input.header().dataWindow();
		CheckWindow(file, window);
		const bool rgb = HasRgb(file, input.header().channels());
		const std::string read = rgb ? "RGB" : "Y";
		for (auto c = input.header().channels().begin(); left_out && c != input.header().channels().end(); ++c)
			if (std::strlen(c.name()) != 1 || read.find(c.name()[0]) == std::string::npos)
				*left_out += (left_out->empty() ? "" : ", ") + std::string(c.name());

		const int count = rgb ? 3 : 1;
		cv::Mat image(window.max.y - window.min.y + 1, window.max.x - window.min.x + 1, CV_MAKETYPE(CV_32F, count));
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
		throw FileError(fmt::format("{}: not a complete OpenEXR picture, or of a kind that is not read: {}", file, e.what()));
	}
}

}
