// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the preview window would show, in a PNG file (`+D Display_File=preview.png`): for machines without a screen. The front
// end draws into it as into a window; a thread of its own writes it from time to time, so that neither rendering nor drawing
// waits for the disk.

#ifndef TILT_LENS_DISPLAY_FILE_H
#define TILT_LENS_DISPLAY_FILE_H

#include <string>
#include <vector>

#include <boost/scoped_ptr.hpp>
#include <boost/thread.hpp>

#include "vfe.h"

namespace tilt_lens
{

class DisplayFile : public vfe::vfeDisplay
{
	public:
		/// Refuses, by an exception, a name that is no picture's, that is the output's, or that cannot be written.
		DisplayFile(unsigned int width, unsigned int height, pov_base::GammaCurvePtr gamma, vfe::vfeSession *session, const pov_base::UCS2String& name);
		/// Writes what was drawn last.
		~DisplayFile();

		void Initialise();
		void DrawPixel(unsigned int x, unsigned int y, const RGBA8& colour);
		void DrawFilledRectangle(unsigned int x1, unsigned int y1, unsigned int x2, unsigned int y2, const RGBA8& colour);
		void DrawPixelBlock(unsigned int x1, unsigned int y1, unsigned int x2, unsigned int y2, const RGBA8 *colour);

	private:
		void WriteNowAndThen();
		/// What is wrong, or nothing.
		std::string Write(const std::vector<RGBA8>& picture);

		std::string file, temporary;
		std::vector<RGBA8> pixels;      ///< alpha 0 where nothing was drawn yet
		bool drawn, ends;               ///< since the file was written; no more is drawn
		boost::mutex mutex;             ///< of the three above
		boost::condition_variable end;
		boost::scoped_ptr<boost::thread> writer;
};

}

#endif
