// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>

#include "lens/aberrated_lens.h"
#include "lens/angles.h"
#include "lens/check_effects.h"
#include "lens/effects.h"
#include "lens/field_curvature.h"
#include "lens/natural_vignetting.h"
#include "lens/optical_vignetting.h"
#include "lens/optics.h"
#include "lens/pupil_magnification.h"
#include "lens/words.h"

namespace tilt_lens
{

namespace
{

// What each effect does to a ray. The formulas are in the headers named like the effects.

void PassPupils(const TiltLens& lens, LensRay& ray)
{
	ray.pixel = DirectionFromExitPupil(lens.axis, lens.pupil_magnification, ray.pixel);
	ray.v = DirectionBeforePupils(lens.normal, lens.pupil_magnification, ray.pixel);
}

void MagnifyColour(const TiltLens& lens, LensRay& ray)
{
	ray.v = LateralDirection(lens.normal, lens.lateral[ray.wavelength], ray.v);
}

void Undistort(const TiltLens& lens, LensRay& ray)
{
	ray.v = UndistortDirection(lens.distortion, lens.basis_x, lens.basis_y, lens.normal, ray.v);
}

void OpenDisc(const TiltLens&, LensRay& ray)
{
	ray.point = SquareToDisc(ray.lens_u, ray.lens_v);
}

void OpenBlades(const TiltLens& lens, LensRay& ray)
{
	ray.point = SquareToBlades(lens.blades, ray.lens_u, ray.lens_v);
}

void OpenSquare(const TiltLens&, LensRay& ray)
{
	ray.point = { 2.0 * ray.lens_u - 1.0, 2.0 * ray.lens_v - 1.0 };
}

void FocusOnPlane(const TiltLens& lens, LensRay& ray)
{
	ray.kappa = InverseFocusDistance(lens.inverse_focus, ray.v);
}

void FocusOnBowl(const TiltLens& lens, LensRay& ray)
{
	ray.kappa = InverseFocusDistanceOnBowl(lens.inverse_focus, lens.field_curvature, lens.normal, ray.v);
}

void FocusColour(const TiltLens& lens, LensRay& ray)
{
	ray.kappa = AxialFocus(lens.normal, lens.axial[ray.wavelength], ray.v, ray.kappa);
}

void LeaveLens(const TiltLens& lens, LensRay& ray)
{
	ray.S = ray.point.x * lens.lens_x + ray.point.y * lens.lens_y;
	ray.R = RayDirection(ray.v, ray.S, ray.kappa);
}

void DarkenNaturally(const TiltLens& lens, LensRay& ray)
{
	ray.weight *= NaturalFalloff(lens.normal, lens.axis, ray.pixel);
}

void CutByRim(const TiltLens& lens, LensRay& ray)
{
	if(!PassesRim(ViewOfRim(lens.normal, ray.v, ray.kappa, lens.rims[0].distance), ray.S, lens.rims[0].radius))
		ray.weight = 0.0;
}

/// Aberrated: the ray no longer leaves the lens where it entered it.
template<bool Aberrated>
inline bool PassesRims(const TiltLens& lens, const LensRay& ray)
{
	for(int i = 0; i < lens.rim_count; i++)
	{
		const Rim& rim = lens.rims[i];
		const RimView<double> view = rim.distance < 0.0
			? ViewOfRimBehind(lens.normal, lens.axis, ray.pixel, lens.image_distance, lens.pupil_magnification, rim.distance)
			: ViewOfRim(lens.normal, ray.v, ray.kappa, rim.distance);
		const Vec3d S = Aberrated && rim.distance < 0.0 ? ray.point.x * lens.lens_x + ray.point.y * lens.lens_y : ray.S;
		if(!PassesRim(view, S, rim.radius))
			return false;
	}
	return true;
}

void CutByRims(const TiltLens& lens, LensRay& ray)
{
	if(!PassesRims<false>(lens, ray))
		ray.weight = 0.0;
}

void CutByRimsAberrated(const TiltLens& lens, LensRay& ray)
{
	if(!PassesRims<true>(lens, ray))
		ray.weight = 0.0;
}

bool EveryLens(const TiltLens&) { return true; }
bool MagnifiesPupils(const TiltLens& lens) { return lens.pupil_magnification != 1.0; }
bool MagnifiesColours(const TiltLens& lens) { return lens.lateral[RedWavelength] != 0.0 || lens.lateral[BlueWavelength] != 0.0; }
bool FocusesColours(const TiltLens& lens) { return lens.axial[RedWavelength] != 0.0 || lens.axial[BlueWavelength] != 0.0; }
bool Distorts(const TiltLens& lens) { return lens.distorts; }
bool IsRound(const TiltLens& lens) { return lens.blades.count == 0 && !lens.square; }
bool HasBlades(const TiltLens& lens) { return lens.blades.count > 0; }
bool IsSquare(const TiltLens& lens) { return lens.square; }
bool HasBokeh(const TiltLens& lens) { return lens.bokeh; }
bool IsShifted(const TiltLens& lens) { return lens.shifted; }
bool IsFlat(const TiltLens& lens) { return !lens.Curves(); }
bool IsCurved(const TiltLens& lens) { return lens.Curves(); }
bool FallsOff(const TiltLens& lens) { return lens.natural_vignetting; }
bool HasRims(const TiltLens& lens) { return lens.rim_count > 0; }
/// The usual case, for which no ray has to ask.
bool HasOneRimBefore(const TiltLens& lens) { return lens.rim_count == 1 && !(lens.rims[0].distance < 0.0); }
bool HasOtherRims(const TiltLens& lens) { return HasRims(lens) && !HasOneRimBefore(lens) && !lens.aberrates; }
bool HasOtherRimsAberrated(const TiltLens& lens) { return HasRims(lens) && !HasOneRimBefore(lens) && lens.aberrates; }
bool AberratesThird(const TiltLens& lens) { return lens.aberrates && !lens.aberrates_fifth; }
bool AberratesFifth(const TiltLens& lens) { return lens.aberrates_fifth; }

/// All there is, in the order in which a ray meets it. Those without a name are the lens itself;
/// those without a step cost rays nothing here.
const struct
{
	std::string name;               ///< its word, by which statistics call it
	bool (*is_on)(const TiltLens& lens);
	LensStep step;
	bool moves_pinhole_rays;        ///< does something without an opening too
}
StepsInOrder[] =
{
	{ NameOf(Word::Shift), &IsShifted, NULL, false },       // of the window, once (lens_spec.cpp)
	{ NameOf(Word::PupilMagnification), &MagnifiesPupils, &PassPupils, true },
	{ NameOf(Word::LateralChromatic), &MagnifiesColours, &MagnifyColour, true },
	{ NameOf(Word::Distortion), &Distorts, &Undistort, true },
	{ "", &IsRound, &OpenDisc, false },
	{ NameOf(Word::Blades), &HasBlades, &OpenBlades, false },
	{ "", &IsSquare, &OpenSquare, false },
	{ "bokeh", &HasBokeh, NULL, false },        // POV-Ray's word; weighs the light when it is there (trace_tilt_lens.cpp)
	{ "", &IsFlat, &FocusOnPlane, false },
	{ NameOf(Word::FieldCurvature), &IsCurved, &FocusOnBowl, false },
	{ NameOf(Word::AxialChromatic), &FocusesColours, &FocusColour, false },
	{ "", &EveryLens, &LeaveLens, false },
	{ NameOf(Word::Aberrations), &AberratesThird, &AberrateThirdOrder, true },
	{ NameOf(Word::Aberrations), &AberratesFifth, &AberrateFifthOrder, true },
	{ NameOf(Word::NaturalVignetting), &FallsOff, &DarkenNaturally, true },
	{ NameOf(Word::OpticalVignetting), &HasOneRimBefore, &CutByRim, true },
	{ NameOf(Word::OpticalVignetting), &HasOtherRims, &CutByRims, true },
	{ NameOf(Word::OpticalVignetting), &HasOtherRimsAberrated, &CutByRimsAberrated, true }
};

void CopyEffectWords(const LensSpec& spec, TiltLens& lens)
{
	lens.distorts = spec.distortion_given;
	std::copy(spec.distortion, spec.distortion + DistortionTerms, lens.distortion);
	lens.field_curvature = spec.field_curvature.value;
	if(spec.blades)
		lens.blades = MakeBlades(int(spec.blades.value), spec.blade_rotation.value * Pi / 180.0, spec.blade_curvature.value);
	lens.bokeh = spec.bokeh && !lens.IsPinhole();
	lens.square = spec.bokeh && !spec.blades;
	lens.shifted = spec.shift.value.x != 0.0 || spec.shift.value.y != 0.0;
	lens.pupil_magnification = spec.pupil_magnification ? spec.pupil_magnification.value : 1.0;
	lens.natural_vignetting = spec.natural_vignetting;
	std::copy(spec.rims, spec.rims + spec.rim_count, lens.rims);
	lens.rim_count = spec.rim_count;
	std::copy(spec.lateral, spec.lateral + Wavelengths, lens.lateral);
	std::copy(spec.axial, spec.axial + Wavelengths, lens.axial);
	if(spec.aberrations_given)
		TakeAberrations(spec, lens);
}

static_assert(sizeof(StepsInOrder) / sizeof(StepsInOrder[0]) <= MostLensSteps, "raise MostLensSteps");

void SettleSteps(TiltLens& lens)
{
	int n = 0;
	for(const auto& effect : StepsInOrder)
	{
		if(effect.step == NULL || !effect.is_on(lens))
			continue;
		lens.steps[n++] = effect.step;
		lens.has_effects |= !effect.name.empty() || effect.step == &OpenSquare;
		lens.moves_pinhole_rays |= effect.moves_pinhole_rays;
	}
	lens.steps[n] = NULL;
	lens.weighs = FallsOff(lens) || HasRims(lens);
	lens.splits = MagnifiesColours(lens) || FocusesColours(lens);
}

}

void ResolveEffects(const LensSpec& spec, const CameraVectors& camera, TiltLens& lens)
{
	CheckEffectWords(spec);
	CopyEffectWords(spec, lens);
	if(lens.distorts)
		CheckDistortion(lens, camera);
	CheckFocus(lens, camera);
	CheckRims(lens);
	CheckFalloff(lens);
	SettleSteps(lens);
	if(lens.aberrates)
		CheckAberrations(camera, lens);
}

static std::string Listed(const std::string& names, const std::string& name)
{
	return names + (names.empty() ? "" : ", ") + name;
}

std::string EffectNames(const TiltLens& lens)
{
	std::string names;
	for(const auto& effect : StepsInOrder)
		if(!effect.name.empty() && effect.is_on(lens))
			names = Listed(names, effect.name);
	return names;
}

std::string IdleWords(const LensSpec& spec, const TiltLens& lens)
{
	const struct { bool given; std::string name; } words[] =
	{
		{ spec.field_curvature.value != 0.0 && !spec.show_plane, NameOf(Word::FieldCurvature) },
		{ spec.blades.given, NameOf(Word::Blades) },
		{ spec.bokeh, "bokeh" },
		{ spec.axial_given && FocusesColours(lens), NameOf(Word::AxialChromatic) },
		{ lens.aberrates && !AberratesPinholeRays(lens), NameOf(Word::Aberrations) },
		{ spec.denoise, NameOf(Word::Denoise) },
		{ spec.area_light_grid, NameOf(Word::AreaLightGrid) },
		{ spec.channels, NameOf(Word::Channels) },
		{ spec.show_focus, NameOf(Word::ShowFocus) }
	};
	std::string names;
	for(const auto& word : words)
		if(lens.IsPinhole() && word.given)
			names = Listed(names, word.name);
	return names;
}

}
