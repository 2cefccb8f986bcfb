// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Writes the error of the ray direction over kappa, ours and the paper's two cases,
// as a table for the plot in povray-patch/REFERENCE.md:
//   cmake --build --preset release --target reference-plots

#include <cmath>
#include <cstdio>

#include "lens/optics.h"
#include "paper_cases.h"

int main()
{
	using namespace tilt_lens;
	const Vec3<double> v = { 0.31, -0.27, 1.0 };
	const Vec3<double> S = { 0.21, 0.13, -0.04 };

	std::printf("# log10(kappa) ours paper\n");
	for(double e = 2.0; e > -323.0; e -= 0.5)
	{
		const double kappa = std::pow(10.0, e);
		// A quarter of an ulp stands for "exact", so that a logarithmic plot shows it.
		const double ours = std::fmax(DirectionError(Normalized(RayDirection(v, S, kappa)), v, S, kappa), 2.8e-17);
		const double paper = std::fmax(DirectionError(PaperRay(v, S, kappa), v, S, kappa), 2.8e-17);
		std::printf("%g %.3g %.3g\n", e, ours, paper);
	}
	return 0;
}
