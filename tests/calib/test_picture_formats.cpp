// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Every kind of picture that is read, what is refused, and EXIF.

#include <tiltcal/error.h>
#include "model/priors.h"
#include <tiltcal/photo.h>
#include "calibrate/exif_check.h"
#include "picture/image_io.h"
#include "measure/measure.h"
#include "picture/picture_file.h"
#include "support/in_temporary_folder.h"
#include "support/picture_seeds.h"

#include <exiv2/exiv2.hpp>
#include <gmock/gmock.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/stat.h>
#include <tiffio.h>
#include <unistd.h>

#include <array>
#include <functional>
#include <filesystem>
#include <fstream>

namespace
{

using namespace tiltcal;
namespace fs = std::filesystem;
using testing::HasSubstr;

class PictureFormats : public InTemporaryFolder
{
protected:
	void SetUp() override { seeds = PictureSeeds(folder.Path()); }
	std::string Bytes(const std::string& name) const
	{
		for (const PictureSeed& seed : seeds)
			if (seed.name == name)
				return seed.bytes;
		ADD_FAILURE() << name;
		return "";
	}

	/// What a FileError says of a file of these bytes; empty when it is read.
	std::string Refusal(const std::string& name, const std::string& bytes) const
	{
		std::ofstream(At(name), std::ios::binary) << bytes;
		return Refusal(name);
	}
	std::string Refusal(const std::string& name) const
	{
		try
		{
			ReadLinear(At(name), Transfer());
			return "";
		}
		catch (const Error& e)
		{
			EXPECT_EQ(e.Code(), EXIT_FILE);
			EXPECT_THAT(e.what(), HasSubstr(At(name)));
			EXPECT_THAT(e.what(), testing::Not(HasSubstr("\n")));
			return e.what();
		}
	}

	std::vector<PictureSeed> seeds;
};

/// `bytes` with the big-endian 32-bit number at `at` replaced.
std::string With32(std::string bytes, size_t at, uint32_t value)
{
	for (size_t i = 0; i < 4; ++i)
		bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
	return bytes;
}

TEST_F(PictureFormats, EveryKindGivesTheSamePictureUnturned)
{
	const cv::Mat truth = Checkerboard();
	for (const PictureSeed& seed : seeds)
	{
		const cv::Mat grey = Luminance(ReadLinear(At(seed.name), ParseTransfer("srgb")));
		ASSERT_EQ(grey.size(), truth.size()) << seed.name;
		EXPECT_LE(cv::norm(grey, truth, cv::NORM_INF), seed.tolerance) << seed.name;
	}
}

/// A TIFF of `side` x `side` pixels of red, green and blue, the same `row` of `bits` a sample all over; `fill` sets further tags.
void WriteTiff(const std::string& file, uint32_t side, int bits, void* row, const std::function<void(TIFF*)>& fill)
{
	TIFF* tiff = TIFFOpen(file.c_str(), "w");
	for (const uint32_t tag : { TIFFTAG_IMAGEWIDTH, TIFFTAG_IMAGELENGTH, TIFFTAG_ROWSPERSTRIP })
		TIFFSetField(tiff, tag, side);
	TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
	TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 3);
	TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
	TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
	fill(tiff);
	for (uint32_t y = 0; y < side; ++y)
		TIFFWriteScanline(tiff, row, y, 0);
	TIFFClose(tiff);
}

/// A pixel of red, green and blue in 64 bits each, which OpenCV does not write.
void WriteDoubles(const std::string& file, std::array<double, 3> colours)
{
	WriteTiff(file, 1, 64, colours.data(), [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP); });
}

/// 16 x 16 pixels of one colour.
void WriteBytes(const std::string& file, const std::function<void(TIFF*)>& fill)
{
	std::array<unsigned char, 48> row;
	row.fill(100);
	WriteTiff(file, 16, 8, row.data(), fill);
}

