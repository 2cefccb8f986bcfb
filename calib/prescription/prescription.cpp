// SPDX-License-Identifier: AGPL-3.0-or-later

#include "prescription/prescription.h"

namespace tiltcal
{

double Prescription::Length() const
{
	double length = 0;
	for (size_t k = 0; k + 1 < surfaces.size(); ++k)
		length += surfaces[k].distance;
	return length;
}

double Prescription::StopHeight() const
{
	double height = 0;
	for (size_t k = 0; k < stop; ++k)
		height -= surfaces[k].distance;
	return height;
}

Prescription Prescription::Scaled(double factor) const
{
	Prescription scaled = *this;
	for (Surface& s : scaled.surfaces)
	{
		s.curvature /= factor;
		s.distance *= factor;
		s.clear_radius *= factor;
	}
	return scaled;
}

Prescription Prescription::AtWavelength(double nm) const
{
	// n = A + B / l^2 with n(d) = n_d and n(F) - n(C) = (n_d - 1) / V_d.
	const double d = 587.5618, f = 486.1327, c = 656.2725;
	const double share = (1 / (nm * nm) - 1 / (d * d)) / (1 / (f * f) - 1 / (c * c));
	Prescription other = *this;
	for (Surface& s : other.surfaces)
		if (s.abbe > 0)
			s.index += share * (s.index - 1) / s.abbe;
	return other;
}

}
