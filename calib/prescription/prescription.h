// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A lens as patents print it: spheres on one axis, the glass between them, the stop, the clear diameters.

#ifndef TILTCAL_PRESCRIPTION_H
#define TILTCAL_PRESCRIPTION_H

#include <string>
#include <vector>

namespace tiltcal
{

/// One surface, front to rear. Lengths mm.
struct Surface
{
	double curvature = 0;      ///< 1/radius, > 0: the centre lies towards the sensor; 0: flat
	double distance = 0;       ///< along the axis to the next surface
	double index = 1;          ///< of what is behind it, at the d line (587.6 nm)
	double abbe = 0;           ///< its Abbe number V_d; 0: not given, no dispersion
	double clear_radius = 0;   ///< half the clear diameter; 0: not given, nothing is cut off
};

struct Prescription
{
	std::string file;
	std::vector<Surface> surfaces;   ///< the stop is one of them: flat, the same index on both sides
	size_t stop = 0;

	double IndexBefore(size_t surface) const { return surface ? surfaces[surface - 1].index : 1; }
	/// Of the stop, as in trace.h.
	double StopHeight() const;
	double StopRadius() const { return surfaces[stop].clear_radius; }
	/// From the first vertex to the last.
	double Length() const;
	/// All lengths times `factor`.
	Prescription Scaled(double factor) const;
	/// For light of another wavelength: the indices at `nm`, by Cauchy's two terms through n_d and V_d.
	Prescription AtWavelength(double nm) const;
};

/// Reads a table; its format stands in calib/prescription/README.md. Throws Error (EXIT_FILE) that names file and line.
Prescription ReadPrescription(const std::string& file);

/// The same from a text; `file` is what messages call it.
Prescription ParsePrescription(const std::string& text, const std::string& file);

}

#endif
