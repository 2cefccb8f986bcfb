// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What photographs, board, light and the untilted state are found to be, and how far a calibration can be trusted.

#ifndef TILTCAL_CHECKS_H
#define TILTCAL_CHECKS_H

#include <tiltcal/api.h>
#include <tiltcal/estimate.h>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tiltcal
{

/// What the camera did to the light.
struct LightCheck
{
	double clipped_share = 0;   ///< of the edges: their bright side is at the file's white level
	Estimate sharpening;        ///< px^2: how much smaller squared blur diameters are than blur can make them
	Estimate overshoot;         ///< of light beside sharp edges, over their contrast: nothing where it was only blurred; NaN where too few are sharp, or their profiles were not kept
	/// How far blurred edges lie to the bright side of where the camera puts them, over their blur's radius: 0 in linear light.
	Estimate bend;
	std::vector<Estimate> bend_of_states;   ///< the same of each state; empty: too few photographs
	std::optional<Estimate> exponent;   ///< values that were this power of light would make this bend; none: no power would, or nothing is known
};

/// How well one photograph agrees with the rest.
struct PhotographCheck
{
	size_t state = 0, photo = 0, edges = 0;
	double rms_places = 0, rms_blur = 0;   ///< of its corners and of its edges' blur, px
	double places_typical = 0, blur_typical = 0;   ///< the same of the other photographs, their median, px
	std::optional<size_t> fits_state;      ///< its blur is that of this other state
	std::optional<std::pair<size_t, size_t>> same_as;   ///< state and photograph that was measured alike, noise and all
	bool odd_places = false, odd_blur = false;   ///< it stands out
	size_t stop = 0;   ///< Photo::stop
};

/// What the corners say of the board's shape: the same fit with a board that need not be as it was told. Nothing else uses it.
struct BoardCheck
{
	bool known = false;
	Estimate widening;             ///< columns over rows of its squares, minus 1; pixels that are not square look the same
	Estimate bend_along_columns, bend_along_rows, twist;   ///< height of the arc over the board's width and height, and of its corners, mm
	double rms_flat = 0, rms_free = 0;   ///< of the corners, px
	double w_change = 0;           ///< of the image distance, mm
};

/// RMS misfit of blur, px: with the plane of focus that the photographs of a state share, and with one for each photograph. Nothing else uses it.
struct FocusCheck
{
	bool known = false;
	double rms_together = 0, rms_apart = 0;
};

/// What blur says of the untilted state's tilt when it is let free.
struct UntiltedCheck
{
	bool known = false;
	Estimate lens_tilt, tilt_direction;   ///< degrees
	std::optional<StateLens> by_places;   ///< what the places of edges say of it, blur aside; none: nothing
};

enum class Grade
{
	GOOD,   ///< nothing speaks against it
	FAIR,   ///< the numbers hold within what the remarks say
	POOR    ///< photograph more before relying on it
};

/// "good", "fair", "poor".
TILTCAL_API const char* NameOf(Grade grade);

struct Remark
{
	Grade grade;
	std::string text;   ///< what, and what to photograph to mend it
};

/// How far a calibration can be trusted.
struct Verdict
{
	Grade grade = Grade::GOOD;   ///< the worst of the remarks
	std::vector<Remark> remarks;
};

}

#endif
