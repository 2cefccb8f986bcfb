// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/picture_seeds.h"

#include <tiltcal/photo.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <exiv2/exiv2.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <png.h>
#include <tiffio.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace
{

const int SQUARE = 20;

/// sRGB coded (IEC 61966-2-1), 0 to 1.
cv::Mat Coded(const cv::Mat& linear)
{
	cv::Mat coded = linear.clone();
	for (float& v : cv::Mat_<float>(coded))
		v = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
	return coded;
}

cv::Mat As(const cv::Mat& image, int depth, double scale, int channels)
{
	cv::Mat out;
	image.convertTo(out, depth, scale);
	if (channels > 1)
		cv::merge(std::vector<cv::Mat>(static_cast<size_t>(channels), out), out);
	return out;
}

/// Interlaced, with a palette of 16 greys in 4 bits.
void WritePalettePng(const std::string& file, const cv::Mat& coded)
{
	std::FILE* out = std::fopen(file.c_str(), "wb");
	png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
	png_infop info = png_create_info_struct(png);
	png_init_io(png, out);
	png_color palette[16];
	for (int i = 0; i < 16; ++i)
		palette[i].red = palette[i].green = palette[i].blue = static_cast<png_byte>(17 * i);
	png_set_IHDR(png, info, png_uint_32(coded.cols), png_uint_32(coded.rows), 4, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_ADAM7, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
	png_set_PLTE(png, info, palette, 16);
	png_write_info(png, info);
	png_set_packing(png);
	cv::Mat index;
	coded.convertTo(index, CV_8U, 15);
	std::vector<png_bytep> rows;
	for (int y = 0; y < index.rows; ++y)
		rows.push_back(index.ptr(y));
	png_write_image(png, rows.data());
	png_write_end(png, info);
	png_destroy_write_struct(&png, &info);
	std::fclose(out);
}

/// 16-bit colour in tiles of 64, planes apart, big-endian: what OpenCV does not write.
void WriteTiledTiff(const std::string& file, const cv::Mat& coded16)
{
	TIFF* tiff = TIFFOpen(file.c_str(), "wb");
	const uint16_t three = 3, bits = 16;
	TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, coded16.cols);
	TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, coded16.rows);
	TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
	TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, three);
	TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
	TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_SEPARATE);
	TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
	TIFFSetField(tiff, TIFFTAG_ORIENTATION, uint16_t(6));
	TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 64);
	TIFFSetField(tiff, TIFFTAG_TILELENGTH, 64);
	for (uint16_t plane = 0; plane < 3; ++plane)
		for (int y = 0; y < coded16.rows; y += 64)
			for (int x = 0; x < coded16.cols; x += 64)
			{
				cv::Mat tile = cv::Mat::zeros(64, 64, CV_16U);
				const cv::Rect part(x, y, std::min(64, coded16.cols - x), std::min(64, coded16.rows - y));
				coded16(part).copyTo(tile(cv::Rect(0, 0, part.width, part.height)));
				TIFFWriteTile(tiff, tile.data, uint32_t(x), uint32_t(y), 0, plane);
			}
	TIFFClose(tiff);
}

Imf::Header ExrHeader(const cv::Mat& image, const std::vector<const char*>& names, Imf::PixelType type, Imf::Compression compression)
{
	const Imath::Box2i data(Imath::V2i(7, -4), Imath::V2i(7 + image.cols - 1, -4 + image.rows - 1)), display(Imath::V2i(0, 0), Imath::V2i(999, 499));
	Imf::Header header(display, data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, compression);
	for (const char* const name : names)
		header.channels().insert(name, Imf::Channel(type));
	return header;
}

template<typename Pixel>
Imf::FrameBuffer ExrBuffer(const cv::Mat& pixels, const std::vector<const char*>& names, Imf::PixelType type)
{
	Imf::FrameBuffer buffer;
	for (const char* const name : names)
		buffer.insert(name, Imf::Slice(type, reinterpret_cast<char*>(pixels.data) + 4 * pixels.step[0] - 7 * sizeof(Pixel), sizeof(Pixel), pixels.step[0]));
	return buffer;
}