// Raw files of Nikon and Adobe are TIFFs whose first picture is a preview.
TEST_F(PictureFormats, PreviewsOfRawFilesAreRefused)
{
	WriteBytes(At("whole.tif"), [](TIFF*) {});
	EXPECT_EQ(Refusal("whole.tif"), "");
	WriteBytes(At("raw.nef"), [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_SUBFILETYPE, FILETYPE_REDUCEDIMAGE); });
	EXPECT_THAT(Refusal("raw.nef"), HasSubstr("raw file"));
	WriteBytes(At("raw.dng"), [](TIFF* tiff) { TIFFSetField(tiff, TIFFTAG_DNGVERSION, "\1\4\0\0"); });
	EXPECT_THAT(Refusal("raw.dng"), HasSubstr("develop it"));
}

TEST_F(PictureFormats, HowLightAndColourAreStoredIsTold)
{
	const auto jpeg = [&](const char* name, uint16_t step)
	{
		WriteBytes(At(name), [&](TIFF* tiff)
		{
			TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_JPEG);
			TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_YCBCR);
			TIFFSetField(tiff, TIFFTAG_YCBCRSUBSAMPLING, step, step);
			TIFFSetField(tiff, TIFFTAG_JPEGCOLORMODE, JPEGCOLORMODE_RGB);
		});
		PhotographFacts facts;
		ReadLinear(At(name), Transfer(), &facts);
		EXPECT_FALSE(facts.floating_point) << name;
		return facts.subsampled_colour;
	};
	EXPECT_TRUE(jpeg("half.tif", 2));
	EXPECT_FALSE(jpeg("full.tif", 1));
	PhotographFacts facts;
	cv::imwrite(At("float.tif"), Checkerboard());
	ReadLinear(At("float.tif"), Transfer(), &facts);
	EXPECT_TRUE(facts.floating_point);
	EXPECT_FALSE(facts.subsampled_colour);
}

TEST_F(PictureFormats, ColoursKeepTheirOrder)
{
	const cv::Mat blue_first(16, 16, CV_8UC3, cv::Scalar(10, 120, 250));
	for (const char* const name : { "c.png", "c.tif", "c.jpg" })
	{
		cv::imwrite(At(name), blue_first);
		const cv::Vec3f c = ReadLinear(At(name), ParseTransfer("linear")).at<cv::Vec3f>(8, 8);
		// JPEG's colours are rounded twice.
		for (int k = 0; k < 3; ++k)
			EXPECT_NEAR(c[k], blue_first.at<cv::Vec3b>(8, 8)[k] / 255.0, 0.02) << name << k;
	}
	WriteDoubles(At("double.tif"), { 0.9, 0.5, 0.1 });
	const cv::Vec3f c = ReadLinear(At("double.tif"), ParseTransfer("linear")).at<cv::Vec3f>(0, 0);
	for (int k = 0; k < 3; ++k)
		EXPECT_FLOAT_EQ(c[k], 0.1f + 0.4f * float(k)) << k;
}

TEST_F(PictureFormats, SizesAreRefusedBeforePixelsAreRead)
{
	// IHDR: width at byte 16, height at 20; the checksum is then wrong, which libpng would say in other words.
	const std::string png = Bytes("grey8.png");
	EXPECT_THAT(Refusal("zero.png", With32(png, 16, 0)), HasSubstr("damaged PNG"));
	cv::imwrite(At("wide.png"), cv::Mat::zeros(2, 70000, CV_8U));
	EXPECT_THAT(Refusal("wide.png"), HasSubstr("70000 x 2"));
	// Start of frame (ff c0): height at 5, width at 7.
	std::string jpeg = Bytes("grey.jpg");
	const size_t frame = jpeg.find("\xff\xc0");
	ASSERT_NE(frame, std::string::npos);
	jpeg = With32(jpeg, frame + 5, 30000u << 16 | 30000u);
	EXPECT_THAT(Refusal("bomb.jpg", jpeg), HasSubstr("30000 x 30000"));
	EXPECT_THAT(Refusal("zero.jpg", With32(jpeg, frame + 5, 0)), HasSubstr("damaged JPEG"));
}

