// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tracing through a tilted lens: the methods that tilt_lens adds to TracePixel.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/scene/objects.h"
#include "backend/shape/planes.h"
#include "backend/tilt_lens/field_curvature.h"
#include "backend/tilt_lens/optics.h"
#include "backend/tilt_lens/preview.h"
#include "backend/tilt_lens/sample_sums.h"
#include "backend/tilt_lens/pupil.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Vec3d;

/// Chooses, once, how rays go through this camera's lens: what a scene does not
/// name is not in the code that its rays run through.
void TracePixel::SetupTiltLens()
{
	const tilt_lens::CameraLens& camera_lens = camera.Tilt_Lens;

	cameraDirection = Vector3d(camera_lens.lens.direction.x, camera_lens.lens.direction.y, camera_lens.lens.direction.z);
	// False leaves the camera to stock's pinhole path.
	useFocalBlur = camera_lens.Samples_Lens() || camera_lens.Shows() || camera_lens.lens.distorts;
	const bool curves = camera_lens.lens.Curves();
	if(camera_lens.lens.distorts)
		sendRayThroughTiltLens = curves ? &TracePixel::SendRayThroughTiltLens<true, true> : &TracePixel::SendRayThroughTiltLens<true, false>;
	else
		sendRayThroughTiltLens = curves ? &TracePixel::SendRayThroughTiltLens<false, true> : &TracePixel::SendRayThroughTiltLens<false, false>;
	tiltLensTouchesInterior = InteriorTouchesTiltLens();
}

/// Whether the box of an object reaches the lens.
static bool Box_Touches_Lens(const BBOX& box, const VECTOR location, const tilt_lens::TiltLens& lens)
{
	const DBL x[3] = { lens.lens_x.x, lens.lens_x.y, lens.lens_x.z };
	const DBL y[3] = { lens.lens_y.x, lens.lens_y.y, lens.lens_y.z };

	for(int i = 0; i < 3; i++)
	{
		// Boxes are kept in single precision: leave room for their rounding.
		const DBL reach = (sqrt(x[i] * x[i] + y[i] * y[i]) + fabs(location[i]) * 1e-6) * 1.001 + EPSILON;
		const DBL low = box.Lower_Left[i], high = low + box.Lengths[i];
		if((low - fabs(low) * 1e-6 > location[i] + reach) || (high + fabs(high) * 1e-6 < location[i] - reach))
			return false;
	}
	return true;
}

/// Whether something with an interior may begin or end on the lens, so that the
/// interiors at the lens differ from sample to sample. A yes costs a look-up per
/// ray, a wrong no would be a wrong picture.
bool TracePixel::InteriorTouchesTiltLens()
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;

	for(vector<ObjectPtr>::iterator object = sceneData->objects.begin(); object != sceneData->objects.end(); object++)
	{
		if(((*object)->interior == NULL) || !Box_Touches_Lens((*object)->BBox, camera.Location, lens))
			continue;
		// Planes are endless, and floors in most scenes. A plane that has all corners of a
		// square around the lens on one side has the lens on that side.
		if((dynamic_cast<Plane *>(*object) == NULL) || !(*object)->Clip.empty())
			return true;
		int inside = 0;
		for(int corner = 0; corner < 4; corner++)
		{
			const Vec3d offset = ((corner & 1) ? 1.01 : -1.01) * lens.lens_x + ((corner & 2) ? 1.01 : -1.01) * lens.lens_y;
			VECTOR point = { camera.Location[X] + offset.x, camera.Location[Y] + offset.y, camera.Location[Z] + offset.z };
			inside += (*object)->Inside(point, threadData) ? 1 : 0;
		}
		if((inside != 0) && (inside != 4))
			return true;
	}
	return false;
}

