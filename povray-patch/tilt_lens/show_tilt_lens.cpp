// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The preview of focus, `show focus` and `show plane`: methods that tilt_lens adds to TracePixel.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/tilt_lens/camera_vectors.h"
#include "backend/tilt_lens/shown_labels.h"
#include "lens/aberrated_lens.h"
#include "lens/preview.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Vec3d;

/// The ray through the lens centre and a place in the picture. False where there is none.
bool TracePixel::CreateTiltLensChiefRay(Ray& ray, DBL x, DBL y, DBL width, DBL height)
{
	tiltLensSample = { 0.5, 0.5, 0.5, 0.5 };
	tiltLensWavelength = tilt_lens::GreenWavelength;
	// Anti-aliasing asks for places between pixels.
	ForgetEarlierTiltLensRays(tilt_lens::RandomSeedOfPixel(int(x * 4096.0), int(y * 4096.0), camera.Tilt_Lens.Seed(), 0));
	return CreateCameraRay(ray, x, y, width, height, 0);
}

/// What the preview of focus knows of a place in the picture, from the ray through it and from how far that goes
/// (HUGE_VAL: for ever). Blur widths are to be counted in pixels of a picture so wide.
void TracePixel::FocusAlongTiltLensRay(tilt_lens::PixelFocus& focus, const Ray& ray, DBL distance, DBL x, DBL y, DBL width, DBL height, DBL counted_width)
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;
	const Vec3d direction = { ray.Direction[X], ray.Direction[Y], ray.Direction[Z] };
	const DBL slope = Dot(direction, lens.axis);

	if(lens.aberrates)
	{
		const tilt_lens::CameraVectors vectors = Vectors_Of(camera);
		const Vec3d v = lens.direction + ((x + 0.5) / width - 0.5) * vectors.right + (0.5 - (y + 0.5) / height) * vectors.up;
		focus.kappa = InverseFocusAlongLensAxis(lens, v) * Dot(direction, lens.normal) / slope;
	}
	else
		focus.kappa = lens.Kappa(direction) / slope;
	focus.inverse_depth = (distance < BOUND_HUGE) ? 1.0 / (distance * slope) : 0.0;
	focus.pixels_per_slope = counted_width * Dot(lens.direction, lens.axis) / cameraLengthRight;
	focus.empty = false;
}

/// One ray through the lens centre: what the preview of focus knows of a place in the picture, and
/// its colour. False where there is no ray.
bool TracePixel::FocusOfTiltLensPixel(tilt_lens::PixelFocus& focus, Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	const tilt_lens::LensSpec& spec = camera.Tilt_Lens.spec;
	Ray ray;

	focus.inverse_depth = focus.kappa = focus.pixels_per_slope = 0.0;
	focus.empty = true;
	colour.clear();
	if(!CreateTiltLensChiefRay(ray, x, y, width, height))
		return false;

	Trace::TraceTicket ticket(maxTraceLevel, adcBailout, sceneData->outputAlpha);
	const DBL distance = TraceRay(ray, colour, 1.0, ticket, false, camera.Max_Ray_Distance);
	// In pixels of the picture that is to come, if the scene says how wide that is.
	FocusAlongTiltLensRay(focus, ray, distance, x, y, width, height, spec.show_width ? spec.show_width.value : width);
	return true;
}

/// The numbers on the contours of `show focus`, from rays all over the picture, whatever part of
/// it is rendered: strips and threads agree on them. The first thread places them for all.
void TracePixel::PlaceTiltLensLabels(DBL width, DBL height)
{
	tilt_lens::ShownLabels& shown = *camera.Tilt_Lens.labels;
	boost::mutex::scoped_lock lock(shown.mutex);

	if(!shown.placed)
	{
		tilt_lens::BlurGrid grid = tilt_lens::BlurGrid::Of(int(width), int(height));
		for(int row = 0; row < grid.rows; row++)
			for(int column = 0; column < grid.columns; column++)
			{
				tilt_lens::PixelFocus focus;
				Colour colour;
				if(FocusOfTiltLensPixel(focus, colour, column * grid.spacing, row * grid.spacing, width, height))
					grid.blur[size_t(row) * grid.columns + column] = BlurInPixels(focus, camera.Tilt_Lens.lens.aperture_diameter);
				cooperate();
			}
		shown.labels = tilt_lens::FocusLabels(grid);
		shown.placed = true;
	}
	tiltLensLabels = &shown.labels;
}

/// The preview of focus: one ray through the lens centre, and paint over it.
void TracePixel::ShowTiltLens(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	const tilt_lens::CameraLens& camera_lens = camera.Tilt_Lens;
	tilt_lens::PixelFocus pixel;

	if(camera_lens.labels && (tiltLensLabels == NULL))
		PlaceTiltLensLabels(width, height);
	FocusOfTiltLensPixel(pixel, colour, x, y, width, height);

	tilt_lens::Rgb c = { colour[pRED], colour[pGREEN], colour[pBLUE] };
	if(camera_lens.spec.show_focus)
		c = tilt_lens::ShowFocus(c, pixel, camera_lens.lens.aperture_diameter);
	if(camera_lens.spec.show_plane)
		c = tilt_lens::ShowPlane(c, pixel);
	bool nearer = false;
	const tilt_lens::FocusLabels::Paint paint = tiltLensLabels != NULL ? tiltLensLabels->At(x, y, nearer) : tilt_lens::FocusLabels::Nothing;
	if(paint != tilt_lens::FocusLabels::Nothing)
	{
		c = tilt_lens::ShowLabel(paint, nearer);
		colour[pFILTER] = colour[pTRANSM] = 0.0;
	}
	colour = Colour(c.r, c.g, c.b, colour[pFILTER], colour[pTRANSM]);
}

}