TEST_F(PictureFormats, WhatIsCutIsRefused)
{
	for (const PictureSeed& seed : seeds)
		for (const double share : { 0.02, 0.5, 0.9, 0.98 })
		{
			// Of two parts the picture is the first and may be whole.
			if (seed.name == "two-parts.exr" && share > 0.5)
				continue;
			EXPECT_NE(Refusal("cut-" + seed.name, seed.bytes.substr(0, size_t(share * double(seed.bytes.size())))), "") << seed.name << " " << share;
		}
}

/// The thumbnail in EXIF has an end of its own, which must not be taken for the picture's.
TEST_F(PictureFormats, CutJpegIsRefusedInSpiteOfItsThumbnail)
{
	const std::string thumbnail = Bytes("grey.jpg"), cut = thumbnail.substr(0, thumbnail.size() * 2 / 3);
	const size_t length = thumbnail.size() + 2;
	const std::string application = std::string("\xff\xe5") + char(length >> 8) + char(length & 255) + thumbnail;
	EXPECT_THAT(Refusal("cut.jpg", cut.substr(0, 2) + application + cut.substr(2)), HasSubstr("damaged JPEG"));
	EXPECT_EQ(Refusal("whole.jpg", thumbnail.substr(0, 2) + application + thumbnail.substr(2)), "");
}

TEST_F(PictureFormats, WhatIsNoFileIsRefusedAtOnce)
{
	ASSERT_EQ(mkfifo(At("pipe.png").c_str(), 0600), 0);
	EXPECT_THAT(Refusal("pipe.png"), HasSubstr("pipe"));
	fs::create_directory(At("folder.png"));
	EXPECT_THAT(Refusal("folder.png"), HasSubstr("folder"));
	EXPECT_THAT(Refusal("gone.png"), HasSubstr("no such file"));
	EXPECT_THAT(Refusal("empty.png", ""), HasSubstr("empty"));
	EXPECT_THAT(Refusal("text.png", "hello"), HasSubstr("not a picture"));
	fs::create_symlink(At("loop.png"), At("loop.png"));
	EXPECT_THAT(Refusal("loop.png"), HasSubstr("cannot be read"));
	// Told by the content, not by the suffix.
	EXPECT_EQ(Refusal("png.jpg", Bytes("grey8.png")), "");
}

// Root reads everything: as root, nobody tries.
TEST_F(PictureFormats, WhatMayNotBeReadIsRefused)
{
	for (const char* const name : { "open.png", "secret.png" })
		EXPECT_EQ(Refusal(name, Bytes("grey8.png")), "");
	// Nobody keeps root's group.
	fs::permissions(folder.Path(), fs::perms::group_exec | fs::perms::others_exec, fs::perm_options::add);
	fs::permissions(At("open.png"), fs::perms::group_read | fs::perms::others_read, fs::perm_options::add);
	fs::permissions(At("secret.png"), fs::perms::none);
	const bool root = geteuid() == 0;
	const uid_t nobody = 65534;
	ASSERT_EQ(root ? seteuid(nobody) : 0, 0);
	const std::string open = Refusal("open.png"), secret = Refusal("secret.png");
	ASSERT_EQ(root ? seteuid(0) : 0, 0);
	EXPECT_EQ(open, "") << "the file's permission, not the folder's";
	EXPECT_THAT(secret, HasSubstr("ermission"));
}

TEST_F(PictureFormats, WhatIsNoLightIsRefused)
{
	const auto with = [&](const char* name, float value)
	{
		cv::Mat image = Checkerboard();
		image.at<float>(3, 3) = value;
		cv::imwrite(At(name), image);
		return Refusal(name);
	};
	EXPECT_THAT(with("nan.tif", std::numeric_limits<float>::quiet_NaN()), HasSubstr("not numbers"));
	EXPECT_THAT(with("inf.tif", std::numeric_limits<float>::infinity()), HasSubstr("not numbers"));
	EXPECT_THAT(with("negative.tif", -0.5f), HasSubstr("no light"));
	EXPECT_THAT(with("huge.tif", 1e30f), HasSubstr("1 is white"));
	// Noise about black is light.
	EXPECT_EQ(with("noise.tif", -0.01f), "");
}

