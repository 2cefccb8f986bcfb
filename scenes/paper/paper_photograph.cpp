// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_photograph.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "picture/image_io.h"
#include "picture/picture_file.h"
#include <tiltcal/transfer.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <csetjmp>
#include <cstdio>
#include <random>
// Needs cstdio first.
#include <jpeglib.h>

namespace paper
{

namespace
{

struct Copier
{
	const tiltcal::PictureFile& like;
	const cv::Mat& rgb;   ///< or grey
	FILE* out;
	jpeg_decompress_struct source{};
	jpeg_compress_struct target{};
	jpeg_error_mgr errors{};
	std::jmp_buf back{};
	char message[JMSG_LENGTH_MAX] = "";
};

void OnError(j_common_ptr jpeg)
{
	Copier& copier = *static_cast<Copier*>(jpeg->client_data);
	jpeg->err->format_message(jpeg, copier.message);
	std::longjmp(copier.back, 1);
}

/// Nothing in here has a destructor: libjpeg's errors jump out of it.
bool Compress(Copier& c)
{
	c.source.err = c.target.err = jpeg_std_error(&c.errors);
	c.errors.error_exit = OnError;
	c.source.client_data = c.target.client_data = &c;
	if (setjmp(c.back))
		return false;
	jpeg_create_decompress(&c.source);
	jpeg_create_compress(&c.target);
	c.source.client_data = c.target.client_data = &c;
	jpeg_mem_src(&c.source, reinterpret_cast<const unsigned char*>(c.like.bytes.data()), static_cast<unsigned long>(c.like.bytes.size()));
	jpeg_read_header(&c.source, TRUE);
	// What jpeg_copy_critical_parameters calls for: the pixels that are to be compressed are RGB or grey.
	jpeg_copy_critical_parameters(&c.source, &c.target);
	c.target.image_width = static_cast<JDIMENSION>(c.rgb.cols);
	c.target.image_height = static_cast<JDIMENSION>(c.rgb.rows);
	c.target.input_components = c.rgb.channels();
	c.target.in_color_space = c.rgb.channels() == 1 ? JCS_GRAYSCALE : JCS_RGB;
	c.target.optimize_coding = TRUE;
	jpeg_stdio_dest(&c.target, c.out);
	jpeg_start_compress(&c.target, TRUE);
	while (c.target.next_scanline < c.target.image_height)
	{
		JSAMPROW row = const_cast<unsigned char*>(c.rgb.ptr(static_cast<int>(c.target.next_scanline)));
		jpeg_write_scanlines(&c.target, &row, 1);
	}
	jpeg_finish_compress(&c.target);
	return true;
}

void WriteJpegLike(const std::string& file, const cv::Mat& codes, const tiltcal::PictureFile& like)
{
	cv::Mat rgb = codes;
	if (codes.channels() == 3)
		cv::cvtColor(codes, rgb, cv::COLOR_BGR2RGB);
	tiltcal::WriteAtomically(file, [&](const std::string& temporary)
	{
		FILE* out = std::fopen(temporary.c_str(), "wb");
		if (!out)
			return false;
		Copier copier{ like, rgb, out };
		const bool good = Compress(copier);
		jpeg_destroy_compress(&copier.target);
		jpeg_destroy_decompress(&copier.source);
		if (std::fclose(out) != 0)
			return false;
		if (!good)
			throw tiltcal::FileError(fmt::format("{}: as JPEG like {}: {}", file, like.name, copier.message));
		return true;
	});
}

}

Sensor ReadSensor(const std::string& camera_json)
{
	try
	{
		const auto json = nlohmann::json::parse(tiltcal::ReadText(camera_json, "a camera.json"));
		return { json.at("full_well_electrons").get<double>(), json.at("read_noise_electrons").get<double>() };
	}
	catch (const nlohmann::json::exception& e)
	{
		throw tiltcal::FileError(fmt::format("{}: {}; it must hold full_well_electrons and read_noise_electrons", camera_json, e.what()));
	}
}

cv::Mat Expose(const cv::Mat& linear, double gain, const Sensor& sensor, unsigned seed)
{
	std::mt19937 random(seed);
	cv::Mat codes(linear.size(), CV_MAKETYPE(CV_8U, linear.channels()));
	const int values = linear.cols * linear.channels();
	std::normal_distribution<double> read(0, sensor.read_noise_electrons);
	for (int y = 0; y < linear.rows; ++y)
	{
		const float* const light = linear.ptr<float>(y);
		unsigned char* const code = codes.ptr(y);
		for (int x = 0; x < values; ++x)
		{
			const double mean = sensor.full_well_electrons * gain * std::max(0.0f, light[x]);
			// Of some hundred electrons and more Poisson's distribution is Gauss's.
			const double electrons = mean > 200 ? mean + std::sqrt(mean) * std::normal_distribution<double>()(random)
				: mean > 0 ? std::poisson_distribution<int>(mean)(random) : 0;
			code[x] = cv::saturate_cast<unsigned char>(255 * tiltcal::EncodeSrgb((electrons + read(random)) / sensor.full_well_electrons));
		}
	}
	return codes;
}

bool IsGrey(const std::string& file)
{
	const cv::Mat picture = cv::imread(file, cv::IMREAD_UNCHANGED);
	if (picture.empty())
		throw tiltcal::FileError(file + ": no picture that can be read");
	return picture.channels() == 1;
}

void WriteLike(const std::string& file, const cv::Mat& codes, const std::string& like)
{
	const tiltcal::PictureFile pattern = tiltcal::ReadPictureFile(like);
	if (pattern.format == tiltcal::PictureFormat::JPEG)
		WriteJpegLike(file, codes, pattern);
	else
		tiltcal::WritePng(file, codes);
}

}
