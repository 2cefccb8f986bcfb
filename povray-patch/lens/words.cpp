// SPDX-License-Identifier: AGPL-3.0-or-later

#include "lens/words.h"

namespace tilt_lens
{

const WordRow Words[WordCount] =
{
	{ Word::FocalPlaneTilt, "focal_plane_tilt", "", "A", &LensSpec::focal_plane_tilt, Range::Tilt, "degrees",
	  "angle between the plane of focus and the sensor" },
	{ Word::LensTilt, "lens_tilt", "", "A", &LensSpec::lens_tilt, Range::Tilt, "degrees",
	  "angle between the lens and the sensor; the plane of focus follows" },
	{ Word::FocalPlane, "focal_plane", "", "P, N", NULL, Range::Own, "world",
	  "the plane of focus by a point and its normal" },
	{ Word::FocalPoints, "focal_points", "", "P1, P2, P3", NULL, Range::Own, "world",
	  "the plane of focus by three points" },
	{ Word::TiltDirection, "tilt_direction", "", "PHI", &LensSpec::tilt_direction, Range::Finite, "degrees",
	  "where a tilted plane of focus recedes to: 0 up, 90 right" },
	{ Word::FocalDistance, "focal_distance", "", "U", &LensSpec::focal_distance, Range::Own, "world",
	  "distance of the plane of focus along the axis" },
	{ Word::ImageDistance, "image_distance", "", "W", &LensSpec::image_distance, Range::Positive, "world",
	  "distance of the sensor from the lens centre" },
	{ Word::FocalLength, "focal_length", "", "F", &LensSpec::focal_length, Range::Positive, "world",
	  "focal length of the lens; the image distance follows" },
	{ Word::Shift, "shift", "", "<SX, SY>", NULL, Range::Own, "unit of W",
	  "moves the picture over the lens's image" },
	{ Word::ApertureDiameter, "aperture_diameter", "", "D", &LensSpec::aperture_diameter, Range::NotNegative, "world",
	  "diameter of the opening" },
	{ Word::FStop, "f_stop", "", "N", &LensSpec::f_stop, Range::Positive, "–",
	  "diameter of the opening as f/N" },
	{ Word::Distortion, "distortion", "", "K1, K2, P1, P2, K3", NULL, Range::Own, "–",
	  "Brown-Conrady distortion, from the ideal to the image point" },
	{ Word::FieldCurvature, "field_curvature", "", "C", &LensSpec::field_curvature, Range::Own, "1/world",
	  "bends the plane of focus to a bowl about the lens's axis" },
	{ Word::Blades, "blades", "", "N [rotation A] [curvature C]", NULL, Range::Own, "–, degrees, –",
	  "makes the opening a polygon" },
	{ Word::NaturalVignetting, "vignetting", "natural", "", NULL, Range::Own, "–",
	  "darkens off the axis, as a lens without a rim does" },
	{ Word::OpticalVignetting, "vignetting", "optical", "R, Z [, R, Z …]", NULL, Range::Own, "world",
	  "more rims beside the aperture, radius R at Z before the lens" },
	{ Word::LateralChromatic, "chromatic", "lateral", "CR, CB", NULL, Range::Own, "–",
	  "images of red and blue of another size than green's" },
	{ Word::AxialChromatic, "chromatic", "axial", "AR, AB", NULL, Range::Own, "1/world",
	  "red and blue in focus elsewhere than green" },
	{ Word::PupilMagnification, "pupil_magnification", "", "M", &LensSpec::pupil_magnification, Range::Own, "–",
	  "size of the exit pupil over that of the entrance pupil" },
	{ Word::Denoise, "denoise", "", "", NULL, Range::Own, "–",
	  "lets pixels learn from their neighbours" },
	{ Word::Seed, "seed", "", "N", &LensSpec::seed, Range::Own, "–",
	  "which of the equally good sets of samples to take" },
	{ Word::ShowFocus, "show", "focus", "", NULL, Range::Own, "–",
	  "paints over the scene what is sharp" },
	{ Word::ShowPlane, "show", "plane", "", NULL, Range::Own, "–",
	  "paints the plane of focus over the scene" }
};

std::string WordRow::Name() const
{
	return option[0] != '\0' ? word + (" " + std::string(option)) : word;
}

const WordRow* FindWord(const std::string& word)
{
	for(const WordRow& row : Words)
		if(word == row.word)
			return &row;
	return NULL;
}

std::string ListOfWords()
{
	std::string list;
	for(const WordRow& row : Words)
		if(FindWord(row.word) == &row)
			list += (list.empty() ? "" : ", ") + std::string(row.word);
	return list;
}

}
