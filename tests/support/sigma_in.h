// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SIGMA_IN_H
#define TILTCAL_SIGMA_IN_H

#include <tiltcal/calibration.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace tiltcal
{

/// What edges scatter of a number: less than what is told of it. NaN: there is none of the name.
inline double SigmaIn(const NamedCovariance& c, const std::string& name)
{
	const size_t n = c.names.size(), k = size_t(std::find(c.names.begin(), c.names.end(), name) - c.names.begin());
	return k < n ? std::sqrt(c.matrix[k * (n + 1)]) : NAN;
}

}

#endif
