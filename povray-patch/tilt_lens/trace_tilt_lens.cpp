// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tracing through a tilted lens: the methods that tilt_lens adds to TracePixel.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/chi2.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/tilt_lens/optics.h"
#include "backend/tilt_lens/pupil.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Vec3d;

// The variance of fewer samples than this says too little to stop on.
static const int First_Level = 16;

/// Turns the pinhole ray of a pixel, which stands in `ray`, into the ray that
/// leaves the current lens sample (DESIGN.md, section 2). False where the pixel
/// looks along or behind the lens plane (v.n <= 0): there is no such ray.
///
/// The pinhole direction is w v, not v; so is the result, since R is linear in v.
bool TracePixel::SendRayThroughTiltLens(Ray& ray)
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;
	const Vec3d v = { ray.Direction[X], ray.Direction[Y], ray.Direction[Z] };

	if(!(Dot(v, lens.normal) > 0.0))
		return false;

	const tilt_lens::PupilPoint p = tilt_lens::SquareToDisc(tiltLensSample.lens_u, tiltLensSample.lens_v);
	const Vec3d S = p.x * lens.lens_x + p.y * lens.lens_y;
	const Vec3d R = tilt_lens::RayDirection(v, S, tilt_lens::InverseFocusDistance(lens.inverse_focus, v));

	Make_Vector(ray.Origin, camera.Location[X] + S.x, camera.Location[Y] + S.y, camera.Location[Z] + S.z);
	Make_Vector(ray.Direction, R.x, R.y, R.z);
	return true;
}

/// Running sums of a pixel's samples, in double so that thousands of them lose nothing.
struct Sample_Sums
{
	static const int Channels = 5;
	DBL sum[Channels], squares[Channels];
	int count;

	Sample_Sums() : count(0)
	{
		for(int i = 0; i < Channels; i++)
			sum[i] = squares[i] = 0.0;
	}

	void Add(const Colour& c)
	{
		for(int i = 0; i < Channels; i++)
		{
			sum[i] += c[i];
			squares[i] += DBL(c[i]) * DBL(c[i]);
		}
		count++;
	}

	/// Largest variance of the mean over the channels (taken as if the samples were
	/// independent, which for a digital net is on the safe side).
	DBL VarianceOfMean() const
	{
		DBL worst = 0.0;
		for(int i = 0; i < Channels; i++)
		{
			const DBL mean = sum[i] / count;
			worst = max(worst, (squares[i] / count - mean * mean) / (count - 1));
		}
		return worst;
	}
};

/// Distributed ray tracing over the pixel and the lens. Stops at 16, 32, 64, ...
/// samples once the variance of the pixel's mean is below `variance`, with the
/// probability `confidence`, and at blur_samples in any case.
void TracePixel::TraceRayWithTiltLens(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	tilt_lens::PixelSampler sampler((uint32_t)(int)x, (uint32_t)(int)y);
	const int last = max(camera.Blur_Samples, 1);
	int level = min(max(First_Level, camera.Blur_Samples_Min), last);
	Sample_Sums sums;
	Ray ray;

	while(true)
	{
		while(sums.count < level)
		{
			Colour c(0.0, 0.0, 0.0, 0.0, 1.0);

			tiltLensSample = sampler.Next();
			// remove interiors accumulated from previous sample (if any)
			ray.ClearInteriors();
			if(CreateCameraRay(ray, x + tiltLensSample.pixel_x - 0.5, y + tiltLensSample.pixel_y - 0.5, width, height, 0))
			{
				c.clear();
				Trace::TraceTicket ticket(maxTraceLevel, adcBailout, sceneData->outputAlpha);
				TraceRay(ray, c, 1.0, ticket, false, camera.Max_Ray_Distance);
			}
			sums.Add(c);
		}
		if(sums.count >= last)
			break;
		// The variance is itself an estimate from n - 1 degrees of freedom: ask for its
		// upper bound at the scene's confidence.
		const DBL freedom = sums.count - 1;
		if(sums.VarianceOfMean() * freedom < camera.Variance * chdtri(freedom, camera.Confidence))
			break;
		level = min(2 * level, last);
	}

	for(int i = 0; i < Sample_Sums::Channels; i++)
		colour[i] = sums.sum[i] / sums.count;
}

}
