// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cluster/rows_file.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

namespace picture_rows
{

namespace
{

/// Rows that are read and written at a time: what the compressions put together at the most.
const int Chunk = 32;

/// A chunk's memory: channel after channel, each a row after row.
Imf::FrameBuffer Frame(const Imf::ChannelList& channels, const Imath::Box2i& window, int top, std::vector<char>& memory)
{
	const size_t width = size_t(window.max.x - window.min.x + 1);
	size_t size = 0;
	for (auto c = channels.begin(); c != channels.end(); ++c)
		size += (c.channel().type == Imf::HALF ? 2 : 4) * width * Chunk;
	memory.resize(size);
	Imf::FrameBuffer frame;
	char* at = memory.data();
	for (auto c = channels.begin(); c != channels.end(); ++c)
	{
		const size_t bytes = c.channel().type == Imf::HALF ? 2 : 4;
		// Relative to the window's left and to the chunk's top.
		char* origin = at - ptrdiff_t(bytes) * window.min.x - ptrdiff_t(bytes * width) * top;
		frame.insert(c.name(), Imf::Slice(c.channel().type, origin, bytes, bytes * width));
		at += bytes * width * Chunk;
	}
	return frame;
}

void CheckAlike(const Imf::Header& a, const Imf::Header& b, const std::string& file, const std::string& first)
{
	const Imath::Box2i &wa = a.dataWindow(), &wb = b.dataWindow();
	if (wa.min.x != wb.min.x || wa.max.x != wb.max.x || !(a.channels() == b.channels()))
		throw Failure(1, file + ": another width or kind of pixels than " + first);
}

void Copy(Imf::InputFile& in, const Piece& piece, int& at, Imf::OutputFile& out)
{
	const Imath::Box2i window = in.header().dataWindow();
	if (piece.first + piece.rows > window.max.y - window.min.y + 1)
		throw Failure(1, piece.file + ": has only " + std::to_string(window.max.y - window.min.y + 1) + " rows");
	std::vector<char> memory;
	for (int row = 0; row < piece.rows; row += Chunk)
	{
		const int count = std::min(Chunk, piece.rows - row), top = window.min.y + piece.first + row;
		in.setFrameBuffer(Frame(in.header().channels(), window, top, memory));
		in.readPixels(top, top + count - 1);
		out.setFrameBuffer(Frame(in.header().channels(), window, at, memory));
		out.writePixels(count);
		at += count;
	}
}

Imf::Header HeaderOf(const std::string& file, int height)
{
	Imf::InputFile first(file.c_str());
	Imf::Header header = first.header();
	for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
		if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
			throw Failure(1, file + ": subsampled channels, which POV-Ray does not write");
	header.dataWindow().min.y = 0;
	header.dataWindow().max.y = height - 1;
	header.displayWindow() = header.dataWindow();
	header.lineOrder() = Imf::INCREASING_Y;
	return header;
}

}

bool IsPng(const std::string& file)
{
	std::ifstream in(file, std::ios::binary);
	if (!in)
		throw Failure(3, file + ": cannot be read (" + std::strerror(errno) + ")");
	char begin[4] = {};
	in.read(begin, sizeof(begin));
	if (std::memcmp(begin, "\x89PNG", 4) == 0)
		return true;
	if (std::memcmp(begin, "\x76\x2f\x31\x01", 4) == 0)
		return false;
	throw Failure(3, file + ": neither PNG nor OpenEXR");
}

int ExrHeight(const std::string& file)
{
	Imf::InputFile in(file.c_str());
	return in.header().dataWindow().max.y - in.header().dataWindow().min.y + 1;
}

int HeightOf(const std::string& file)
{
	return IsPng(file) ? PngHeight(file) : ExrHeight(file);
}

void WriteExr(const std::vector<Piece>& pieces, const std::string& temporary, const std::string& file)
{
	int height = 0, at = 0;
	for (const Piece& piece : pieces)
		height += piece.rows;
	const Imf::Header header = HeaderOf(pieces[0].file, height);
	try
	{
		Imf::OutputFile out(temporary.c_str(), header);
		for (const Piece& piece : pieces)
		{
			if (IsPng(piece.file))
				throw Failure(1, piece.file + ": another format than " + pieces[0].file);
			Imf::InputFile in(piece.file.c_str());
			CheckAlike(header, in.header(), piece.file, pieces[0].file);
			Copy(in, piece, at, out);
		}
	}
	catch (const Failure&)
	{
		throw;
	}
	catch (const std::exception& error)
	{
		throw Failure(3, file + ": cannot be written, or a part of it not read (" + error.what() + ")");
	}
	try
	{
		// What the destructor could not write is known only by reading it back.
		if (!Imf::InputFile(temporary.c_str()).isComplete())
			throw Failure(3, file + ": cannot be written; is the disk full?");
	}
	catch (const Failure&)
	{
		throw;
	}
	catch (const std::exception& error)
	{
		throw Failure(3, file + ": cannot be written (" + error.what() + ")");
	}
}

}
