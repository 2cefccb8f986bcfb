// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the shared library shows; all else is hidden.

#ifndef TILTCAL_API_H
#define TILTCAL_API_H

#if defined(__GNUC__)
#define TILTCAL_API __attribute__((visibility("default")))
#else
#define TILTCAL_API
#endif

#endif
