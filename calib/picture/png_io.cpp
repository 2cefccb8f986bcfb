// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/png_io.h"

#include <tiltcal/error.h>

#include <fmt/format.h>
#include <png.h>

#include <cstdio>
#include <cstring>
#include <vector>

namespace tiltcal
{

namespace
{

/// The state between libpng's calls. An error jumps back into Succeeds, so the steps keep nothing with a destructor.
struct Reader
{
	const PictureFile& picture;
	size_t at = 0;
	png_structp png = nullptr;
	png_infop info = nullptr;
	png_bytepp rows = nullptr;
	char message[200] = "";
};

void OnError(png_structp png, png_const_charp message)
{
	Reader& reader = *static_cast<Reader*>(png_get_error_ptr(png));
	std::snprintf(reader.message, sizeof(reader.message), "%s", message);
	png_longjmp(png, 1);
}

void OnWarning(png_structp, png_const_charp) {}

void OnRead(png_structp png, png_bytep out, size_t length)
{
	Reader& reader = *static_cast<Reader*>(png_get_io_ptr(png));
	if (length > reader.picture.bytes.size() - reader.at)
		png_error(png, "it is truncated");
	std::memcpy(out, reader.picture.bytes.data() + reader.at, length);
	reader.at += length;
}

bool Succeeds(Reader& reader, void (*step)(Reader&))
{
	if (setjmp(png_jmpbuf(reader.png)))
		return false;
	step(reader);
	return true;
}

void ReadHeader(Reader& r)
{
	png_set_read_fn(r.png, &r, OnRead);
	// The sizes are checked, in our words, by CheckPictureSize.
	png_set_user_limits(r.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
	png_read_info(r.png, r.info);
}

/// To 8 or 16 bits in the machine's byte order, grey or blue first.
void Prepare(Reader& r)
{
	const int colour = png_get_color_type(r.png, r.info), depth = png_get_bit_depth(r.png, r.info);
	if (colour == PNG_COLOR_TYPE_PALETTE)
		png_set_palette_to_rgb(r.png);
	if (colour == PNG_COLOR_TYPE_GRAY && depth < 8)
		png_set_expand_gray_1_2_4_to_8(r.png);
	png_set_strip_alpha(r.png);
	png_set_bgr(r.png);
	const png_uint_16 one = 1;
	if (depth == 16 && *reinterpret_cast<const unsigned char*>(&one) == 1)
		png_set_swap(r.png);
	png_set_interlace_handling(r.png);
	png_read_update_info(r.png, r.info);
}

void ReadPixels(Reader& r)
{
	png_read_image(r.png, r.rows);
	png_read_end(r.png, nullptr);
}

/// Deflate makes no more than 1032 bytes of one (zlib's technical details): a header that
/// promises more lies, and is found out before memory is taken.
void CheckLength(const Reader& r, const std::string& name)
{
	const double coded = static_cast<double>(png_get_image_width(r.png, r.info)) * png_get_image_height(r.png, r.info)
		* png_get_channels(r.png, r.info) * png_get_bit_depth(r.png, r.info) / 8;
	if (coded > 1032.0 * static_cast<double>(r.picture.bytes.size()))
		throw FileError(fmt::format("{}: damaged PNG: {} bytes cannot hold the {} x {} pixels of its header; copy it again", name,
			r.picture.bytes.size(), png_get_image_width(r.png, r.info), png_get_image_height(r.png, r.info)));
}

void Run(Reader& reader, void (*step)(Reader&))
{
	if (!Succeeds(reader, step))
		throw FileError(fmt::format("{}: damaged PNG: {}; copy it again", reader.picture.name, reader.message));
}

}

cv::Mat DecodePng(const PictureFile& picture, std::string* left_out)
{
	Reader reader{ picture };
	reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, OnError, OnWarning);
	if (!reader.png)
		throw std::bad_alloc();
	struct Guard
	{
		Reader& r;
		~Guard() { png_destroy_read_struct(&r.png, &r.info, nullptr); }
	} guard{ reader };
	reader.info = png_create_info_struct(reader.png);
	if (!reader.info)
		throw std::bad_alloc();

	Run(reader, ReadHeader);
	const long long width = png_get_image_width(reader.png, reader.info), height = png_get_image_height(reader.png, reader.info);
	CheckPictureSize(picture.name, width, height);
	CheckLength(reader, picture.name);
	if (left_out && ((png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_ALPHA) || png_get_valid(reader.png, reader.info, PNG_INFO_tRNS)))
		*left_out = "alpha";
	Run(reader, Prepare);
	const int channels = png_get_channels(reader.png, reader.info), depth = png_get_bit_depth(reader.png, reader.info);
	if ((channels != 1 && channels != 3) || (depth != 8 && depth != 16))
		throw FileError(fmt::format("{}: PNG with {} channels of {} bits is not read", picture.name, channels, depth));
	cv::Mat image(static_cast<int>(height), static_cast<int>(width), CV_MAKETYPE(depth == 8 ? CV_8U : CV_16U, channels));
	std::vector<png_bytep> rows;
	for (int y = 0; y < image.rows; ++y)
		rows.push_back(image.ptr(y));
	reader.rows = rows.data();
	Run(reader, ReadPixels);
	return image;
}

}
