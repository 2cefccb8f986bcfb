// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Ceres and OpenCV write on stderr what we say in errors of our own.

#ifndef TILTCAL_QUIET_H
#define TILTCAL_QUIET_H

namespace tiltcal
{

/// While one lives, glog (Ceres) and OpenCV are silent; then they log as before. Their switches are the process's: other threads
/// that use them are silent too.
class QuietLibraries
{
public:
	QuietLibraries();
	~QuietLibraries();
	QuietLibraries(const QuietLibraries&) = delete;
	QuietLibraries& operator=(const QuietLibraries&) = delete;

private:
	int glog_level, opencv_level;
};

}

#endif
