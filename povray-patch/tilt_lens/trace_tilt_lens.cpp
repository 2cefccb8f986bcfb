// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Tracing through a tilted lens: the methods that tilt_lens adds to TracePixel.

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/colour/colour.h"
#include "backend/interior/media.h"
#include "backend/math/vector.h"
#include "backend/render/tracepixel.h"
#include "backend/scene/objects.h"
#include "backend/shape/isosurf.h"
#include "backend/shape/planes.h"
#include "backend/tilt_lens/bokeh.h"
#include "lens/optics.h"
#include "backend/tilt_lens/sample_sums.h"
#include "lens/pupil.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Vec3d;

namespace
{

bool HasAreaLights(const vector<LightSource *>& lights)
{
	for(size_t i = 0; i < lights.size(); i++)
		if(lights[i]->Area_Light)
			return true;
	return false;
}

}

/// Chooses, once, how rays go through this camera's lens and what becomes of their light:
/// what a scene does not name is not in the code that its rays run through.
void TracePixel::SetupTiltLens()
{
	const tilt_lens::CameraLens& camera_lens = camera.Tilt_Lens;
	const tilt_lens::TiltLens& lens = camera_lens.lens;
	const bool paints = (camera.Bokeh != NULL) && !lens.IsPinhole();

	cameraDirection = Vector3d(lens.direction.x, lens.direction.y, lens.direction.z);
	// False leaves the camera to stock's pinhole path.
	useFocalBlur = camera_lens.Samples_Lens() || camera_lens.Shows() || lens.moves_pinhole_rays;
	tiltLensWavelength = tilt_lens::GreenWavelength;
	tiltLensLights = camera_lens.Samples_Lights() && (HasAreaLights(sceneData->lightSources) || HasAreaLights(sceneData->lightGroupLightSources)) ? &tiltLensLightSamples : NULL;
	sendRayThroughTiltLens = lens.has_effects ? &TracePixel::SendRayThroughTiltLensWithEffects : &TracePixel::SendRayThroughTiltLens;
	if(paints)
		addTiltLensSample = lens.splits ? &TracePixel::AddTiltLensSample<true, true, true> : &TracePixel::AddTiltLensSample<true, true, false>;
	else if(lens.weighs)
		addTiltLensSample = lens.splits ? &TracePixel::AddTiltLensSample<true, false, true> : &TracePixel::AddTiltLensSample<true, false, false>;
	else
		addTiltLensSample = lens.splits ? &TracePixel::AddTiltLensSample<false, false, true> : &TracePixel::AddTiltLensSample<false, false, false>;
	tiltLensTouchesInterior = InteriorTouchesTiltLens();
	tiltLensLabels = NULL;
	tiltLensMedia = NULL;   // tasks make theirs after the tracer: it is asked for later
	// Made when first asked for, which would be too late to seed them. Subsurface light nests to depth 2.
	for(int depth = 0; sceneData->useSubsurface && (depth <= 2); depth++)
	{
		ssltUniformDirectionGenerator.push_back(GetSubRandomDirectionGenerator(0, 32767));
		ssltUniformNumberGenerator.push_back(GetRandomDoubleGenerator(0.0, 1.0, 32767));
		ssltCosWeightedDirectionGenerator.push_back(GetSubRandomCosWeightedDirectionGenerator(2, 32767));
	}
}

template<class Type>
static void Seed_Generators(vector<shared_ptr<SequentialNumberGenerator<Type> > >& generators, size_t seed)
{
	for(size_t i = 0; i < generators.size(); i++)
		if(SeedableNumberGenerator<Type> *generator = dynamic_cast<SeedableNumberGenerator<Type> *>(generators[i].get()))
			generator->Seed(seed);
}

/// Sets what a thread keeps from ray to ray, without which a pixel would depend on what its thread traced before:
/// where every pseudo-random sequence goes on (jitter of area lights and media, crand, rainbows, subsurface light), what shadowed lights
/// last, and where an isosurface was last not met.
void TracePixel::ForgetEarlierTiltLensRays(unsigned int seed)
{
	ForgetWhatShadowedLights();
	threadData->isosurfaceData->cache = false;
	crandRandomNumberGenerator = seed;
	randomNumberGenerator.SetSeed(seed);
	if(tiltLensMedia == NULL)
		tiltLensMedia = dynamic_cast<MediaFunction *>(&media);
	if(tiltLensMedia != NULL)
		tiltLensMedia->SeedRandomNumbers(seed);
	Seed_Generators(ssltUniformDirectionGenerator, seed);
	Seed_Generators(ssltUniformNumberGenerator, seed);
	Seed_Generators(ssltCosWeightedDirectionGenerator, seed);
}

