// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cluster/rows_file.h"

#include <png.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

namespace picture_rows
{

namespace
{

/// libpng's errors leave as C++ exceptions: it keeps nothing on the stack that would need to be freed, and libpng is built
/// with unwind tables on every system that has C++ exceptions at all (png_set_error_fn allows it).
void OnError(png_structp png, png_const_charp message)
{
	throw Failure(3, *static_cast<std::string*>(png_get_error_ptr(png)) + ": " + message);
}

void OnWarning(png_structp, png_const_charp) {}

void OnWrite(png_structp png, png_bytep data, size_t length)
{
	if (std::fwrite(data, 1, length, static_cast<std::FILE*>(png_get_io_ptr(png))) != length)
		throw Failure(3, *static_cast<std::string*>(png_get_error_ptr(png)) + ": cannot be written (" + std::strerror(errno) + ")");
}

void OnFlush(png_structp) {}

void OnRead(png_structp png, png_bytep data, size_t length)
{
	if (std::fread(data, 1, length, static_cast<std::FILE*>(png_get_io_ptr(png))) != length)
		throw Failure(3, *static_cast<std::string*>(png_get_error_ptr(png)) + ": it is truncated");
}

typedef std::unique_ptr<std::FILE, int (*)(std::FILE*)> File;

class PngReader
{
public:
	explicit PngReader(const std::string& file) : name(file), in(std::fopen(file.c_str(), "rb"), std::fclose)
	{
		if (!in)
			throw Failure(3, file + ": cannot be read (" + std::strerror(errno) + ")");
		png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &name, OnError, OnWarning);
		info = png_create_info_struct(png);
		try
		{
			png_set_read_fn(png, in.get(), OnRead);
			png_set_user_limits(png, 1000000, 1000000);
			png_read_info(png, info);
			if (png_get_interlace_type(png, info) != PNG_INTERLACE_NONE)
				throw Failure(1, file + ": an interlaced picture, which POV-Ray does not write");
		}
		catch (...)
		{
			png_destroy_read_struct(&png, &info, nullptr);
			throw;
		}
	}
	~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
	PngReader(const PngReader&) = delete;
	PngReader& operator=(const PngReader&) = delete;

	png_uint_32 Width() const { return png_get_image_width(png, info); }
	png_uint_32 Height() const { return png_get_image_height(png, info); }
	int Depth() const { return png_get_bit_depth(png, info); }
	int Colour() const { return png_get_color_type(png, info); }
	size_t RowBytes() const { return png_get_rowbytes(png, info); }
	void Row(png_bytep row) { png_read_row(png, row, nullptr); }

	png_structp png = nullptr;
	png_infop info = nullptr;

private:
	std::string name;
	File in;
};

/// What POV-Ray writes beside the pixels.
void CopyAncillary(const PngReader& from, png_structp png, png_infop info)
{
	png_fixed_point gamma, c[8];
	int intent;
	png_color_8p significant;
	png_color_16p background;
	png_timep time;
	png_textp text;
	png_uint_32 x, y;
	int unit, count;

	if (png_get_gAMA_fixed(from.png, from.info, &gamma))
		png_set_gAMA_fixed(png, info, gamma);
	if (png_get_cHRM_fixed(from.png, from.info, c, c + 1, c + 2, c + 3, c + 4, c + 5, c + 6, c + 7))
		png_set_cHRM_fixed(png, info, c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7]);
	if (png_get_sRGB(from.png, from.info, &intent))
		png_set_sRGB(png, info, intent);
	if (png_get_sBIT(from.png, from.info, &significant))
		png_set_sBIT(png, info, significant);
	if (png_get_bKGD(from.png, from.info, &background))
		png_set_bKGD(png, info, background);
	if (png_get_pHYs(from.png, from.info, &x, &y, &unit))
		png_set_pHYs(png, info, x, y, unit);
	if (png_get_tIME(from.png, from.info, &time))
		png_set_tIME(png, info, time);
	if (png_get_text(from.png, from.info, &text, &count) > 0)
		png_set_text(png, info, text, count);
}

class PngWriter
{
public:
	PngWriter(const std::string& temporary, const std::string& file) : name(file), out(std::fopen(temporary.c_str(), "wb"), std::fclose)
	{
		if (!out)
			throw Failure(3, file + ": cannot be written (" + std::strerror(errno) + ")");
		png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &name, OnError, OnWarning);
		info = png_create_info_struct(png);
		png_set_write_fn(png, out.get(), OnWrite, OnFlush);
	}
	~PngWriter() { png_destroy_write_struct(&png, &info); }
	PngWriter(const PngWriter&) = delete;
	PngWriter& operator=(const PngWriter&) = delete;

	void Begin(const PngReader& like, png_uint_32 height)
	{
		png_set_IHDR(png, info, like.Width(), height, like.Depth(), like.Colour(), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_BASE, PNG_FILTER_TYPE_BASE);
		png_colorp palette;
		int colours;
		if (png_get_PLTE(like.png, like.info, &palette, &colours))
			png_set_PLTE(png, info, palette, colours);
		CopyAncillary(like, png, info);
		png_write_info(png, info);
	}
	void Row(png_bytep row) { png_write_row(png, row); }
	void End()
	{
		png_write_end(png, nullptr);
		if (std::fflush(out.get()) != 0)
			throw Failure(3, name + ": cannot be written (" + std::strerror(errno) + ")");
	}

private:
	png_structp png = nullptr;
	png_infop info = nullptr;
	std::string name;
	File out;
};

}

int PngHeight(const std::string& file)
{
	return int(PngReader(file).Height());
}

void WritePng(const std::vector<Piece>& pieces, const std::string& temporary, const std::string& file)
{
	png_uint_32 height = 0;
	for (const Piece& piece : pieces)
		height += png_uint_32(piece.rows);
	const PngReader first(pieces[0].file);
	PngWriter writer(temporary, file);
	writer.Begin(first, height);
	std::vector<png_byte> row(first.RowBytes());
	for (const Piece& piece : pieces)
	{
		PngReader reader(piece.file);
		if (reader.Width() != first.Width() || reader.Depth() != first.Depth() || reader.Colour() != first.Colour())
			throw Failure(1, piece.file + ": another width or kind of pixels than " + pieces[0].file);
		if (png_uint_32(piece.first + piece.rows) > reader.Height())
			throw Failure(1, piece.file + ": has only " + std::to_string(reader.Height()) + " rows");
		for (int y = 0; y < piece.first; ++y)
			reader.Row(row.data());
		for (int y = 0; y < piece.rows; ++y)
		{
			reader.Row(row.data());
			writer.Row(row.data());
		}
	}
	writer.End();
}

}