/// Turns the pinhole ray of a pixel, which stands in `ray`, into the ray that
/// leaves the current lens sample (DESIGN.md, section 2). False where the pixel
/// looks along or behind the lens plane (v.n <= 0): there is no such ray, unless the
/// lens is but a point.
///
/// The pinhole direction is w v, not v; so is the result, since R is linear in v.
template<bool Distorts, bool Curves>
bool TracePixel::SendRayThroughTiltLens(Ray& ray)
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;
	Vec3d v = { ray.Direction[X], ray.Direction[Y], ray.Direction[Z] };

	if(!(Dot(v, lens.normal) > 0.0))
	{
		if(!lens.IsPinhole())
			return false;
		InitRayContainerState(ray, false);
		return true;
	}
	if(Distorts)
		v = tilt_lens::UndistortDirection(lens.distortion, lens.basis_x, lens.basis_y, lens.normal, v);

	const tilt_lens::PupilPoint p = tilt_lens::SquareToDisc(tiltLensSample.lens_u, tiltLensSample.lens_v);
	const Vec3d S = p.x * lens.lens_x + p.y * lens.lens_y;
	const DBL kappa = Curves ? tilt_lens::InverseFocusDistanceOnBowl(lens.inverse_focus, lens.field_curvature, lens.normal, v)
	                         : tilt_lens::InverseFocusDistance(lens.inverse_focus, v);
	const Vec3d R = tilt_lens::RayDirection(v, S, kappa);

	Make_Vector(ray.Origin, camera.Location[X] + S.x, camera.Location[Y] + S.y, camera.Location[Z] + S.z);
	Make_Vector(ray.Direction, R.x, R.y, R.z);
	InitRayContainerState(ray, tiltLensTouchesInterior);
	return true;
}

/// The preview of focus: one ray through the lens centre, and paint over it.
void TracePixel::ShowTiltLens(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	const tilt_lens::CameraLens& camera_lens = camera.Tilt_Lens;
	const tilt_lens::TiltLens& lens = camera_lens.lens;
	tilt_lens::PixelFocus pixel = { 0.0, 0.0, width * Dot(lens.direction, lens.axis) / cameraLengthRight, true };
	Ray ray;

	colour.clear();
	tiltLensSample = { 0.5, 0.5, 0.5, 0.5 };
	if(CreateCameraRay(ray, x, y, width, height, 0))
	{
		Trace::TraceTicket ticket(maxTraceLevel, adcBailout, sceneData->outputAlpha);
		const DBL distance = TraceRay(ray, colour, 1.0, ticket, false, camera.Max_Ray_Distance);
		const Vec3d direction = { ray.Direction[X], ray.Direction[Y], ray.Direction[Z] };
		const DBL slope = Dot(direction, lens.axis);

		pixel.kappa = lens.Kappa(direction) / slope;
		pixel.inverse_depth = (distance < BOUND_HUGE) ? 1.0 / (distance * slope) : 0.0;
		pixel.empty = false;
	}

	tilt_lens::Rgb c = { colour[pRED], colour[pGREEN], colour[pBLUE] };
	if(camera_lens.spec.show_focus)
		c = tilt_lens::ShowFocus(c, pixel, lens.aperture_diameter);
	if(camera_lens.spec.show_plane)
		c = tilt_lens::ShowPlane(c, pixel);
	colour = Colour(c.r, c.g, c.b, colour[pFILTER], colour[pTRANSM]);
}

/// One ray through the lens centre, for a camera without an opening whose lens
/// nevertheless does something to rays.
void TracePixel::TraceRayThroughTiltLensCentre(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	Ray ray;

	colour = Colour(0.0, 0.0, 0.0, 0.0, 1.0);
	tiltLensSample = { 0.5, 0.5, 0.5, 0.5 };
	if(CreateCameraRay(ray, x, y, width, height, 0))
	{
		colour.clear();
		Trace::TraceTicket ticket(maxTraceLevel, adcBailout, sceneData->outputAlpha);
		TraceRay(ray, colour, 1.0, ticket, false, camera.Max_Ray_Distance);
	}
}

/// A pixel by itself: the preview of focus, a lens without an opening, and the rough
/// first look of mosaic previews and of radiosity's pretrace. The picture proper is
/// traced a tile at a time, by TraceTiltLensTile.
void TracePixel::TraceRayWithTiltLens(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	if(camera.Tilt_Lens.Shows())
		ShowTiltLens(colour, x, y, width, height);
	else if(camera.Tilt_Lens.lens.IsPinhole())
		TraceRayThroughTiltLensCentre(colour, x, y, width, height);
	else
	{
		tilt_lens::TilePixel pixel((int)x, (int)y, camera.Tilt_Lens.Seed());
		SampleTiltLensPixel(pixel, camera.Tilt_Lens.levels.front().samples, width, height);
		colour = pixel.sums.Mean();
	}
}

}