/// Whether the box of an object reaches the lens.
static bool Box_Touches_Lens(const BBOX& box, const VECTOR location, const tilt_lens::TiltLens& lens)
{
	const DBL x[3] = { lens.lens_x.x, lens.lens_x.y, lens.lens_x.z };
	const DBL y[3] = { lens.lens_y.x, lens.lens_y.y, lens.lens_y.z };

	for(int i = 0; i < 3; i++)
	{
		// Boxes are kept in single precision: leave room for their rounding.
		// A square opening has corners.
		const DBL extent = lens.square ? fabs(x[i]) + fabs(y[i]) : sqrt(x[i] * x[i] + y[i] * y[i]);
		const DBL reach = (lens.reach * extent + lens.reach_of_pinhole + fabs(location[i]) * 1e-6) * 1.001 + EPSILON;
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
		const DBL reach = 1.01 * lens.reach;
		int inside = 0;
		for(int corner = 0; corner < 4; corner++)
		{
			const Vec3d offset = ((corner & 1) ? 1.0 : -1.0) * (reach * lens.lens_x + lens.reach_of_pinhole * lens.basis_x) +
			                     ((corner & 2) ? 1.0 : -1.0) * (reach * lens.lens_y + lens.reach_of_pinhole * lens.basis_y);
			VECTOR point = { camera.Location[X] + offset.x, camera.Location[Y] + offset.y, camera.Location[Z] + offset.z };
			inside += (*object)->Inside(point, threadData) ? 1 : 0;
		}
		if((inside != 0) && (inside != 4))
			return true;
	}
	return false;
}

/// Turns the pinhole ray of a pixel, which stands in `ray`, into the ray that
/// leaves the current lens sample (lens/MODEL.md, The lens ray). False where there is none.
///
/// The pinhole direction is w v, not v; so is the result, since R is linear in v.
bool TracePixel::SendRayThroughTiltLens(Ray& ray)
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;
	const Vec3d v = { ray.Direction[X], ray.Direction[Y], ray.Direction[Z] };

	// Along or behind the lens plane there is no ray, unless the lens is but a point. (Here both pupils are as large.)
	if(!(Dot(v, lens.normal) > 0.0))
	{
		if(!lens.IsPinhole())
			return false;
		InitRayContainerState(ray, false);
		return true;
	}

	const tilt_lens::PupilPoint p = tilt_lens::SquareToDisc(tiltLensSample.lens_u, tiltLensSample.lens_v);
	const Vec3d S = p.x * lens.lens_x + p.y * lens.lens_y;
	const Vec3d R = tilt_lens::RayDirection(v, S, tilt_lens::InverseFocusDistance(lens.inverse_focus, v));

	Make_Vector(ray.Origin, camera.Location[X] + S.x, camera.Location[Y] + S.y, camera.Location[Z] + S.z);
	Make_Vector(ray.Direction, R.x, R.y, R.z);
	InitRayContainerState(ray, tiltLensTouchesInterior);
	return true;
}

/// The same for a lens with effects: one step after the other, as effects.cpp lists them.
bool TracePixel::SendRayThroughTiltLensWithEffects(Ray& ray)
{
	const tilt_lens::TiltLens& lens = camera.Tilt_Lens.lens;
	tilt_lens::LensRay r;

	r.pixel = r.v = { ray.Direction[X], ray.Direction[Y], ray.Direction[Z] };
	r.lens_u = tiltLensSample.lens_u;
	r.lens_v = tiltLensSample.lens_v;
	r.wavelength = tiltLensWavelength;
	r.weight = tiltLensWeight = 1.0;
	if(!(lens.Depth(r.v) > 0.0))
	{
		if(!lens.IsPinhole() || lens.weighs)
			return false;
		InitRayContainerState(ray, false);
		return true;
	}

	for(const tilt_lens::LensStep *step = lens.steps; *step != NULL; step++)
		(*step)(lens, r);
	tiltLensWeight = r.weight;
	tiltLensPoint = r.point;

	Make_Vector(ray.Origin, camera.Location[X] + r.S.x, camera.Location[Y] + r.S.y, camera.Location[Z] + r.S.z);
	Make_Vector(ray.Direction, r.R.x, r.R.y, r.R.z);
	InitRayContainerState(ray, tiltLensTouchesInterior);
	return true;
}

