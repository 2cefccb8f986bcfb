// SPDX-License-Identifier: AGPL-3.0-or-later

#include "picture/exif.h"

#include "picture/picture_file.h"

#include <exiv2/exiv2.hpp>
#include <fmt/format.h>

#include <cmath>
#include <mutex>

namespace tiltcal
{

namespace
{

/// A finite number above 0 and at most `most`, or nothing.
std::optional<double> Positive(const Exiv2::ExifData& exif, const char* key, double most)
{
	const auto found = exif.findKey(Exiv2::ExifKey(key));
	if (found == exif.end() || found->count() < 1)
		return {};
	const Exiv2::Rational r = found->toRational();
	if (r.second == 0)
		return {};
	const double value = double(r.first) / double(r.second);
	return value > 0 && value <= most ? std::optional(value) : std::nullopt;
}

/// Printable ASCII only: it goes to terminals and into JSON.
std::string Text(const Exiv2::ExifData& exif, const char* key)
{
	const auto found = exif.findKey(Exiv2::ExifKey(key));
	std::string text;
	if (found != exif.end() && found->typeId() == Exiv2::asciiString)
		for (const char c : found->toString().substr(0, 100))
			if (c >= ' ' && c <= '~')
				text += c;
	while (!text.empty() && text.back() == ' ')
		text.pop_back();
	return text;
}

/// Millimetres of FocalPlaneResolutionUnit: inch (the default), cm; mm and um are some makers' own.
double FocalPlaneUnit(const Exiv2::ExifData& exif)
{
	const double unit = Positive(exif, "Exif.Photo.FocalPlaneResolutionUnit", 5).value_or(2);
	return unit == 3 ? 10 : unit == 4 ? 1 : unit == 5 ? 0.001 : 25.4;
}

/// Some cameras write the resolution of another picture or sensor. FocalLengthIn35mmFilm is by the diagonal, 43.27 mm (CIPA DCG-001), by some
/// makers by the width, which is 4 % more or less; both focal lengths are rounded, to whole millimetres where they are short.
bool Contradicted(const Exiv2::ExifData& exif, double pitch, double width)
{
	const auto f = Positive(exif, "Exif.Photo.FocalLength", 1e5), f35 = Positive(exif, "Exif.Photo.FocalLengthIn35mmFilm", 1e5), height = Positive(exif, "Exif.Photo.PixelYDimension", 1e6);
	if (!f || !f35 || !height)
		return false;
	const double by_pitch = 43.27 / (std::hypot(width, *height) * pitch), by_lengths = *f35 / *f;
	return std::abs(std::log(by_pitch / by_lengths)) > 0.1 + 0.5 / *f + 0.5 / *f35;
}

std::optional<double> Pitch(const Exiv2::ExifData& exif, int width)
{
	const auto x = Positive(exif, "Exif.Photo.FocalPlaneXResolution", 1e9), y = Positive(exif, "Exif.Photo.FocalPlaneYResolution", 1e9);
	const auto exif_width = Positive(exif, "Exif.Photo.PixelXDimension", 1e6);
	// Within one per cent: makers round the two to different sizes of the sensor.
	if (!x || !y || std::abs(*x / *y - 1) > 0.01 || !exif_width || (width > 0 && std::lround(*exif_width) != width))
		return {};
	const double pitch = FocalPlaneUnit(exif) / *x;
	return pitch > 1e-4 && pitch < 1 && !Contradicted(exif, pitch, *exif_width) ? std::optional(pitch) : std::nullopt;
}

PhotographFacts FromExif(const Exiv2::ExifData& exif, int width)
{
	PhotographFacts facts;
	facts.focal_length_mm = Positive(exif, "Exif.Photo.FocalLength", 1e5);
	facts.f_number = Positive(exif, "Exif.Photo.FNumber", 1000);
	// APEX: A = 2 log2 N.
	if (const auto apex = Positive(exif, "Exif.Photo.ApertureValue", 20); !facts.f_number && apex)
		facts.f_number = std::exp2(*apex / 2);
	facts.pitch_mm = Pitch(exif, width);
	const double orientation = Positive(exif, "Exif.Image.Orientation", 8).value_or(1);
	facts.orientation = orientation == std::floor(orientation) ? int(orientation) : 1;
	facts.make = Text(exif, "Exif.Image.Make");
	facts.model = Text(exif, "Exif.Image.Model");
	facts.lens = Text(exif, "Exif.Photo.LensModel");
	return facts;
}

}

bool PhotographFacts::Empty() const
{
	return !focal_length_mm && !f_number && !pitch_mm && orientation == 1 && make.empty() && model.empty() && lens.empty();
}

PhotographFacts ReadFacts(const PictureFile& picture, int width)
{
	if (picture.format == PictureFormat::EXR)
		return {};
	// Exiv2's XMP toolkit is one for the process.
	static std::mutex one_at_a_time;
	const std::lock_guard<std::mutex> lock(one_at_a_time);
	struct Muted
	{
		Exiv2::LogMsg::Level before = Exiv2::LogMsg::level();
		Muted() { Exiv2::LogMsg::setLevel(Exiv2::LogMsg::mute); }
		~Muted() { Exiv2::LogMsg::setLevel(before); }
	} const muted;
	try
	{
		const auto image = Exiv2::ImageFactory::open(reinterpret_cast<const Exiv2::byte*>(picture.bytes.data()), static_cast<long>(picture.bytes.size()));
		image->readMetadata();
		return FromExif(image->exifData(), width > 0 ? width : int(image->pixelWidth()));
	}
	catch (const std::exception&)
	{
		// Pixels do not depend on it: the decoder judges the file.
		return {};
	}
}

PhotographFacts ReadFacts(const std::string& file)
{
	return ReadFacts(ReadPictureFile(file), 0);
}

std::string Describe(const PhotographFacts& facts)
{
	std::string text;
	const auto add = [&](const std::string& part) { text += (text.empty() || part.empty() ? "" : ", ") + part; };
	// Most makers repeat their name in the model's.
	add(facts.model.rfind(facts.make, 0) == 0 || facts.model.empty() ? facts.model : facts.make + " " + facts.model);
	add(facts.lens);
	if (facts.focal_length_mm)
		add(fmt::format("{:g} mm", *facts.focal_length_mm));
	if (facts.f_number)
		add(fmt::format("f/{:.3g}", *facts.f_number));
	if (facts.pitch_mm)
		add(fmt::format("pitch {:.6f} mm", *facts.pitch_mm));
	return text;
}

}
