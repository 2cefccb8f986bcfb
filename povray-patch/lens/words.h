// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The words of the tilt_lens block, each stated once. The parser looks them up here, and errors
// that list words, refusals of numbers and the names of effects in the statistics are made from
// here; tests hold REFERENCE.md and the fuzzer against it. Free of POV-Ray.

#ifndef TILT_LENS_WORDS_H
#define TILT_LENS_WORDS_H

#include <string>

#include "lens/lens_spec.h"

namespace tilt_lens
{

/// The rows of the table, in its order.
enum class Word
{
	FocalPlaneTilt, LensTilt, FocalPlane, FocalPoints, TiltDirection, FocalDistance,
	ImageDistance, FocalLength, Shift,
	ApertureDiameter, FStop,
	Distortion, FieldCurvature, Blades, NaturalVignetting, OpticalVignetting,
	LateralChromatic, AxialChromatic, PupilMagnification, Aberrations,
	Denoise, AreaLightGrid, Channels, Seed, ShowFocus, ShowPlane
};
const int WordCount = int(Word::ShowPlane) + 1;

/// What a number must be.
enum class Range
{
	Finite,
	Tilt,               ///< between -90 and 90 degrees
	Positive,
	NotNegative,
	Own                 ///< refused in words of its own (lens_spec.cpp, check_effects.h), or no single number
};

struct WordRow
{
	Word id;
	const char* word;
	const char* option;                 ///< the second word; empty where there is none
	const char* values;                 ///< what follows, as REFERENCE.md writes it
	Given<double> LensSpec::*number;    ///< where it goes, for words that take one number; else NULL
	Range range;
	const char* unit;
	const char* help;

	/// "focal_plane", "vignetting natural".
	std::string Name() const;
};

extern const WordRow Words[WordCount];

inline const WordRow& RowOf(Word word) { return Words[int(word)]; }
inline std::string NameOf(Word word) { return RowOf(word).Name(); }

/// The first row of a word, NULL where it is none of the block's.
const WordRow* FindWord(const std::string& word);

/// All words, each once, with commas between.
std::string ListOfWords();

/// The words of the block `aberrations`: those of its terms, in their order, with the one for the
/// fifth order last.
extern const char* const AberrationWords[ThirdOrderTerms + 1];
/// Without a value: etendue is conserved (lens/oblique_pupil.h).
extern const char* const EtendueWord;
extern const char* const FifthOrderWord;

/// What to do about a word that the block `aberrations` does not know.
std::string AdviceOnAberrations(const std::string& typed);

/// The word that was likely meant, empty where none is near: at most two letters left out,
/// added, changed or swapped, and less than half of it.
std::string WordLike(const std::string& typed);

/// What to do about a word that the block does not know: where it belongs, if it is one of
/// those around the block, or what was meant, or all there are.
std::string AdviceOn(const std::string& typed);

}

#endif