void WriteExr(const std::string& file, const cv::Mat& linear, const std::vector<const char*>& names, bool half, bool tiled, Imf::Compression compression)
{
	const Imf::PixelType type = half ? Imf::HALF : Imf::FLOAT;
	cv::Mat pixels;
	linear.convertTo(pixels, half ? CV_16F : CV_32F);
	Imf::Header header = ExrHeader(linear, names, type, compression);
	const Imf::FrameBuffer buffer = half ? ExrBuffer<uint16_t>(pixels, names, type) : ExrBuffer<float>(pixels, names, type);
	if (tiled)
	{
		header.setTileDescription(Imf::TileDescription(32, 32, Imf::ONE_LEVEL));
		Imf::TiledOutputFile out(file.c_str(), header);
		out.setFrameBuffer(buffer);
		out.writeTiles(0, out.numXTiles() - 1, 0, out.numYTiles() - 1);
		return;
	}
	Imf::OutputFile out(file.c_str(), header);
	out.setFrameBuffer(buffer);
	out.writePixels(linear.rows);
}

/// The picture first, then a part with depth.
void WriteParts(const std::string& file, const cv::Mat& linear)
{
	std::vector<Imf::Header> headers;
	const std::vector<std::vector<const char*>> names{ { "R", "G", "B" }, { "Z" } };
	for (const auto& n : names)
	{
		headers.push_back(ExrHeader(linear, n, Imf::FLOAT, Imf::ZIP_COMPRESSION));
		headers.back().setName(n[0]);
		headers.back().setType(Imf::SCANLINEIMAGE);
	}
	Imf::MultiPartOutputFile out(file.c_str(), headers.data(), 2);
	for (int part = 0; part < 2; ++part)
	{
		Imf::OutputPart one(out, part);
		one.setFrameBuffer(ExrBuffer<float>(linear, names[size_t(part)], Imf::FLOAT));
		one.writePixels(linear.rows);
	}
}

/// What a camera writes, with a maker's note, on a picture that says to be turned.
void AddExif(const std::string& file)
{
	const auto image = Exiv2::ImageFactory::open(file);
	Exiv2::ExifData exif;
	exif["Exif.Image.Make"] = std::string("Canon");
	exif["Exif.Image.Model"] = std::string("Canon EOS 6D");
	exif["Exif.Image.Orientation"] = uint16_t(6);
	exif["Exif.Photo.FocalLength"] = Exiv2::URational(45, 1);
	exif["Exif.Photo.FNumber"] = Exiv2::URational(28, 10);
	exif["Exif.Photo.LensModel"] = std::string("TS-E45mm f/2.8");
	exif["Exif.Photo.PixelXDimension"] = uint32_t(Checkerboard().cols);
	exif["Exif.Photo.FocalPlaneXResolution"] = Exiv2::URational(3810584, 1000);
	exif["Exif.Photo.FocalPlaneYResolution"] = Exiv2::URational(3815899, 1000);
	exif["Exif.Photo.FocalPlaneResolutionUnit"] = uint16_t(2);
	exif["Exif.CanonCs.MaxAperture"] = int16_t(96);
	exif["Exif.CanonFi.FileNumber"] = uint32_t(1001);
	image->setExifData(exif);
	image->writeMetadata();
}

}

cv::Mat Checkerboard()
{
	cv::Mat board(7 * SQUARE, 9 * SQUARE, CV_32F);
	for (int y = 0; y < board.rows; ++y)
		for (int x = 0; x < board.cols; ++x)
		{
			const int i = x / SQUARE - 1, j = y / SQUARE - 1;
			const bool black = i >= 0 && j >= 0 && i < 7 && j < 5 && (i + j) % 2 == 0;
			board.at<float>(y, x) = black ? 0.05f : 0.8f;
		}
	cv::GaussianBlur(board, board, cv::Size(), 1.2);
	return board;
}

