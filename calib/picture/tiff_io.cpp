// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/tiff_io.h"

#include "base/while_any.h"
#include <tiltcal/error.h>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace tiltcal
{

namespace
{

/// Where libtiff's first error goes. Its handlers are the whole program's and OpenCV uses
/// libtiff too, so the handler looks here and not at what libtiff passes along.
thread_local std::string* first_error = nullptr;

void OnError(const char*, const char* format, va_list arguments)
{
	if (!first_error || !first_error->empty())
		return;
	char text[300];
	std::vsnprintf(text, sizeof(text), format, arguments);
	*first_error = text;
}

/// libjpeg's warnings inside a TIFF mean that it made up pixels.
void OnWarning(const char* module, const char* format, va_list arguments)
{
	if (module && std::strcmp(module, "JPEGLib") == 0)
		OnError(module, format, arguments);
}

struct Handlers
{
	TIFFErrorHandler error = TIFFSetErrorHandler(OnError), warning = TIFFSetWarningHandler(OnWarning);
	Handlers() = default;
	Handlers(const Handlers&) = delete;
	~Handlers()
	{
		TIFFSetErrorHandler(error);
		TIFFSetWarningHandler(warning);
	}
};

struct Memory
{
	const std::string& bytes;
	toff_t at = 0;
};

Memory& MemoryOf(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t OnRead(thandle_t handle, void* out, tmsize_t length)
{
	Memory& m = MemoryOf(handle);
	if (length <= 0 || m.at >= m.bytes.size())
		return 0;
	const size_t n = std::min(static_cast<size_t>(length), static_cast<size_t>(m.bytes.size() - m.at));
	std::memcpy(out, m.bytes.data() + m.at, n);
	m.at += n;
	return static_cast<tmsize_t>(n);
}

toff_t OnSeek(thandle_t handle, toff_t offset, int from)
{
	Memory& m = MemoryOf(handle);
	m.at = from == SEEK_SET ? offset : from == SEEK_CUR ? m.at + offset : m.bytes.size() + offset;
	return m.at;
}

tmsize_t OnWrite(thandle_t, void*, tmsize_t) { return 0; }
int OnClose(thandle_t) { return 0; }
toff_t OnSize(thandle_t handle) { return MemoryOf(handle).bytes.size(); }

struct Layout
{
	uint32_t width = 0, height = 0;
	uint16_t bits = 1, samples = 1, format = SAMPLEFORMAT_UINT, photometric = 0, planes = PLANARCONFIG_CONTIG, compression = COMPRESSION_NONE;
	int depth = -1;      ///< OpenCV's
	int colours = 1;     ///< samples that are no alpha

	size_t SampleBytes() const { return bits / 8u; }
	int Planes() const { return planes == PLANARCONFIG_SEPARATE ? colours : 1; }
	/// Samples that lie together in the file.
	size_t Together() const { return planes == PLANARCONFIG_SEPARATE ? 1u : samples; }
};

int DepthOf(const Layout& l)
{
	if (l.format == SAMPLEFORMAT_IEEEFP)
		return l.bits == 32 ? CV_32F : l.bits == 64 ? CV_64F : -1;
	return l.format != SAMPLEFORMAT_UINT ? -1 : l.bits == 8 ? CV_8U : l.bits == 16 ? CV_16U : -1;
}

void CheckKind(const std::string& file, Layout& l)
{
	const bool grey = l.photometric == PHOTOMETRIC_MINISBLACK || l.photometric == PHOTOMETRIC_MINISWHITE;
	const bool jpeg = l.compression == COMPRESSION_JPEG;
	if (!grey && l.photometric != PHOTOMETRIC_RGB && !(jpeg && l.photometric == PHOTOMETRIC_YCBCR))
		throw FileError(fmt::format("{}: TIFF of photometric kind {} (palette, CMYK, Lab, raw ...) is not read; export it as grey or RGB", file, l.photometric));
	l.colours = grey ? 1 : 3;
	if (l.samples < l.colours || l.samples > l.colours + 1)
		throw FileError(fmt::format("{}: has {} channels; 1 (grey) or 3 (colour) are read, with or without alpha", file, l.samples));
	l.depth = DepthOf(l);
	if (l.depth < 0 || (l.photometric == PHOTOMETRIC_MINISWHITE && l.depth != CV_8U && l.depth != CV_16U))
		throw FileError(fmt::format("{}: its samples (format {}, {} bits) are not read; convert it to 8 or 16 bits unsigned, or 32 bits floating point",
			file, l.format, l.bits));
	const uint16_t known[] = { COMPRESSION_NONE, COMPRESSION_LZW, COMPRESSION_JPEG, COMPRESSION_ADOBE_DEFLATE, COMPRESSION_DEFLATE, COMPRESSION_PACKBITS,
		COMPRESSION_LZMA, COMPRESSION_ZSTD };
	if (std::find(std::begin(known), std::end(known), l.compression) == std::end(known) || !TIFFIsCODECConfigured(l.compression))
		throw FileError(fmt::format("{}: TIFF compression {} is not read; save it without compression, or with LZW or Deflate", file, l.compression));
}

/// Raw files of Nikon and Adobe (NEF, DNG) are TIFFs whose first picture is a small preview.
void RefusePreview(const std::string& file, TIFF* tiff)
{
	uint32_t kind = 0;
	void* version = nullptr;
	TIFFGetFieldDefaulted(tiff, TIFFTAG_SUBFILETYPE, &kind);
	if ((kind & FILETYPE_REDUCEDIMAGE) != 0 || TIFFGetField(tiff, TIFFTAG_DNGVERSION, &version))
		throw FileError(fmt::format("{}: is a raw file, or begins with a preview of reduced size: develop it to a TIFF of 16 bits, in full size and without sharpening", file));
}

bool HasSubsampledColour(TIFF* tiff)
{
	uint16_t photometric = 0, across = 1, down = 1;
	TIFFGetFieldDefaulted(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
	TIFFGetFieldDefaulted(tiff, TIFFTAG_YCBCRSUBSAMPLING, &across, &down);
	return photometric == PHOTOMETRIC_YCBCR && (across > 1 || down > 1);
}

Layout ReadLayout(const std::string& file, TIFF* tiff)
{
	RefusePreview(file, tiff);
	Layout l;
	TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &l.width);
	TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &l.height);
	CheckPictureSize(file, l.width, l.height);
	TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &l.bits);
	TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &l.samples);
	TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &l.format);
	TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &l.planes);
	TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &l.compression);
	if (!TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &l.photometric))
		throw FileError(fmt::format("{}: damaged TIFF: it does not say whether it is grey or colour", file));
	CheckKind(file, l);
	if (l.photometric == PHOTOMETRIC_YCBCR)
		TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
	return l;
}

