// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_OLD_SET_H
#define TILTCAL_OLD_SET_H

#include <string>

namespace tiltcal
{

struct Calibration;
class FileSet;

/// A camera or an overlay of an earlier run beside this one's would be taken for this one's. Those of the states and photographs that the
/// folder's calibration.json lists go with `set`; what else looks like one is told by a warning.
void RemoveOldSet(const std::string& folder, const Calibration& c, FileSet& set);

}

#endif
