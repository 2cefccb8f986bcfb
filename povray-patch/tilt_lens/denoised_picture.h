// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The picture that `denoise` needs whole, gathered from the threads' tiles in a first
// pass and given out denoised in a second.

#ifndef TILT_LENS_DENOISED_PICTURE_H
#define TILT_LENS_DENOISED_PICTURE_H

#include <atomic>
#include <cstddef>
#include <vector>

#include <boost/thread/condition_variable.hpp>
#include <boost/thread/mutex.hpp>

#include "lens/denoise.h"

namespace tilt_lens
{

struct SampleSums;

class DenoisedPicture
{
	public:
		DenoisedPicture();

		/// Begins a picture of width x height pixels, of which left..right, top..bottom
		/// (inclusive) are rendered. `errors`: each pixel's is asked for.
		void Begin(int width, int height, int left, int top, int right, int bottom, bool errors);

		/// Extends a tile at the edge of the rendered part by the pixels beyond that the
		/// denoised tile depends on, so that strips give the whole picture's pixels.
		void Extend(int& left, int& top, int& right, int& bottom) const;

		/// All pixels are there: the second pass.
		bool IsComplete() const { return missing == 0; }

		void Record(int x, int y, const SampleSums& sums);

		/// Denoises what rows top..bottom need, and what no thread has begun while others make that. Gives `lock`, which
		/// holds the mutex, up meanwhile. Only when complete.
		void Make(int top, int bottom, boost::mutex::scoped_lock& lock);

		/// A pixel denoised, as PictureChannels numbers, and its estimated standard error (linear, RMS of red, green and
		/// blue), 0 where it is not asked for. Only of rows that were made.
		double Denoised(int x, int y, float *channels);

		/// Whether that error says anything: one sample has no halves to be told by.
		bool KnowsError(int x, int y) const { return noisy.count[Index(x, y)] > 1.0f; }

		/// Denoised has been called: the second pass has begun. Needs no lock.
		bool IsShown() const { return shown; }

		/// Estimated RMS error of what was made, below 0 where nothing was.
		double RmsError() const;

		/// Held while any of the above is called.
		boost::mutex mutex;
	private:
		enum class Band : char { Waits, IsMade, IsDone };
		void MakeBand(size_t band, boost::mutex::scoped_lock& lock);
		size_t NextBand(size_t wanted) const;
		size_t Index(int x, int y) const { return size_t(y - extended.top) * noisy.width + (x - extended.left); }

		struct Rectangle { int left, top, right, bottom; };
		Rectangle part, extended;           // rendered; with what it depends on
		size_t firstBand, lastBand;         // that are wanted
		size_t missing;
		NoisyPicture noisy;
		std::vector<bool> recorded;         // pixels
		std::vector<Band> bands;
		boost::condition_variable changed;  // bands
		int making;                         // bands that are made now
		std::vector<float> denoised[PictureChannels];
		std::vector<float> squaredErrors;   // of pixels, or none
		std::vector<double> sums;           // of them in each band: added up in order, whichever thread came first
		std::atomic<bool> shown;
};

}

#endif