/// Traces the current lens sample in the current wavelength. Returns how much of its light
/// arrives: `c`, transparency too, is multiplied by that. A ray of which nothing arrives is
/// not traced. `paint` is what the bokeh pigment makes of its colours.
template<bool Weighs, bool Paints>
DBL TracePixel::TraceTiltLensRay(Ray& ray, tilt_lens::SampleSums& sums, Colour& c, Colour *paint, DBL x, DBL y, DBL width, DBL height)
{
	DBL weight = 1.0;

	// remove interiors accumulated from previous sample (if any)
	ray.ClearInteriors();
	if(!CreateCameraRay(ray, x, y, width, height, 0))
	{
		// No ray, where the pixel looks along or behind the lens: empty, transparent.
		c = Colour(0.0, 0.0, 0.0, 0.0, 1.0);
		for(int i = 0; Paints && (i < 3); i++)
			(*paint)[i] = 1.0;
		sums.stopped++;
		return 1.0;
	}
	c.clear();
	if(Weighs)
		weight = tiltLensWeight;
	if(Paints)
	{
		// Of rays that a rim stops too: their places belong to the opening.
		*paint = tilt_lens::BokehAt(camera.Bokeh, tiltLensPoint, threadData);
		for(int i = 0; i < 3; i++)
			(*paint)[i] *= camera.Tilt_Lens.bokeh_gain[i];
		weight *= paint->greyscale();
	}
	if(Weighs && !(weight > 0.0))
	{
		sums.stopped++;
		return 0.0;
	}

	Trace::TraceTicket ticket(maxTraceLevel, adcBailout, sceneData->outputAlpha);
	TraceRay(ray, c, 1.0, ticket, false, camera.Max_Ray_Distance);
	if(Paints)
		c = Colour(c[pRED] * (*paint)[pRED] * tiltLensWeight, c[pGREEN] * (*paint)[pGREEN] * tiltLensWeight, c[pBLUE] * (*paint)[pBLUE] * tiltLensWeight,
		           c[pFILTER] * weight, c[pTRANSM] * weight);
	else if(Weighs)
		c *= weight;
	return weight;
}

/// Traces the current lens sample of the pixel x, y and adds it to `sums`; once or, if
/// wavelengths go different ways, three times.
template<bool Weighs, bool Paints, bool Splits>
void TracePixel::AddTiltLensSample(Ray& ray, tilt_lens::SampleSums& sums, DBL x, DBL y, DBL width, DBL height)
{
	Colour c, paint;
	DBL weight = 0.0;

	if(!Splits)
		weight = TraceTiltLensRay<Weighs, Paints>(ray, sums, c, Paints ? &paint : NULL, x, y, width, height);
	else
	{
		c.clear();
		for(tiltLensWavelength = 0; tiltLensWavelength < tilt_lens::Wavelengths; tiltLensWavelength++)
		{
			Colour one, its_paint;
			// From the start: the wavelengths' colours are parts of one sample.
			if(tiltLensLights != NULL)
				tiltLensLightSamples.Begin();
			weight += TraceTiltLensRay<Weighs, Paints>(ray, sums, one, Paints ? &its_paint : NULL, x, y, width, height) / tilt_lens::Wavelengths;
			c[tiltLensWavelength] = one[tiltLensWavelength];
			paint[tiltLensWavelength] = its_paint[tiltLensWavelength];
			c[pFILTER] += one[pFILTER] / tilt_lens::Wavelengths;
			c[pTRANSM] += one[pTRANSM] / tilt_lens::Wavelengths;
		}
	}
	if(Weighs)
		sums.Weigh(weight, c);
	if(Paints)
		sums.AddPainted(c, paint);
	else
		sums.Add(c);
}

/// Goes on with a pixel until it has `samples` samples; under a bokeh pigment, until some of them say something.
void TracePixel::SampleTiltLensPixel(tilt_lens::TilePixel& pixel, int samples, DBL width, DBL height)
{
	Ray ray;
	const bool lights = (tiltLensLights != NULL);

	if(pixel.sums.count >= samples)
		return;
	ForgetEarlierTiltLensRays(tilt_lens::RandomSeedOfPixel(pixel.x, pixel.y, camera.Tilt_Lens.Seed(), pixel.sums.count));
	const double *const gain = camera.Tilt_Lens.bokeh_gain;
	do
		while(pixel.sums.count < samples)
		{
			tiltLensSample = pixel.sampler.Next();
			if(lights)
				tiltLensLightSamples.Draw(pixel.sampler.Light());
			(this->*addTiltLensSample)(ray, pixel.sums, pixel.x + tiltLensSample.pixel_x - 0.5, pixel.y + tiltLensSample.pixel_y - 0.5, width, height);
		}
	// Where a bokeh pigment is black no ray is traced: on, one by one, to where it is not.
	while(pixel.sums.IsTooDark(gain) && (++samples <= tilt_lens::SampleSums::MostInTheDark));
}

/// One ray through the lens centre, for a camera without an opening whose lens
/// nevertheless does something to rays.
void TracePixel::TraceRayThroughTiltLensCentre(Colour& colour, DBL x, DBL y, DBL width, DBL height)
{
	Ray ray;
	tilt_lens::SampleSums sums;

	tiltLensSample = { 0.5, 0.5, 0.5, 0.5 };
	// Anti-aliasing asks for places between pixels.
	ForgetEarlierTiltLensRays(tilt_lens::RandomSeedOfPixel(int(x * 4096.0), int(y * 4096.0), camera.Tilt_Lens.Seed(), 0));
	(this->*addTiltLensSample)(ray, sums, x, y, width, height);
	colour = sums.Mean();
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
