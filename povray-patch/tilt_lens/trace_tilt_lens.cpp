// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tracing through a tilted lens: the methods that tilt_lens adds to TracePixel.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/tilt_lens/optics.h"
#include "backend/tilt_lens/pupil.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Vec3d;

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
	// the sums as they stood at the last power of two below count
	DBL earlier_sum[Channels];
	int earlier_count;

	Sample_Sums() : count(0), earlier_count(0)
	{
		for(int i = 0; i < Channels; i++)
			sum[i] = squares[i] = earlier_sum[i] = 0.0;
	}

	void Add(const Colour& c)
	{
		if((count & (count - 1)) == 0)
			KeepEarlier();
		for(int i = 0; i < Channels; i++)
		{
			sum[i] += c[i];
			squares[i] += DBL(c[i]) * DBL(c[i]);
		}
		count++;
	}

	void KeepEarlier()
	{
		for(int i = 0; i < Channels; i++)
			earlier_sum[i] = sum[i];
		earlier_count = count;
	}

	/// Squared error of the mean, averaged over red, green and blue: what the later
	/// half of the samples changed. Rough for one pixel, right on average over many,
	/// and it sees what a digital net gains over independent samples.
	DBL SquaredError() const
	{
		DBL error = 0.0;
		for(int i = 0; (i < 3) && (earlier_count > 0); i++)
			error += Sqr(earlier_sum[i] / earlier_count - sum[i] / count);
		return error / 3.0;
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

/// Distributed ray tracing over the pixel and the lens, until the pixel's mean is
/// as certain as the scene asks, or blur_samples are spent.
void TracePixel::TraceRayWithTiltLens(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	tilt_lens::PixelSampler sampler((uint32_t)(int)x, (uint32_t)(int)y);
	const vector<tilt_lens::SampleLevel>& levels = camera.Tilt_Lens.levels;
	Sample_Sums sums;
	Ray ray;

	for(size_t level = 0; level < levels.size(); level++)
	{
		while(sums.count < levels[level].samples)
		{
			// No ray, where the pixel looks along or behind the lens: empty, transparent.
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
		if((level + 1 == levels.size()) || (sums.VarianceOfMean() < levels[level].stop_below))
			break;
	}

	for(int i = 0; i < Sample_Sums::Channels; i++)
		colour[i] = sums.sum[i] / sums.count;
	if(!pretrace)
		threadData->tiltLensCounts.AddPixel(sums.count, sums.SquaredError());
}

}
