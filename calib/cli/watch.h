// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_WATCH_H
#define TILTCAL_WATCH_H

#include "cli/calibrate_run.h"

namespace tiltcal
{

/// tiltcal calibrate --watch: measures what arrives, calibrates anew, writes everything again, until Ctrl-C. Throws Refused where there is no
/// calibration then.
void Watch(const CalibrateRun& run);

}

#endif
