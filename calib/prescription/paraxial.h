// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a prescription does to rays near its axis. Heights as in trace.h: Z towards the scene, 0 at the first vertex.

#ifndef TILTCAL_PARAXIAL_H
#define TILTCAL_PARAXIAL_H

#include "prescription/prescription.h"

namespace tiltcal
{

/// A ray near the axis on its way to the sensor: height y above the axis, and by how much it rises on the way.
/// (y, u) behind is this matrix times (y, u) before.
template<typename T>
struct RayMatrix
{
	T a = T(1), b = T(0), c = T(0), d = T(1);

	RayMatrix Then(const RayMatrix& next) const
	{
		return { next.a * a + next.b * c, next.a * b + next.b * d, next.c * a + next.d * c, next.c * b + next.d * d };
	}
};

/// Through the surfaces [first, last), from the vertex of the first to that of the last one.
template<typename T>
RayMatrix<T> MatrixOf(const Prescription& lens, size_t first, size_t last)
{
	RayMatrix<T> all;
	for (size_t k = first; k < last; ++k)
	{
		const Surface& s = lens.surfaces[k];
		const T before(lens.IndexBefore(k)), behind(s.index);
		all = all.Then({ T(1), T(0), (before - behind) * T(s.curvature) / behind, before / behind });
		if (k + 1 < last)
			all = all.Then({ T(1), T(s.distance), T(0), T(1) });
	}
	return all;
}

/// mm; heights Z in the frame of the glass.
struct Paraxial
{
	double focal_length = 0;
	double back_focus = 0;             ///< from the last vertex to the image of infinity
	double front_principal = 0, rear_principal = 0;
	double entrance_pupil = 0, exit_pupil = 0;
	double entrance_radius = 0;        ///< of the entrance pupil
	double pupil_magnification = 0;    ///< exit over entrance pupil
	double last_vertex = 0;

	double FNumber() const { return focal_length / (2 * entrance_radius); }
	/// From the exit pupil to the image of what is `distance` before the entrance pupil (infinite: of infinity).
	double ImageDistance(double distance) const;
	/// Before the entrance pupil, of what is imaged `distance` behind the exit pupil.
	double ObjectDistance(double distance) const;
};

/// Throws Error (EXIT_REFUSED) where the lens has no focal length (afocal), or a pupil is at infinity.
Paraxial ParaxialOf(const Prescription& lens);

/// The same lens with another stop radius, so that its entrance pupil has the diameter f / f_number. Throws UsageError where the table's own
/// stop is smaller.
Prescription StoppedTo(const Prescription& lens, double f_number);

}

#endif
