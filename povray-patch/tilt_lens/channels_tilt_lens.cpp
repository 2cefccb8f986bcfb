// SPDX-License-Identifier: AGPL-3.0-or-later
//
// `channels`: depth, blur width, samples and error of a pixel. Methods that tilt_lens adds to TracePixel.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/tilt_lens/sample_sums.h"
#include "lens/lens_channels.h"
#include "lens/preview.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Notes what is known of a pixel that has its samples. Depth and blur width are those along the ray through the middle
/// of pixel and lens, which is looked along once more and not shaded: means over samples would be depths at which
/// nothing is, wherever two things meet in a pixel.
void TracePixel::RecordTiltLensChannels(const tilt_lens::TilePixel& pixel, DBL width, DBL height)
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;
	tilt_lens::ChannelValues values = { tilt_lens::LensChannels::NothingThere, 0.0, DBL(pixel.sums.count), pixel.sums.StandardError(pixel.neighbourhood_variance) };
	tilt_lens::PixelFocus focus;
	Intersection met;
	Ray ray;

	if(CreateTiltLensChiefRay(ray, pixel.x, pixel.y, width, height))
	{
		if(camera.Max_Ray_Distance >= EPSILON)
			met.Depth = camera.Max_Ray_Distance;
		const bool found = FindIntersection(met, ray, NoSomethingFlagRayObjectCondition(), TrueRayObjectCondition());
		FocusAlongTiltLensRay(focus, ray, found ? met.Depth : HUGE_VAL, pixel.x, pixel.y, width, height, width);
		values.blur = tilt_lens::BlurInPixels(focus, lens.aperture_diameter);
		if(focus.inverse_depth > 0.0)
			values.depth = min(1.0 / focus.inverse_depth, DBL(tilt_lens::LensChannels::NothingThere));
	}
	camera.Tilt_Lens.channels->Set(pixel.x, pixel.y, values);
}

}