TEST_F(PictureFormats, ExifIsReadFromEveryKindThatHasIt)
{
	for (const char* const name : { "exif.jpg", "exif.png", "exif.tif" })
	{
		PhotographFacts facts;
		ReadLinear(At(name), Transfer(), &facts);
		EXPECT_EQ(facts.focal_length_mm, 45.0) << name;
		EXPECT_EQ(facts.f_number, 2.8) << name;
		EXPECT_EQ(facts.orientation, 6) << name;
		EXPECT_EQ(facts.make, "Canon") << name;
		EXPECT_EQ(facts.lens, "TS-E45mm f/2.8") << name;
		// 3810.584 pixels an inch.
		ASSERT_TRUE(facts.pitch_mm) << name;
		EXPECT_NEAR(*facts.pitch_mm, 25.4 / 3810.584, 1e-9) << name;
		EXPECT_EQ(Describe(facts), "Canon EOS 6D, TS-E45mm f/2.8, 45 mm, f/2.8, pitch 0.006666 mm");
	}
	PhotographFacts none;
	ReadLinear(At("grey.jpg"), Transfer(), &none);
	EXPECT_TRUE(none.Empty());
	// A picture scaled since has another pitch.
	EXPECT_FALSE(ReadFacts(ReadPictureFile(At("exif.jpg")), 90).pitch_mm);
	// So has one whose EXIF a tool kept when it scaled.
	EXPECT_TRUE(ReadFacts(At("exif.jpg")).pitch_mm);
	cv::imwrite(At("half.jpg"), cv::Mat::zeros(10, 10, CV_8U));
	const auto from = Exiv2::ImageFactory::open(At("exif.jpg")), to = Exiv2::ImageFactory::open(At("half.jpg"));
	from->readMetadata();
	to->setExifData(from->exifData());
	to->writeMetadata();
	EXPECT_EQ(ReadFacts(At("half.jpg")).focal_length_mm, 45.0);
	EXPECT_FALSE(ReadFacts(At("half.jpg")).pitch_mm);
}

// Some cameras write the resolution of another sensor: a full frame of 6240 x 4160 px at 6673.8 an inch would be 23.7 mm wide.
TEST_F(PictureFormats, APitchThatTheFocalLengthsContradictIsNone)
{
	const auto pitch = [&](uint32_t resolution, uint16_t f35)
	{
		const auto image = Exiv2::ImageFactory::open(At("exif.jpg"));
		image->readMetadata();
		Exiv2::ExifData& exif = image->exifData();
		exif["Exif.Photo.PixelXDimension"] = uint32_t(6240);
		exif["Exif.Photo.PixelYDimension"] = uint32_t(4160);
		for (const char* const key : { "Exif.Photo.FocalPlaneXResolution", "Exif.Photo.FocalPlaneYResolution" })
			exif[key] = Exiv2::URational(resolution, 10);
		exif["Exif.Photo.FocalLengthIn35mmFilm"] = f35;
		image->writeMetadata();
		return ReadFacts(ReadPictureFile(At("exif.jpg")), 6240).pitch_mm.value_or(0);
	};
	EXPECT_EQ(pitch(66738, 45), 0);
	EXPECT_NEAR(pitch(66738, 69), 25.4 / 6673.8, 1e-9);
	// 35.9 mm; rounded up, and by the width of a sensor of 4:3.
	for (const uint16_t f35 : { 45, 46, 47 })
		EXPECT_NEAR(pitch(44150, f35), 25.4 / 4415, 1e-9) << f35;
}

