// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_STOPS_OF_PHOTOGRAPHS_H
#define TILTCAL_STOPS_OF_PHOTOGRAPHS_H

#include <tiltcal/log.h>
#include <tiltcal/task.h>

namespace tiltcal
{

/// Sets the task's stops, the widest first, and which of them each photograph has, from the f-numbers that were told; where some were not told from EXIF. None were told: from EXIF alone,
/// where it says one of every photograph. Where all f-numbers are one there are no stops. Logs what they are. Throws UsageError: of a photograph neither says it, where others were told.
void SetStops(Task& task, const Log& log);

/// Throws UsageError where a task of a program has stops that are none, or photographs of others than it has.
void CheckStops(const Task& task);

}

#endif