/// Copies `pixels` of a strip's row or a tile's row into plane `plane` at (x, y), without alpha.
void Place(const Layout& l, const unsigned char* from, cv::Mat& image, int plane, uint32_t x, uint32_t y, uint32_t pixels)
{
	const size_t sample = l.SampleBytes(), step = l.Together() * sample, colours = static_cast<size_t>(l.colours);
	unsigned char* to = image.ptr(static_cast<int>(y)) + x * colours * sample;
	const size_t copied = l.planes == PLANARCONFIG_SEPARATE ? sample : colours * sample;
	to += static_cast<size_t>(plane) * sample;
	for (uint32_t i = 0; i < pixels; ++i, from += step, to += colours * sample)
		std::memcpy(to, from, copied);
}

bool ReadStrips(TIFF* tiff, const Layout& l, cv::Mat& image)
{
	std::vector<unsigned char> row(static_cast<size_t>(TIFFScanlineSize64(tiff)));
	if (row.size() < l.width * l.Together() * l.SampleBytes())
		return false;
	for (int plane = 0; plane < l.Planes(); ++plane)
		for (uint32_t y = 0; y < l.height; ++y)
		{
			if (TIFFReadScanline(tiff, row.data(), y, static_cast<uint16_t>(plane)) != 1)
				return false;
			Place(l, row.data(), image, plane, 0, y, l.width);
		}
	return true;
}

bool ReadTiles(const std::string& file, TIFF* tiff, const Layout& l, cv::Mat& image)
{
	uint32_t width = 0, height = 0;
	TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &width);
	TIFFGetField(tiff, TIFFTAG_TILELENGTH, &height);
	// 4096 x 4096 is more than any program writes.
	if (width < 1 || height < 1 || width > 4096 || height > 4096)
		throw FileError(fmt::format("{}: damaged TIFF: tiles of {} x {} pixels", file, width, height));
	std::vector<unsigned char> tile(static_cast<size_t>(TIFFTileSize64(tiff)));
	const size_t row = width * l.Together() * l.SampleBytes();
	if (tile.size() < row * height)
		return false;
	for (int plane = 0; plane < l.Planes(); ++plane)
		for (uint32_t y = 0; y < l.height; y += height)
			for (uint32_t x = 0; x < l.width; x += width)
			{
				if (TIFFReadTile(tiff, tile.data(), x, y, 0, static_cast<uint16_t>(plane)) < 0)
					return false;
				for (uint32_t j = 0; j < std::min(height, l.height - y); ++j)
					Place(l, tile.data() + j * row, image, plane, x, y + j, std::min(width, l.width - x));
			}
	return true;
}

cv::Mat Decode(const PictureFile& picture, TIFF* tiff, const std::string& error, std::string* left_out)
{
	const Layout l = ReadLayout(picture.name, tiff);
	if (left_out && l.samples > l.colours)
		*left_out = "alpha";
	cv::Mat image(static_cast<int>(l.height), static_cast<int>(l.width), CV_MAKETYPE(l.depth, l.colours));
	const bool whole = TIFFIsTiled(tiff) ? ReadTiles(picture.name, tiff, l, image) : ReadStrips(tiff, l, image);
	if (!whole || !error.empty())
		throw FileError(fmt::format("{}: damaged or truncated TIFF: {}; copy it again", picture.name, error.empty() ? "pixels are missing" : error));
	if (l.photometric == PHOTOMETRIC_MINISWHITE)
		cv::bitwise_not(image, image);
	if (l.colours == 3)
		cv::mixChannels(cv::Mat(image.clone()), image, { 0, 2, 1, 1, 2, 0 });   // cvtColor takes no doubles
	return image;
}

}

cv::Mat DecodeTiff(const PictureFile& picture, std::string* left_out, bool* subsampled_colour)
{
	const WhileAny<Handlers> handlers;
	std::string error;
	first_error = &error;
	Memory memory{ picture.bytes };
	struct Close
	{
		void operator()(TIFF* tiff) const { TIFFClose(tiff); first_error = nullptr; }
	};
	// m: no memory mapping; every access goes through OnRead, which knows the end.
	const std::unique_ptr<TIFF, Close> tiff(TIFFClientOpen(picture.name.c_str(), "rm", &memory, OnRead, OnWrite, OnSeek, OnClose, OnSize, nullptr, nullptr));
	if (!tiff)
	{
		first_error = nullptr;
		throw FileError(fmt::format("{}: damaged TIFF: {}; copy it again", picture.name, error));
	}
	if (subsampled_colour)
		*subsampled_colour = HasSubsampledColour(tiff.get());
	return Decode(picture, tiff.get(), error, left_out);
}

}
