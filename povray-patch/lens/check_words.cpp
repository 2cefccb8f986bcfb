// SPDX-License-Identifier: AGPL-3.0-or-later

#include "lens/check_words.h"

#include <cmath>

#include "lens/refusal.h"
#include "lens/words.h"

namespace tilt_lens
{

namespace
{

void RequireFinite(const char* word, const Given<double>& value)
{
	if(value && !IsFinite(value.value))
		Refuse("tilt_lens: %s is not a finite number.", word);
}

void RequirePositive(const char* word, const Given<double>& value)
{
	RequireFinite(word, value);
	if(value && !(value.value > 0.0))
		Refuse("tilt_lens: %s must be greater than 0, but is %g.", word, value.value);
}

void RequireFinite(const char* word, const Vec3d& value)
{
	if(!IsFinite(value))
		Refuse("tilt_lens: %s is not a finite vector.", word);
}

void RequireTilt(const char* word, const Given<double>& value)
{
	RequireFinite(word, value);
	if(value && !(std::fabs(value.value) < 90.0))
		Refuse("tilt_lens: %s must lie between -90 and 90 degrees, but is %g; "
		       "state such a plane with focal_plane or focal_points.", word, value.value);
}

void RequireNotNegative(const char* word, const Given<double>& value)
{
	RequireFinite(word, value);
	if(value && value.value < 0.0)
		Refuse("tilt_lens: %s must not be negative, but is %g.", word, value.value);
}

const struct
{
	Range range;
	void (*require)(const char* word, const Given<double>& value);
}
RangeChecks[] =
{
	{ Range::Tilt, &RequireTilt },
	{ Range::Finite, &RequireFinite },
	{ Range::Positive, &RequirePositive },
	{ Range::NotNegative, &RequireNotNegative }
};

void CheckRanges(const LensSpec& spec)
{
	// By ranges: of several numbers that no lens has, the tilt is named first.
	for(const auto& check : RangeChecks)
		for(const WordRow& row : Words)
			if(row.number != NULL && row.range == check.range)
				check.require(row.word, spec.*row.number);
	if(!IsFinite(spec.aperture))
		Refuse("tilt_lens: aperture is not a finite number.");
	if(spec.shift)
		RequireFinite("shift", spec.shift.value);
	if(spec.focal_distance && std::isnan(spec.focal_distance.value))
		Refuse("tilt_lens: focal_distance is not a number; for a plane at infinity write a large one, such as 1e30.");
	if(spec.focal_distance && spec.focal_distance.value == 0.0)
		Refuse("tilt_lens: focal_distance must not be 0: the plane of focus would pass through the lens centre.");
	if(spec.seed && !((spec.seed.value >= 0.0) && (spec.seed.value <= 4294967295.0) && (spec.seed.value == std::floor(spec.seed.value))))
		Refuse("tilt_lens: seed must be a whole number from 0 to 4294967295, but is %g.", spec.seed.value);
	if(spec.show_width && !(spec.show_width.value >= 1.0 && spec.show_width.value <= 1e6))
		Refuse("tilt_lens: the width behind show focus is that of the picture to come, from 1 to 1e6 pixels, but is %g.", spec.show_width.value);
	if(spec.focal_point)
		RequireFinite("focal_point", spec.focal_point.value);
	if(spec.focal_plane_point)
	{
		RequireFinite("focal_plane's point", spec.focal_plane_point.value);
		RequireFinite("focal_plane's normal", spec.focal_plane_normal);
		if(!(MaxAbs(spec.focal_plane_normal) > 0.0))
			Refuse("tilt_lens: focal_plane's normal must not be <0, 0, 0>.");
	}
	for(int i = 0; i < 3; i++)
		if(spec.focal_points[i])
			RequireFinite("focal_points", spec.focal_points[i].value);
}

void CheckContradictions(const LensSpec& spec)
{
	const bool tilts = spec.focal_plane_tilt || spec.lens_tilt;
	const bool whole_plane = spec.focal_plane_point || spec.focal_points[0];
	const int planes = int(spec.focal_plane_tilt.given) + int(spec.lens_tilt.given) +
	                   int(spec.focal_plane_point.given) + int(spec.focal_points[0].given);

	if(planes > 1)
		Refuse("tilt_lens: focal_plane_tilt, lens_tilt, focal_plane and focal_points each state the plane of focus; give one of them.");
	if(whole_plane && spec.focal_distance)
		Refuse("tilt_lens: focal_distance contradicts focal_plane or focal_points, which already fix the distance.");
	if(whole_plane && spec.focal_point)
		Refuse("tilt_lens: focal_point contradicts focal_plane or focal_points, which already fix the plane of focus.");
	if(spec.focal_distance && spec.focal_point)
		Refuse("tilt_lens: focal_distance and focal_point both fix the distance of the plane of focus; give one of them.");
	if(spec.tilt_direction && !tilts)
		Refuse("tilt_lens: tilt_direction needs focal_plane_tilt or lens_tilt.");
	if(spec.image_distance && spec.focal_length && spec.lens_tilt && (spec.focal_distance || spec.focal_point))
		Refuse("tilt_lens: lens_tilt, focal_length and image_distance already fix the plane of focus; leave out focal_distance or focal_point.");
	if(spec.image_distance && spec.focal_length && !spec.lens_tilt)
		Refuse("tilt_lens: image_distance follows from focal_length and the plane of focus; give one of the two.");
	if(spec.aperture_diameter && spec.f_stop)
		Refuse("tilt_lens: aperture_diameter and f_stop both state the aperture; give one of them.");
	if((spec.aperture_diameter || spec.f_stop) && spec.aperture != 0.0)
		Refuse("tilt_lens: aperture contradicts aperture_diameter or f_stop; give one of them.");
}

}

void CheckWords(const LensSpec& spec)
{
	CheckRanges(spec);
	CheckContradictions(spec);
}

}
