// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_JET_VALUE_H
#define TILTCAL_JET_VALUE_H

#include <ceres/jet.h>

namespace tiltcal
{

/// A number without its derivatives.
inline double ValueOf(double x) { return x; }

template<int N>
inline double ValueOf(const ceres::Jet<double, N>& x) { return x.a; }

}

#endif
