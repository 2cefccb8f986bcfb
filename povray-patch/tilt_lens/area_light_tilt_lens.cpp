// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Area lights under tilt_lens: the methods that it adds to Trace.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/math/vector.h"
#include "backend/render/trace.h"
#include "lens/light_samples.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// In place of TraceAreaLightSubsetShadowRay: one point of the grid, drawn with the weight
/// that it has in the mean there. The axes are oriented already. Where it lies is upstream's formula.
void Trace::TraceTiltLensAreaLightShadowRay(const LightSource &lightsource, double& lightsourcedepth, Ray& lightsourceray,
                                            const Vector3d& ipoint, RGBColour& lightcolour, const Vector3d& axis1, const Vector3d& axis2, TraceTicket& ticket)
{
	// Those of light groups are counted by themselves.
	const tilt_lens::LightPoint point = tiltLensLights->Next(2 * lightsource.index + (lightsource.lightGroupLight ? 1 : 0));
	const tilt_lens::LightCell cell_u = tilt_lens::CellOfLight(point.u, lightsource.Area_Size1);
	const tilt_lens::LightCell cell_v = tilt_lens::CellOfLight(point.v, lightsource.Area_Size2);
	double u = cell_u.index, v = cell_v.index;

	if(lightsource.Jitter)
	{
		u += cell_u.place - 0.5;
		v += cell_v.place - 0.5;
	}
	if(lightsource.Circular == true)
	{
		u = u / (lightsource.Area_Size1 - 1) - 0.5 + 0.001;
		v = v / (lightsource.Area_Size2 - 1) - 0.5 + 0.001;
		const double scaleFactor = max(fabs(u), fabs(v)) / sqrt(u * u + v * v);
		u *= scaleFactor;
		v *= scaleFactor;
	}
	else
	{
		u = lightsource.Area_Size1 > 1 ? u / (lightsource.Area_Size1 - 1) - 0.5 : 0.0;
		v = lightsource.Area_Size2 > 1 ? v / (lightsource.Area_Size2 - 1) - 0.5 : 0.0;
	}

	ComputeOneWhiteLightRay(lightsource, lightsourcedepth, lightsourceray, ipoint, axis1 * u + axis2 * v);
	TracePointLightShadowRay(lightsource, lightsourcedepth, lightsourceray, lightcolour, ticket);
}

/// The object that shadowed a light last is asked first, and shadows from nearer than others
/// do: at the edge of a surface's own shadow, and between surfaces that nearly touch, a pixel would depend on what
/// its thread traced before.
void Trace::ForgetWhatShadowedLights()
{
	for(size_t i = 0; i < threadData->lightSources.size(); i++)
		lightSourceLevel1ShadowCache[i] = lightSourceOtherShadowCache[i] = NULL;
}

}
