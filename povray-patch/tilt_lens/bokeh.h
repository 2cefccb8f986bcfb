// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect of POV-Ray's own word `bokeh { pigment { ... } }`: the opening is a square as
// wide as the aperture, centred on the lens, and the pigment from <0, 0> to <1, 1> says how
// much light of each colour every point of it lets through; each colour's mean over the opening
// is divided out, so that exposure and colour stay where the picture is sharp. With `blades` the
// opening is theirs.

#ifndef TILT_LENS_BOKEH_H
#define TILT_LENS_BOKEH_H

#include <algorithm>
#include <cmath>
#include <vector>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/texture/pigment.h"
#include "lens/lens_spec.h"

namespace tilt_lens
{

/// What the pigment lets through at a point of the lens, which fills -1 to 1: red, green,
/// blue, none of it negative.
inline pov::Colour BokehAt(const pov::PIGMENT *pigment, const PupilPoint& point, pov::TraceThreadData *thread)
{
	pov::Colour c;
	const pov::VECTOR place = { 0.5 * point.x + 0.5, 0.5 * point.y + 0.5, 0.0 };
	pov::Compute_Pigment(c, pigment, place, NULL, NULL, thread);
	for(int i = 0; i < 3; i++)
		if(!(c[i] > 0.0f))
			c[i] = 0.0f;
	return c;
}

/// What each colour is multiplied by so that the mean over the opening of the lens is 1: of
/// 128 x 128 points placed as samples are. 0 for a colour that gets through nowhere. Returns whether colours
/// are parted by it: whether one gets through elsewhere than another.
inline bool MeasureBokehGain(const pov::PIGMENT *pigment, const TiltLens& lens, pov::TraceThreadData *thread, double *gain)
{
	const int n = 128;
	double sum[3] = { 0.0, 0.0, 0.0 };
	std::vector<pov::Colour> let;

	for(int i = 0; i < n * n; i++)
	{
		const double u = (i / n + 0.5) / n, v = (i % n + 0.5) / n;
		const PupilPoint square = { 2.0 * u - 1.0, 2.0 * v - 1.0 };
		const pov::Colour c = BokehAt(pigment, lens.square ? square : SquareToBlades(lens.blades, u, v), thread);
		for(int k = 0; k < 3; k++)
			sum[k] += c[k];
		let.push_back(c);
	}
	for(int k = 0; k < 3; k++)
		gain[k] = sum[k] > 0.0 ? n * n / sum[k] : 0.0;
	// Colours are kept as float.
	return std::any_of(let.begin(), let.end(), [&](const pov::Colour& c)
	{
		return std::fabs(c[0] * gain[0] - c[1] * gain[1]) > 1e-5 || std::fabs(c[1] * gain[1] - c[2] * gain[2]) > 1e-5;
	});
}

}

#endif
