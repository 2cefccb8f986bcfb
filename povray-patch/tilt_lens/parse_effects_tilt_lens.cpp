// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Parsing of the words in camera { tilt_lens { ... } } that take options of their own.

#include <cstring>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/parser/parse.h"
#include "backend/scene/camera.h"
#include "backend/tilt_lens/bokeh.h"
#include "lens/words.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Given;
using tilt_lens::LensSpec;
using tilt_lens::RowOf;
using tilt_lens::Word;

/// Whether the current token is a word, as which the block's words arrive: a name, or what
/// the scene has declared under that name.
bool Parser::Is_Tilt_Lens_Word(const char *word)
{
	return ((Token.Token_Id == IDENTIFIER_TOKEN) || (Token.Data != NULL)) && (strcmp(Token.Token_String, word) == 0);
}

/// Whether the next token is the word, which is then consumed.
bool Parser::Accept_Tilt_Lens_Word(const char *word)
{
	Get_Token();
	if (Is_Tilt_Lens_Word(word))
		return true;
	Unget_Token();
	return false;
}

/// distortion K1 [, K2 ...]
void Parser::Parse_Tilt_Lens_Distortion(LensSpec& spec)
{
	Refuse_Tilt_Lens_Word_Twice(spec.distortion_given, Word::Distortion);
	spec.distortion_given = true;
	spec.distortion[0] = Parse_Float();
	for (int i = 1; i < tilt_lens::DistortionTerms; i++)
	{
		// Only a comma says that another coefficient follows: a number without one may be
		// the next word, under a name that the scene has declared.
		Get_Token();
		if (Token.Token_Id != COMMA_TOKEN)
		{
			Unget_Token();
			break;
		}
		spec.distortion[i] = Parse_Float();
	}
}

/// blades N [rotation A] [curvature C], in any order
void Parser::Parse_Tilt_Lens_Blades(LensSpec& spec)
{
	Refuse_Tilt_Lens_Word_Twice(spec.blades.given, Word::Blades);
	spec.blades = Parse_Float();
	while (true)
	{
		const bool rotation = Accept_Tilt_Lens_Word("rotation");
		if (!rotation && !Accept_Tilt_Lens_Word("curvature"))
			return;
		Given<double>& option = rotation ? spec.blade_rotation : spec.blade_curvature;
		if (option.given)
			Error("tilt_lens: %s of blades is given twice.", rotation ? "rotation" : "curvature");
		option = Parse_Float();
	}
}

/// vignetting natural, vignetting optical R, Z [, R, Z ...]; both may follow one word.
void Parser::Parse_Tilt_Lens_Vignetting(LensSpec& spec)
{
	bool known = false;

	while (true)
	{
		if (Accept_Tilt_Lens_Word(RowOf(Word::NaturalVignetting).option))
		{
			Refuse_Tilt_Lens_Word_Twice(spec.natural_vignetting, Word::NaturalVignetting);
			spec.natural_vignetting = true;
		}
		else if (Accept_Tilt_Lens_Word(RowOf(Word::OpticalVignetting).option))
		{
			if (spec.rim_count > 0)
				Error("tilt_lens: vignetting optical is given twice; give another rim behind a comma: optical R, Z, R, Z.");
			// As with distortion: only a comma says that another rim follows.
			do
			{
				if (spec.rim_count == tilt_lens::MostRims)
					Error("tilt_lens: vignetting optical takes at most %d rims.", tilt_lens::MostRims);
				tilt_lens::Rim& rim = spec.rims[spec.rim_count++];
				rim.radius = Parse_Float();
				Parse_Comma();
				rim.distance = Parse_Float();
				Get_Token();
			}
			while (Token.Token_Id == COMMA_TOKEN);
			Unget_Token();
		}
		else if (known)
			return;
		else
			Error("tilt_lens: vignetting takes natural, or optical with the radius of each rim and its distance before the lens.");
		known = true;
	}
}

/// chromatic [lateral CR, CB] [axial AR, AB], in any order
void Parser::Parse_Tilt_Lens_Chromatic(LensSpec& spec)
{
	static const struct { Word word; bool LensSpec::*given; double (LensSpec::*value)[tilt_lens::Wavelengths]; } kinds[] =
	{
		{ Word::LateralChromatic, &LensSpec::lateral_given, &LensSpec::lateral },
		{ Word::AxialChromatic, &LensSpec::axial_given, &LensSpec::axial }
	};
	bool known = false;

	while (true)
	{
		const bool lateral = Accept_Tilt_Lens_Word(RowOf(Word::LateralChromatic).option);
		if (!lateral && !Accept_Tilt_Lens_Word(RowOf(Word::AxialChromatic).option))
			break;
		const auto& kind = kinds[lateral ? 0 : 1];
		Refuse_Tilt_Lens_Word_Twice(spec.*kind.given, kind.word);
		known = spec.*kind.given = true;
		(spec.*kind.value)[tilt_lens::RedWavelength] = Parse_Float();
		Parse_Comma();
		(spec.*kind.value)[tilt_lens::BlueWavelength] = Parse_Float();
	}
	if (!known)
		Error("tilt_lens: chromatic takes lateral, axial or both, each with a value for red and one for blue.");
}

