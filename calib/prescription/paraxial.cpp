// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/paraxial.h"

#include <fmt/format.h>
#include <tiltcal/error.h>

#include <cmath>

namespace tiltcal
{

double Paraxial::ImageDistance(double distance) const
{
	// From b' = b / m + S / f, the linear part of lens/aberrations.h, for b = -S / distance.
	return pupil_magnification / (1 / focal_length - 1 / (pupil_magnification * distance));
}

double Paraxial::ObjectDistance(double distance) const
{
	return 1 / (pupil_magnification * (1 / focal_length - pupil_magnification / distance));
}

Paraxial ParaxialOf(const Prescription& lens)
{
	using Number = long double;
	const size_t n = lens.surfaces.size();
	const RayMatrix<Number> all = MatrixOf<Number>(lens, 0, n);
	const double length = lens.Length();
	if (!(std::abs(all.c) * static_cast<Number>(length + 1) > 1e-9L))
		throw Refused(fmt::format("{}: has no focal length: parallel light leaves it parallel", lens.file));
	Paraxial p;
	p.last_vertex = -length;
	p.focal_length = static_cast<double>(-1 / all.c);
	p.back_focus = static_cast<double>(-all.a / all.c);
	p.rear_principal = static_cast<double>(-static_cast<Number>(length) - (1 - all.a) / all.c);
	p.front_principal = static_cast<double>((1 - all.d) / all.c);

	// The stop as seen from the front: rays from its centre backwards through [0, stop); from behind: through (stop, n). The
	// distance from the last surface before the stop to the stop belongs to the first part.
	RayMatrix<Number> front, rear;
	if (lens.stop > 0)
		front = MatrixOf<Number>(lens, 0, lens.stop).Then({ 1, static_cast<Number>(lens.surfaces[lens.stop - 1].distance), 0, 1 });
	if (lens.stop + 1 < n)
		rear = RayMatrix<Number>{ 1, static_cast<Number>(lens.surfaces[lens.stop].distance), 0, 1 }.Then(MatrixOf<Number>(lens, lens.stop + 1, n));
	if (!(std::abs(front.a) > 1e-9L) || !(std::abs(rear.d) > 1e-9L))
		throw Refused(fmt::format("{}: a pupil of it is at infinity (telecentric), which the camera does not know", lens.file));
	// y at the stop = a y + b u: 0 for a ray aimed at b / a behind the first vertex.
	p.entrance_pupil = static_cast<double>(-front.b / front.a);
	p.entrance_radius = std::abs(static_cast<double>(lens.StopRadius() / front.a));
	// A ray from the stop's centre comes out at (b u, d u): it crosses the axis b / d before the last vertex.
	p.exit_pupil = static_cast<double>(-static_cast<Number>(length) + rear.b / rear.d);
	// A point y of the stop is seen at y (a - b c / d) = y (index at the stop) / d from behind, at y / a from the front.
	const Number at_stop = lens.surfaces[lens.stop].index;
	p.pupil_magnification = static_cast<double>(at_stop / rear.d * front.a);
	return p;
}

Prescription StoppedTo(const Prescription& lens, double f_number)
{
	const Paraxial p = ParaxialOf(lens);
	const double factor = std::abs(p.focal_length) / f_number / 2 / p.entrance_radius;
	if (factor > 1 + 1e-9)
		throw UsageError(fmt::format("f/{:g} is wider than the stop of `{}` opens: f/{:.4g}", f_number, lens.file, std::abs(p.FNumber())));
	Prescription stopped = lens;
	stopped.surfaces[lens.stop].clear_radius *= factor;
	return stopped;
}

}