TEST(Exif, APitchOfItsOwnIsSaid)
{
	Calibration c;
	c.task.states.push_back({ "untilted", false, { Photo() } });
	c.task.pitch_mm = 0.0038;
	c.task.width = 6240;
	c.task.height = 4160;
	EXPECT_THAT(CompareWithExif(c), testing::IsEmpty());
	c.task.pitch_from_exif = true;
	EXPECT_THAT(CompareWithExif(c), testing::ElementsAre(testing::AllOf(HasSubstr("sensor of 23.7 x 15.8 mm"), HasSubstr("give `pitch`"))));
}

TEST(Exif, BecomesWeakPriorsWhereNothingWasGiven)
{
	Task task;
	Photo photo;
	photo.facts.focal_length_mm = 45;
	photo.facts.f_number = 2.8;
	task.states.push_back({ "untilted", false, { photo, photo } });
	const std::vector<Prior> both = PriorsFromExif(task, {});
	ASSERT_EQ(both.size(), 2u);
	EXPECT_EQ(both[0].quantity, Quantity::FOCAL_LENGTH);
	EXPECT_DOUBLE_EQ(both[0].sigma, 4.5);
	const std::vector<Prior> one = PriorsFromExif(task, { ParseFix("focal_length=44.8") });
	ASSERT_EQ(one.size(), 1u);
	EXPECT_EQ(one[0].quantity, Quantity::F_NUMBER);
}

TEST(Exif, CommonFactsAreThoseThatAgree)
{
	PhotographFacts a, b;
	a.focal_length_mm = b.focal_length_mm = 45;
	a.f_number = 2.8;
	b.f_number = 4;
	a.pitch_mm = 0.0066;
	a.make = "Canon";
	const PhotographFacts common = CommonFacts(std::vector<PhotographFacts>{ a, b });
	EXPECT_EQ(common.focal_length_mm, 45.0);
	EXPECT_FALSE(common.f_number);
	EXPECT_FALSE(common.pitch_mm);
	EXPECT_EQ(common.make, "Canon");
}

TEST(Exif, SpeaksWhenTheAnswerIsFarFromIt)
{
	Calibration c;
	Photo photo;
	photo.facts.focal_length_mm = 45;
	photo.facts.f_number = 2.8;
	c.task.states.push_back({ "untilted", false, { photo } });
	c.solution.focal_length = { 45.8, 0.1 };
	c.solution.aperture_diameter = { 45.8 / 2.9, 0.05 };
	c.solution.w_mm = { 49.4, 0.1 };
	EXPECT_THAT(CompareWithExif(c), testing::IsEmpty());
	// From 6 % of the focal length and, in its logarithm, 0.2 of the f-number on, and what three sigma explain.
	c.solution.focal_length = { 45 * 1.055, 0.01 };
	c.solution.aperture_diameter = { 45 * 1.055 / (2.8 * 1.19), 0.01 };
	EXPECT_THAT(CompareWithExif(c), testing::IsEmpty());
	c.solution.focal_length = { 45 * 1.065, 0.3 };
	EXPECT_THAT(CompareWithExif(c), testing::IsEmpty());
	c.solution.focal_length = { 45 * 1.065, 0.01 };
	c.solution.aperture_diameter = { 45 * 1.065 / (2.8 * 1.25), 0.01 };
	EXPECT_THAT(CompareWithExif(c), testing::ElementsAre(HasSubstr("focal length"), HasSubstr("f-number")));
	c.solution.aperture_diameter = { 45.8 / 2.9, 0.05 };
	c.solution.focal_length = { 50.8, 0.1 };
	EXPECT_THAT(CompareWithExif(c), testing::ElementsAre(testing::AllOf(HasSubstr("50.80"), HasSubstr("45 mm"), HasSubstr("w 49.40"))));
	c.solution.aperture_diameter = { 8, 0.05 };
	EXPECT_THAT(CompareWithExif(c), testing::ElementsAre(HasSubstr("focal length"), HasSubstr("f-number f/d 6.35")));
}

}
