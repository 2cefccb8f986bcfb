// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <png.h>
#include <unistd.h>

#include <boost/algorithm/string/predicate.hpp>

#include "backend/tilt_lens/display_file.h"

// this must be the last file included
#include "base/povdebug.h"

namespace tilt_lens
{

using pov_base::GammaCurvePtr;
using pov_base::Path;
using pov_base::UCS2String;
using pov_base::UCS2toASCIIString;

// Seconds between two files, at least; a large picture, which takes long to pack, is written less often.
static const double Pause = 1.0, PausePerWriting = 10.0;

static bool SameFile(const std::string& a, const std::string& b)
{
	std::error_code failed;
	return std::filesystem::weakly_canonical(std::filesystem::absolute(a, failed), failed) ==
	       std::filesystem::weakly_canonical(std::filesystem::absolute(b, failed), failed);
}

DisplayFile::DisplayFile(unsigned int width, unsigned int height, GammaCurvePtr gamma, vfe::vfeSession *session, const UCS2String& name) :
	vfeDisplay(width, height, gamma, session, false),
	file(UCS2toASCIIString(name)),
	temporary(file + "." + std::to_string(getpid()) + ".new"),
	pixels(size_t(width) * height, RGBA8()),
	drawn(false), ends(false)
{
	const std::string named = "Display_File=" + file + ": ";

	if(!boost::iends_with(file, ".png"))
		throw POV_EXCEPTION_STRING((named + "it is written as PNG, so its name must end in .png.").c_str());
	if(session->GetBoolOption("Output_To_File", true) && SameFile(file, UCS2toASCIIString(session->GetOutputFilename())))
		throw POV_EXCEPTION_STRING((named + "this is the output's name; give it another one.").c_str());
	if(!session->TestAccessAllowed(Path(name), true))
		throw POV_EXCEPTION_STRING((named + "the I/O restrictions of povray.conf do not let it be written there.").c_str());
}

DisplayFile::~DisplayFile()
{
	if(!writer)
		return;
	{
		boost::mutex::scoped_lock lock(mutex);
		ends = true;
	}
	end.notify_one();
	writer->join();
}

void DisplayFile::Initialise()
{
	// At once: a viewer has a file to open, and one that cannot be written is known before the render.
	const std::string wrong = Write(pixels);
	if(!wrong.empty())
		throw POV_EXCEPTION_STRING(("Display_File=" + file + ": it cannot be written: " + wrong + ".").c_str());
	writer.reset(new boost::thread(&DisplayFile::WriteNowAndThen, this));
}

void DisplayFile::DrawPixel(unsigned int x, unsigned int y, const RGBA8& colour)
{
	DrawFilledRectangle(x, y, x, y, colour);
}

void DisplayFile::DrawFilledRectangle(unsigned int x1, unsigned int y1, unsigned int x2, unsigned int y2, const RGBA8& colour)
{
	boost::mutex::scoped_lock lock(mutex);

	for(unsigned int y = y1; y <= std::min(y2, GetHeight() - 1); y++)
		for(unsigned int x = x1; x <= std::min(x2, GetWidth() - 1); x++)
			pixels[size_t(y) * GetWidth() + x] = colour;
	drawn = true;
}

void DisplayFile::DrawPixelBlock(unsigned int x1, unsigned int y1, unsigned int x2, unsigned int y2, const RGBA8 *colour)
{
	boost::mutex::scoped_lock lock(mutex);

	for(unsigned int y = y1; y <= y2; y++)
		for(unsigned int x = x1; x <= x2; x++, colour++)
			if((x < GetWidth()) && (y < GetHeight()))
				pixels[size_t(y) * GetWidth() + x] = *colour;
	drawn = true;
}

void DisplayFile::WriteNowAndThen()
{
	double pause = Pause;
	bool said = false, last = false;

	while(!last)
	{
		std::vector<RGBA8> picture;
		{
			boost::mutex::scoped_lock lock(mutex);
			const boost::system_time until = boost::get_system_time() + boost::posix_time::milliseconds(long(1000 * pause));

			while(!ends && end.timed_wait(lock, until))
				;
			last = ends;
			if(!drawn)
				continue;
			drawn = false;
			picture = pixels;
		}
		const boost::system_time begin = boost::get_system_time();
		const std::string wrong = Write(picture);
		// The render goes on: a full disk may have room later.
		if(!wrong.empty() && !said)
			fprintf(stderr, "Display_File=%s: it cannot be written now: %s.\n", file.c_str(), wrong.c_str());
		said = !wrong.empty();
		pause = std::max(Pause, PausePerWriting * (boost::get_system_time() - begin).total_milliseconds() / 1000.0);
	}
}

std::string DisplayFile::Write(const std::vector<RGBA8>& picture)
{
	// By way of a rename: whoever reads it finds a whole picture.
	png_image image = png_image();

	image.version = PNG_IMAGE_VERSION;
	image.width = GetWidth();
	image.height = GetHeight();
	image.format = PNG_FORMAT_RGBA;
	image.flags = PNG_IMAGE_FLAG_FAST;
	if(!png_image_write_to_file(&image, temporary.c_str(), 0, &picture[0], 0, NULL))
		return image.message;

	std::error_code failed;
	std::filesystem::rename(temporary, file, failed);
	if(!failed)
		return std::string();
	remove(temporary.c_str());
	return failed.message();
}

}
