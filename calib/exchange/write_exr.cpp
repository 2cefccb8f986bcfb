// SPDX-License-Identifier: AGPL-3.0-or-later

#include "exchange/write_exr.h"

#include <tiltcal/error.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

namespace tiltcal
{

bool WriteExr(const std::string& temporary, const std::map<std::string, cv::Mat>& channels, const std::map<std::string, std::string>& notes)
{
	const cv::Size size = channels.begin()->second.size();
	try
	{
		Imf::Header header(size.width, size.height);
		header.compression() = Imf::ZIP_COMPRESSION;
		for (const auto& [name, text] : notes)
			header.insert(name, Imf::StringAttribute(text));
		Imf::FrameBuffer pixels;
		for (const auto& [name, values] : channels)
		{
			CV_Assert(values.type() == CV_32FC1 && values.size() == size);
			header.channels().insert(name, Imf::Channel(Imf::FLOAT));
			// OpenEXR takes pixels to write by a pointer that is not const.
			pixels.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<uchar*>(values.ptr())), sizeof(float), values.step[0]));
		}
		Imf::OutputFile out(temporary.c_str(), header);
		out.setFrameBuffer(pixels);
		out.writePixels(size.height);
	}
	catch (const std::exception&)
	{
		return false;
	}
	return true;
}

}
