// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WRITE_EXR_H
#define TILTCAL_WRITE_EXR_H

#include <opencv2/core.hpp>

#include <map>
#include <string>
#include <vector>

namespace tiltcal
{

/// Writes OpenEXR, 32 bit float, ZIP: `channels` by name, CV_32FC1 of one size each; `notes` become string
/// attributes of the header. To a name that does not matter yet (FileSet::Write): false where the disk is full. Throws FileError.
bool WriteExr(const std::string& temporary, const std::map<std::string, cv::Mat>& channels, const std::map<std::string, std::string>& notes);

}

#endif