/// aberrations { [focal_length F] [f_stop N] [etendue] [spherical A] .. [fifth_order { A1, .., A10 }] }
void Parser::Parse_Tilt_Lens_Aberrations(LensSpec& spec)
{
	bool known[tilt_lens::ThirdOrderTerms + 1] = { false };

	Refuse_Tilt_Lens_Word_Twice(spec.aberrations_given, Word::Aberrations);
	spec.aberrations_given = true;
	Parse_Begin();
	while (true)
	{
		Get_Token();
		if (Token.Token_Id == RIGHT_CURLY_TOKEN)
			break;
		// spherical is one of POV-Ray's own words, the others are names like any other.
		if ((Token.Token_Id != SPHERICAL_TOKEN) && (Token.Token_Id != IDENTIFIER_TOKEN) && (Token.Data == NULL))
			Expectation_Error("'}' or one of the words of aberrations");
		const std::string word(Token.Token_String);
		Given<double> *number = (word == RowOf(Word::FocalLength).word) ? &spec.aberrations_focal_length :
		                        (word == RowOf(Word::FStop).word) ? &spec.aberrations_f_stop : NULL;
		if (number != NULL)
		{
			if (number->given)
				Error("tilt_lens: %s of aberrations is given twice.", word.c_str());
			*number = Parse_Float();
			continue;
		}
		if (word == tilt_lens::EtendueWord)
		{
			if (spec.aberrations_etendue)
				Error("tilt_lens: %s of aberrations is given twice.", word.c_str());
			spec.aberrations_etendue = true;
			continue;
		}
		int i = 0;
		while ((i <= tilt_lens::ThirdOrderTerms) && (word != tilt_lens::AberrationWords[i]))
			i++;
		if (i > tilt_lens::ThirdOrderTerms)
			Error("tilt_lens: %s", tilt_lens::AdviceOnAberrations(word).c_str());
		if (known[i])
			Error("tilt_lens: %s of aberrations is given twice.", word.c_str());
		known[i] = true;
		if (i < tilt_lens::ThirdOrderTerms)
			spec.aberrations[i] = Parse_Float();
		else
			Parse_Tilt_Lens_Fifth_Order(spec.aberrations + i);
	}
	Unget_Token();
	Parse_End();
}

/// fifth_order { A1, .., A10 }: all of them, so that none stands for another.
void Parser::Parse_Tilt_Lens_Fifth_Order(double *numbers)
{
	Parse_Begin();
	for (int i = 0; i < tilt_lens::FifthOrderTerms; i++)
	{
		Get_Token();
		Unget_Token();
		if (Token.Token_Id == RIGHT_CURLY_TOKEN)
			Error("tilt_lens: fifth_order takes %d numbers, with commas between, but has %d.", tilt_lens::FifthOrderTerms, i);
		numbers[i] = Parse_Float();
		Parse_Comma();
	}
	Get_Token();
	Unget_Token();
	if (Token.Token_Id != RIGHT_CURLY_TOKEN)
		Error("tilt_lens: fifth_order takes %d numbers, and has more.", tilt_lens::FifthOrderTerms);
	Parse_End();
}

/// Whether the next token begins a number: no word of the block, which may be the name of a value too.
bool Parser::Tilt_Lens_Number_Follows()
{
	Get_Token();
	Unget_Token();
	if (Token.Token_Id == FLOAT_FUNCT_TOKEN)
		return (Token.Function_Id != SEED_TOKEN) && ((Token.Data == NULL) || (tilt_lens::FindWord(Token.Token_String) == NULL));
	return (Token.Token_Id == LEFT_PAREN_TOKEN) || (Token.Token_Id == DASH_TOKEN) || (Token.Token_Id == PLUS_TOKEN);
}

/// show focus [WIDTH], show plane
void Parser::Parse_Tilt_Lens_Show(LensSpec& spec)
{
	Get_Token();
	// plane is one of POV-Ray's own words, focus a name like any other.
	if (Token.Token_Id == PLANE_TOKEN)
		spec.show_plane = true;
	else if (Is_Tilt_Lens_Word(RowOf(Word::ShowFocus).option))
	{
		spec.show_focus = true;
		if (Tilt_Lens_Number_Follows())
			spec.show_width = Parse_Float();
	}
	else
		Error("tilt_lens: show takes focus or plane.");
}

/// camera { bokeh { pigment { ... } } }: how much light it lets through, once the lens is resolved.
void Parser::Measure_Tilt_Lens_Bokeh(Camera& New)
{
	Post_Pigment(New.Bokeh);
	double *gain = New.Tilt_Lens.bokeh_gain;
	New.Tilt_Lens.bokeh_parts_colours = tilt_lens::MeasureBokehGain(New.Bokeh, New.Tilt_Lens.lens, GetParserDataPtr(), gain);
	if (!(gain[0] + gain[1] + gain[2] > 0.0))
		Error("tilt_lens: the bokeh pigment is black all over the lens, <0, 0> to <1, 1>; no light gets through.");
}

}