std::vector<PictureSeed> PictureSeeds(const std::string& folder)
{
	const cv::Mat linear = Checkerboard(), coded = Coded(linear);
	std::vector<PictureSeed> seeds;
	const auto add = [&](const std::string& name, double tolerance, const auto& write)
	{
		const std::string file = folder + "/" + name;
		write(file);
		std::ifstream in(file, std::ios::binary);
		seeds.push_back({ name, std::string(std::istreambuf_iterator<char>(in), {}), tolerance });
		if (seeds.back().bytes.empty())
			throw std::runtime_error(file + " was not written");
	};
	const auto opencv = [&](int depth, double scale, int channels, std::vector<int> options = {})
		{ return [=](const std::string& file) { cv::imwrite(file, As(coded, depth, scale, channels), options); }; };
	// Linear light grows by up to 2.3 for one of code: half a code of 8 bits is 0.0045, of 4 bits 0.077.
	const double EIGHT = 0.005, SIXTEEN = 2e-5, FOUR = 0.08;
	// Quality 95 leaves some codes of 8 bits at the edges.
	const double LOSSY = 0.06;
	add("grey8.png", EIGHT, opencv(CV_8U, 255, 1));
	add("rgb16.png", SIXTEEN, opencv(CV_16U, 65535, 3));
	add("rgba8.png", EIGHT, opencv(CV_8U, 255, 4));
	add("palette4-interlaced.png", FOUR, [&](const std::string& file) { WritePalettePng(file, coded); });
	add("exif.png", EIGHT, [&](const std::string& file) { opencv(CV_8U, 255, 3)(file); AddExif(file); });
	add("grey.jpg", LOSSY, opencv(CV_8U, 255, 1));
	add("exif.jpg", LOSSY, [&](const std::string& file) { opencv(CV_8U, 255, 3)(file); AddExif(file); });
	add("progressive.jpg", LOSSY, opencv(CV_8U, 255, 3, { cv::IMWRITE_JPEG_PROGRESSIVE, 1, cv::IMWRITE_JPEG_RST_INTERVAL, 4 }));
	add("grey8-packbits.tif", EIGHT, opencv(CV_8U, 255, 1, { cv::IMWRITE_TIFF_COMPRESSION, COMPRESSION_PACKBITS }));
	add("rgb16-lzw.tif", SIXTEEN, opencv(CV_16U, 65535, 3, { cv::IMWRITE_TIFF_COMPRESSION, COMPRESSION_LZW }));
	add("exif.tif", EIGHT, [&](const std::string& file) { opencv(CV_8U, 255, 3)(file); AddExif(file); });
	add("jpeg.tif", LOSSY, opencv(CV_8U, 255, 3, { cv::IMWRITE_TIFF_COMPRESSION, COMPRESSION_JPEG, TIFFTAG_ROWSPERSTRIP, 16 }));
	add("float.tif", 1e-6, [&](const std::string& file) { cv::imwrite(file, As(linear, CV_32F, 1, 1)); });
	add("planar-tiled.tif", SIXTEEN, [&](const std::string& file) { WriteTiledTiff(file, As(coded, CV_16U, 65535, 1)); });
	// Half has 11 bits.
	const double HALF = 0.8 / 2048;
	add("y-float.exr", 1e-6, [&](const std::string& file) { WriteExr(file, linear, { "Y" }, false, false, Imf::ZIP_COMPRESSION); });
	add("rgb-half.exr", HALF, [&](const std::string& file) { WriteExr(file, linear, { "R", "G", "B" }, true, false, Imf::PIZ_COMPRESSION); });
	add("rgba-tiled.exr", HALF, [&](const std::string& file) { WriteExr(file, linear, { "R", "G", "B", "A" }, true, true, Imf::ZIPS_COMPRESSION); });
	add("y-dwaa.exr", 0.05, [&](const std::string& file) { WriteExr(file, linear, { "Y" }, true, false, Imf::DWAA_COMPRESSION); });
	add("y-b44.exr", 0.05, [&](const std::string& file) { WriteExr(file, linear, { "Y" }, true, false, Imf::B44_COMPRESSION); });
	add("y-pxr24.exr", 1e-4, [&](const std::string& file) { WriteExr(file, linear, { "Y" }, false, true, Imf::PXR24_COMPRESSION); });
	add("two-parts.exr", 1e-6, [&](const std::string& file) { WriteParts(file, linear); });
	return seeds;
}
