// SPDX-License-Identifier: AGPL-3.0-or-later

#include <tiltcal/error.h>
#include "picture/image_io.h"
#include "support/in_temporary_folder.h"

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace
{

using namespace tiltcal;
namespace fs = std::filesystem;

class ImageIo : public InTemporaryFolder
{
protected:
	ExitCode Code(const std::string& file) const
	{
		try
		{
			ReadLinear(file, Transfer());
		}
		catch (const Error& e)
		{
			return e.Code();
		}
		return EXIT_DONE;
	}
};

cv::Mat Ramp(int type, double scale)
{
	cv::Mat image(40, 64, CV_64F);
	for (int y = 0; y < image.rows; ++y)
		for (int x = 0; x < image.cols; ++x)
			image.at<double>(y, x) = (x + 0.1 * y) / 70.0;
	cv::Mat out;
	image.convertTo(out, type, scale);
	return out;
}

TEST_F(ImageIo, SrgbCodesBecomeLinear)
{
	cv::Mat code(8, 8, CV_8UC1, cv::Scalar(188));
	cv::imwrite(At("a.png"), code);
	// IEC 61966-2-1: code 188 is 0.5029 of linear light.
	EXPECT_NEAR(ReadLinear(At("a.png"), ParseTransfer("srgb")).at<float>(3, 3), 0.5029, 1e-4);
	EXPECT_NEAR(ReadLinear(At("a.png"), ParseTransfer("linear")).at<float>(3, 3), 188 / 255.0, 1e-6);
	EXPECT_NEAR(ReadLinear(At("a.png"), ParseTransfer("2")).at<float>(3, 3), std::pow(188 / 255.0, 2), 1e-6);
}

TEST_F(ImageIo, SixteenBitsAndTiffAreRead)
{
	cv::imwrite(At("a.png"), Ramp(CV_16U, 65535));
	cv::imwrite(At("a.tif"), Ramp(CV_16U, 65535));
	cv::imwrite(At("f.tif"), Ramp(CV_32F, 1));
	const cv::Mat truth = Ramp(CV_32F, 1);
	// Half a code of 16 bits.
	EXPECT_LT(cv::norm(ReadLinear(At("a.png"), ParseTransfer("linear")), truth, cv::NORM_INF), 1e-5);
	EXPECT_LT(cv::norm(ReadLinear(At("a.tif"), ParseTransfer("linear")), truth, cv::NORM_INF), 1e-5);
	// Floating point is linear whatever the transfer curve.
	EXPECT_LT(cv::norm(ReadLinear(At("f.tif"), ParseTransfer("srgb")), truth, cv::NORM_INF), 1e-6);
}

/// A window that does not begin at 0, as cropped renders have it.
void WriteExr(const std::string& file, const cv::Mat& image, const std::vector<const char*>& names)
{
	const Imath::Box2i window(Imath::V2i(5, -3), Imath::V2i(5 + image.cols - 1, -3 + image.rows - 1));
	Imf::Header header(window, window);
	Imf::FrameBuffer buffer;
	const size_t channels = names.size();
	for (size_t c = 0; c < channels; ++c)
	{
		header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
		char* base = reinterpret_cast<char*>(const_cast<float*>(image.ptr<float>()) + c) - (-3 * long(image.step[0])) - 5 * long(image.elemSize());
		buffer.insert(names[c], Imf::Slice(Imf::FLOAT, base, image.elemSize(), image.step[0]));
	}
	Imf::OutputFile out(file.c_str(), header);
	out.setFrameBuffer(buffer);
	out.writePixels(image.rows);
}

TEST_F(ImageIo, ExrIsReadWhereverItsWindowBegins)
{
	const cv::Mat grey = Ramp(CV_32F, 3);
	WriteExr(At("y.exr"), grey, { "Y" });
	EXPECT_EQ(cv::norm(ReadLinear(At("y.exr"), Transfer()), grey, cv::NORM_INF), 0);
	cv::Mat colour(6, 7, CV_32FC3, cv::Scalar(0.25, 0.5, 0.75));
	WriteExr(At("rgb.exr"), colour, { "B", "G", "R" });
	EXPECT_EQ(cv::norm(ReadLinear(At("rgb.exr"), Transfer()), colour, cv::NORM_INF), 0);
	WriteExr(At("z.exr"), grey, { "Z" });
	EXPECT_EQ(Code(At("z.exr")), EXIT_FILE);
}

TEST_F(ImageIo, DamagedFilesAreRefused)
{
	cv::imwrite(At("whole.png"), Ramp(CV_8U, 255));
	cv::imwrite(At("whole.jpg"), Ramp(CV_8U, 255));
	cv::imwrite(At("whole.tif"), Ramp(CV_8U, 255));
	WriteExr(At("whole.exr"), Ramp(CV_32F, 1), { "Y" });
	for (const char* const suffix : { ".png", ".jpg", ".tif", ".exr" })
	{
		const std::string whole = At(std::string("whole") + suffix), cut = At(std::string("cut") + suffix);
		EXPECT_EQ(Code(whole), EXIT_DONE) << suffix;
		fs::copy_file(whole, cut);
		fs::resize_file(cut, fs::file_size(cut) * 2 / 3);
		EXPECT_EQ(Code(cut), EXIT_FILE) << suffix;
	}
	std::ofstream(At("empty.png")).flush();
	EXPECT_EQ(Code(At("empty.png")), EXIT_FILE);
	std::ofstream(At("text.png")) << "not a picture";
	EXPECT_EQ(Code(At("text.png")), EXIT_FILE);
	EXPECT_EQ(Code(At("missing.png")), EXIT_FILE);
	EXPECT_EQ(Code(folder.Path()), EXIT_FILE);
}

TEST(Transfer, RefusesNonsense)
{
	for (const char* const text : { "", "srgb2", "0", "-1", "nan", "2.2x" })
		EXPECT_THROW(ParseTransfer(text), Error) << text;
}

}
