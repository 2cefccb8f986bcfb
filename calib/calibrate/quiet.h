// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Ceres and OpenCV write on stderr what we say in errors of our own.

#ifndef TILTCAL_QUIET_H
#define TILTCAL_QUIET_H

#include "base/while_any.h"

namespace tiltcal
{

/// Makes glog (Ceres) and OpenCV silent.
class LibrariesMuted
{
public:
	LibrariesMuted();
	~LibrariesMuted();

private:
	int glog_level, opencv_level;
};

/// While one lives, they are silent; then they log as before. Their switches are the process's: other threads that use them are silent too.
using QuietLibraries = WhileAny<LibrariesMuted>;

}

#endif
