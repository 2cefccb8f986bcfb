// SPDX-License-Identifier: AGPL-3.0-or-later

#include "lens/words.h"

#include <algorithm>
#include <cctype>
#include <vector>

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
	{ Word::Aberrations, "aberrations", "", "{ … }", NULL, Range::Own, "f/1000",
	  "what a real lens does beside the ideal one's picture" },
	{ Word::Denoise, "denoise", "", "", NULL, Range::Own, "–",
	  "lets pixels learn from their neighbours" },
	{ Word::AreaLightGrid, "area_light_grid", "", "", NULL, Range::Own, "–",
	  "asks all points of an area light for every ray, as stock does" },
	{ Word::Channels, "channels", "", "", NULL, Range::Own, "–",
	  "adds depth, blur width, samples and error to an OpenEXR file" },
	{ Word::Seed, "seed", "", "N", &LensSpec::seed, Range::Own, "–",
	  "which of the equally good sets of samples to take" },
	{ Word::ShowFocus, "show", "focus", "[WIDTH]", NULL, Range::Own, "pixels",
	  "paints over the scene what is sharp, in pixels of a picture WIDTH wide" },
	{ Word::ShowPlane, "show", "plane", "", NULL, Range::Own, "–",
	  "paints the plane of focus over the scene" }
};

const char* const AberrationWords[ThirdOrderTerms + 1] =
	{ "spherical", "coma", "astigmatism", "curvature", "distortion", "pupil", "fifth_order" };
const char* const FifthOrderWord = AberrationWords[ThirdOrderTerms];
const char* const EtendueWord = "etendue";

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

namespace
{

/// Words of the camera around the block, some of them often written inside it.
const char* const WordsAround[] = {
	"location", "look_at", "right", "up", "direction", "angle", "sky", "translate", "rotate", "scale", "transform", "matrix",
	"aperture", "focal_point", "blur_samples", "variance", "confidence", "bokeh", "normal" };

/// Words of options, where the word before them is left out.
const struct { const char *option, *word; } Options[] = {
	{ "natural", "vignetting" }, { "optical", "vignetting" }, { "lateral", "chromatic" }, { "axial", "chromatic" },
	{ "rotation", "blades" }, { "curvature", "blades" }, { "focus", "show" }, { "spherical", "aberrations" }, { "coma", "aberrations" },
	{ "astigmatism", "aberrations" }, { "pupil", "aberrations" }, { "fifth_order", "aberrations" },
	{ EtendueWord, "aberrations" } };

/// Letters to leave out, add, change or swap with the next, to make one of the other.
size_t Edits(const std::string& a, const std::string& b)
{
	std::vector<std::vector<size_t> > d(a.size() + 1, std::vector<size_t>(b.size() + 1));
	for(size_t i = 0; i <= a.size(); i++)
		for(size_t j = 0; j <= b.size(); j++)
		{
			if(i == 0 || j == 0)
			{
				d[i][j] = i + j;
				continue;
			}
			d[i][j] = std::min(std::min(d[i - 1][j], d[i][j - 1]) + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1]));
			if(i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
				d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
		}
	return d[a.size()][b.size()];
}

/// Case is no mistake of letters.
std::string Folded(const std::string& word)
{
	std::string folded;
	for(char c : word)
		folded += char(std::tolower((unsigned char)c));
	return folded;
}

}

namespace
{

/// Of the words that are offered, the one that was likely meant.
class Nearest
{
	public:
		std::string best;

		explicit Nearest(const std::string& typed) : folded(Folded(typed)) {}

		void Consider(const std::string& word)
		{
			const size_t edits = Edits(folded, word);
			if(edits < least && 2 * edits < word.size())
			{
				least = edits;
				best = word;
			}
		}
	private:
		std::string folded;
		size_t least = 3;
};

/// What stands before an option.
std::string BeforeOption(const std::string& word)
{
	return word + (word == NameOf(Word::Blades) ? " 5 " : word == NameOf(Word::Aberrations) ? " { " : " ");
}

}

std::string WordLike(const std::string& typed)
{
	Nearest nearest(typed);
	for(const WordRow& row : Words)
		nearest.Consider(row.word);
	for(const char* word : WordsAround)
		nearest.Consider(word);
	return nearest.best;
}

std::string AdviceOnAberrations(const std::string& typed)
{
	std::string list = RowOf(Word::FocalLength).Name() + ", " + RowOf(Word::FStop).Name();
	Nearest nearest(typed);
	nearest.Consider(NameOf(Word::FocalLength));
	nearest.Consider(NameOf(Word::FStop));
	for(const char* word : AberrationWords)
	{
		nearest.Consider(word);
		list += ", " + std::string(word);
	}
	nearest.Consider(EtendueWord);
	list += ", " + std::string(EtendueWord);
	const std::string unknown = "Unknown word '" + typed + "' in aberrations";
	if(!nearest.best.empty())
		return unknown + "; did you mean '" + nearest.best + "'?";
	if(FindWord(typed) != NULL)
		return "'" + typed + "' is no word of aberrations; is their '}' missing before it?";
	return unknown + "; the words are " + list + ".";
}

std::string AdviceOn(const std::string& typed)
{
	const auto is = [&](const char* word) { return typed == word; };
	const auto belongs_around = [](const std::string& word)
	{
		return "'" + word + "' belongs outside the tilt_lens block, behind its '}'; is that missing?";
	};
	if(std::any_of(std::begin(WordsAround), std::end(WordsAround), is))
		return belongs_around(typed);
	for(const auto& o : Options)
		if(typed == o.option)
			return "'" + typed + "' follows the word " + o.word + ", as in '" + BeforeOption(o.word) + typed + "'.";
	const std::string like = WordLike(typed);
	if(like.empty())
		return "Unknown word '" + typed + "' in the tilt_lens block; the words are " + ListOfWords() + ".";
	if(FindWord(like) == NULL)
		return "Unknown word '" + typed + "' in the tilt_lens block; if '" + like + "' was meant: " + belongs_around(like);
	return "Unknown word '" + typed + "' in the tilt_lens block; did you mean '" + like + "'?";
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
