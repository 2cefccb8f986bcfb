// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The numbers on the contours of `show focus`, which the threads of a render share: the first
// that needs them places them.

#ifndef TILT_LENS_SHOWN_LABELS_H
#define TILT_LENS_SHOWN_LABELS_H

#include <boost/thread/mutex.hpp>

#include "lens/focus_labels.h"

namespace tilt_lens
{

struct ShownLabels
{
	boost::mutex mutex;         ///< held while they are placed
	bool placed = false;
	FocusLabels labels;         ///< does not change once they are placed
};

}

#endif
