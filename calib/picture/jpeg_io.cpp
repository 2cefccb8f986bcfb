// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/jpeg_io.h"

#include <tiltcal/error.h>

#include <fmt/format.h>

#include <csetjmp>
#include <cstdio>
// These two need cstdio first.
#include <jpeglib.h>
#include <jerror.h>

#include <opencv2/imgproc.hpp>

namespace tiltcal
{

namespace
{

/// A progressive picture of a camera has some ten scans. Each one costs a pass over all
/// pixels however short it is, so that a small file could keep the program busy for hours.
const int MAX_SCANS = 200;

/// The state between libjpeg's calls. An error jumps back into Succeeds, so the steps keep nothing with a destructor.
struct Reader
{
	const PictureFile& picture;
	jpeg_decompress_struct jpeg{};
	jpeg_error_mgr errors{};
	jpeg_progress_mgr progress{};
	std::jmp_buf back{};
	cv::Mat* image = nullptr;
	char message[JMSG_LENGTH_MAX] = "";
};

Reader& ReaderOf(j_common_ptr jpeg) { return *static_cast<Reader*>(jpeg->client_data); }

void OnError(j_common_ptr jpeg)
{
	Reader& reader = ReaderOf(jpeg);
	jpeg->err->format_message(jpeg, reader.message);
	std::longjmp(reader.back, 1);
}

/// libjpeg goes on after damage with grey or wrong pixels and a warning. A calibration
/// must not: only what does not touch the pixels is let pass.
void OnMessage(j_common_ptr jpeg, int level)
{
	if (level >= 0)
		return;
	const int code = jpeg->err->msg_code;
	if (code != JWRN_EXTRANEOUS_DATA && code != JWRN_JFIF_MAJOR && code != JWRN_ADOBE_XFORM)
		OnError(jpeg);
}

void OnProgress(j_common_ptr jpeg)
{
	if (!jpeg->is_decompressor || reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= MAX_SCANS)
		return;
	Reader& reader = ReaderOf(jpeg);
	std::snprintf(reader.message, sizeof(reader.message), "more than %d scans", MAX_SCANS);
	std::longjmp(reader.back, 1);
}

bool Succeeds(Reader& reader, void (*step)(Reader&))
{
	if (setjmp(reader.back))
		return false;
	step(reader);
	return true;
}

void ReadHeader(Reader& r)
{
	jpeg_create_decompress(&r.jpeg);
	r.jpeg.client_data = &r;
	r.progress.progress_monitor = OnProgress;
	r.jpeg.progress = &r.progress;
	jpeg_mem_src(&r.jpeg, reinterpret_cast<const unsigned char*>(r.picture.bytes.data()), static_cast<unsigned long>(r.picture.bytes.size()));
	jpeg_read_header(&r.jpeg, TRUE);
}

void ReadPixels(Reader& r)
{
	r.jpeg.out_color_space = r.jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
	jpeg_start_decompress(&r.jpeg);
	while (r.jpeg.output_scanline < r.jpeg.output_height)
	{
		JSAMPROW row = r.image->ptr(static_cast<int>(r.jpeg.output_scanline));
		jpeg_read_scanlines(&r.jpeg, &row, 1);
	}
	jpeg_finish_decompress(&r.jpeg);
}

void Run(Reader& reader, void (*step)(Reader&))
{
	if (!Succeeds(reader, step))
		throw FileError(fmt::format("{}: truncated or damaged JPEG, or of a kind that is not read: {}; copy or export it again", reader.picture.name, reader.message));
}

/// Readies a reader, and frees what libjpeg took.
struct Guard
{
	Reader& r;

	explicit Guard(Reader& reader) : r(reader)
	{
		r.jpeg.err = jpeg_std_error(&r.errors);
		r.errors.error_exit = OnError;
		r.errors.emit_message = OnMessage;
		// jpeg_create_decompress clears all but this and the error manager.
		r.jpeg.client_data = &r;
	}
	~Guard() { jpeg_destroy_decompress(&r.jpeg); }
};

}

cv::Mat DecodeJpeg(const PictureFile& picture)
{
	Reader reader{ picture };
	const Guard guard(reader);
	Run(reader, ReadHeader);
	CheckPictureSize(picture.name, reader.jpeg.image_width, reader.jpeg.image_height);
	const int channels = reader.jpeg.num_components;
	if (channels == 4)
		throw FileError(fmt::format("{}: is a CMYK JPEG, made for printing; export it as RGB or grey", picture.name));
	if (channels != 1 && channels != 3)
		throw FileError(fmt::format("{}: has {} channels; 1 (grey) or 3 (colour) are read", picture.name, channels));
	cv::Mat image(static_cast<int>(reader.jpeg.image_height), static_cast<int>(reader.jpeg.image_width), CV_MAKETYPE(CV_8U, channels));
	reader.image = &image;
	Run(reader, ReadPixels);
	if (channels == 3)
		cv::cvtColor(image, image, cv::COLOR_RGB2BGR);
	return image;
}

bool HasSubsampledColour(const PictureFile& picture)
{
	Reader reader{ picture };
	const Guard guard(reader);
	Run(reader, ReadHeader);
	const jpeg_component_info* const components = reader.jpeg.comp_info;
	for (int k = 1; k < reader.jpeg.num_components; ++k)
		if (components[k].h_samp_factor < components[0].h_samp_factor || components[k].v_samp_factor < components[0].v_samp_factor)
			return true;
	return false;
}

}
