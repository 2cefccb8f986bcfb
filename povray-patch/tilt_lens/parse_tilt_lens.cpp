// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Parsing of camera { tilt_lens { ... } }. The words of the block are not
// reserved: they are identifiers to the tokenizer and are told apart here, so
// that scenes which use focal_length or shift as names of their own still parse.

#include <cctype>
#include <cstdlib>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/parser/parse.h"
#include "backend/math/chi2.h"
#include "backend/math/vector.h"
#include "backend/scene/camera.h"
#include "backend/tilt_lens/camera_vectors.h"
#include "backend/tilt_lens/denoised_picture.h"
#include "backend/tilt_lens/pilot_queue.h"
#include "backend/tilt_lens/shown_labels.h"
#include "backend/tilt_lens/tile_borders.h"
#include "lens/effects.h"
#include "lens/lens_channels.h"
#include "lens/words.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

using tilt_lens::Given;
using tilt_lens::LensSpec;
using tilt_lens::Vec3d;
using tilt_lens::Word;

// Samples per pixel where the scene gives an aperture but no blur_samples.
static const int Default_Blur_Samples = 128;

/// tilt_lens [ { WORDS } ]
void Parser::Parse_Tilt_Lens(Camera& New)
{
	if (New.Tilt_Lens.spec.enabled && !New.Tilt_Lens.finished)
		Error("A camera has only one tilt_lens block.");
	// That of #default.
	New.Tilt_Lens = tilt_lens::CameraLens();
	if (New.Type != PERSPECTIVE_CAMERA)
		Error("tilt_lens is a camera type of its own and cannot be combined with another.");
	New.Tilt_Lens.spec.enabled = true;

	Get_Token();
	Unget_Token();
	if (Token.Token_Id != LEFT_CURLY_TOKEN)
	{
		if ((Token.Token_Id == IDENTIFIER_TOKEN) && (tilt_lens::FindWord(Token.Token_String) != NULL))
			Error("tilt_lens: the { of its block is missing before '%s'.", Token.Token_String);
		return;
	}

	Parse_Begin();
	while (true)
	{
		Get_Token();
		if (Token.Token_Id == RIGHT_CURLY_TOKEN)
			break;
		Parse_Tilt_Lens_Word(New);
	}
	Unget_Token();
	Parse_End();
}

/// camera { DECLARED tilt_lens [ { WORDS } ] TRANSFORMATIONS }: another lens in the place of the declared camera's.
void Parser::Parse_Tilt_Lens_Anew(Camera& New)
{
	const LensSpec before = New.Tilt_Lens.spec;

	if (!before.enabled)
		Error("The declared camera is no tilt_lens camera, and has no lens that tilt_lens could replace.\n"
		      "Begin its declaration with tilt_lens, even without words.");
	Parse_Tilt_Lens(New);
	New.Tilt_Lens.spec.Take_Words_Around(before);
}

/// One word of the block, which is the current token, and its value.
void Parser::Parse_Tilt_Lens_Word(Camera& New)
{
	LensSpec& spec = New.Tilt_Lens.spec;
	VECTOR v;
	UV_VECT uv;

	// seed is one of POV-Ray's own words, a function.
	const bool is_seed = (Token.Token_Id == FLOAT_FUNCT_TOKEN) && (Token.Function_Id == SEED_TOKEN);
	// A name that the scene has declared arrives as that value's token.
	const bool is_name = (Token.Token_Id == IDENTIFIER_TOKEN) || (Token.Data != NULL);
	if (!is_seed && !is_name)
		Refuse_Tilt_Lens_Token();
	const std::string word(is_seed ? tilt_lens::NameOf(Word::Seed) : Token.Token_String);
	const tilt_lens::WordRow *row = tilt_lens::FindWord(word);
	if (row == NULL)
		Error("tilt_lens: %s", tilt_lens::AdviceOn(word).c_str());

	if (row->number != NULL)
	{
		Given<double>& value = spec.*row->number;
		Refuse_Tilt_Lens_Word_Twice(value.given, row->id);
		value = Parse_Float();
		return;
	}

	switch (row->id)
	{
		case Word::FocalPlane:
			Refuse_Tilt_Lens_Word_Twice(spec.focal_plane_point.given, row->id);
			Parse_Tilt_Lens_Vector(v, 3, row->id);
			spec.focal_plane_point = From_Vector(v);
			Parse_Comma();
			Parse_Tilt_Lens_Vector(v, 3, row->id);
			spec.focal_plane_normal = From_Vector(v);
			break;
		case Word::FocalPoints:
			Refuse_Tilt_Lens_Word_Twice(spec.focal_points[0].given, row->id);
			for (int i = 0; i < 3; i++)
			{
				if (i > 0)
					Parse_Comma();
				Parse_Tilt_Lens_Vector(v, 3, row->id);
				spec.focal_points[i] = From_Vector(v);
			}
			break;
		case Word::Shift:
			Refuse_Tilt_Lens_Word_Twice(spec.shift.given, row->id);
			Parse_Tilt_Lens_Vector(uv, 2, row->id);
			spec.shift = Vec3d{ uv[U], uv[V], 0.0 };
			break;
		case Word::Distortion:
			Parse_Tilt_Lens_Distortion(spec);
			break;
		case Word::Blades:
			Parse_Tilt_Lens_Blades(spec);
			break;
		// The first row stands for the word, whichever option follows.
		case Word::NaturalVignetting:
			Parse_Tilt_Lens_Vignetting(spec);
			break;
		case Word::LateralChromatic:
			Parse_Tilt_Lens_Chromatic(spec);
			break;
		case Word::Aberrations:
			Parse_Tilt_Lens_Aberrations(spec);
			break;
		case Word::Denoise:
			spec.denoise = true;
			break;
		case Word::AreaLightGrid:
			spec.area_light_grid = true;
			break;
		case Word::Channels:
			spec.channels = true;
			break;
		case Word::ShowFocus:
			Parse_Tilt_Lens_Show(spec);
			break;
		default:
			Error("tilt_lens: %s has a row in the table of words and nothing that parses it.", row->word);
	}
}

/// What is no word at all: one of POV-Ray's own, or a sign.
void Parser::Refuse_Tilt_Lens_Token()
{
	if (Token.Token_Id == SEMI_COLON_TOKEN)
		Error("tilt_lens: no ';' stands between the words of the block.");
	if (Token.Token_Id == COMMA_TOKEN)
		Error("tilt_lens: one value too many, or a ',' between words: words are told apart by their names alone.");
	if ((Token.Token_String != NULL) && (isalpha(Token.Token_String[0])))
		Error("tilt_lens: %s", tilt_lens::AdviceOn(Token.Token_String).c_str());
	Expectation_Error(("'}' or one of the words of tilt_lens: " + tilt_lens::ListOfWords()).c_str());
}

/// A vector of as many terms. A number, which would stand for all of them, is but a slip here;
/// 0 is not.
void Parser::Parse_Tilt_Lens_Vector(DBL *v, int terms, tilt_lens::Word word)
{
	EXPRESS express;
	const int found = Parse_Unknown_Vector(express);

	if ((found == 1) && (express[0] == 0.0))
		express[1] = express[2] = 0.0;
	else if (found == 1)
		Error("tilt_lens: %s takes %s, but %g is a number.", tilt_lens::NameOf(word).c_str(),
		      terms == 2 ? "a vector such as <0, 1>" : "vectors such as <0, 1, 5>", express[0]);
	else if (found != terms)
		Error("tilt_lens: %s takes %s, but this one has %d terms.", tilt_lens::NameOf(word).c_str(),
		      terms == 2 ? "a vector such as <0, 1>" : "vectors such as <0, 1, 5>", found);
	for (int i = 0; i < terms; i++)
		v[i] = express[i];
}

/// POV-Ray's own blur_samples [MIN,] MAX. Its numbers go into an int, which more would overflow.
void Parser::Parse_Tilt_Lens_Blur_Samples(Camera& New)
{
	const DBL most = 1 << 30;
	DBL samples[2];

	samples[0] = Parse_Float();
	Parse_Comma();
	samples[1] = Allow_Float(0.0);
	for (int i = 0; i < 2; i++)
		if (!((samples[i] >= 1.0) && (samples[i] <= most)) && ((i == 0) || (samples[i] != 0.0)))
			Error("Illegal number of focal blur samples: %g. With tilt_lens it must lie between 1 and %.0f.", samples[i], most);
	if ((samples[1] != 0.0) && (samples[0] > samples[1]))
		Error("Focal blur samples minimum must not be larger than maximum.");
	New.Blur_Samples_Min = samples[1] != 0.0 ? int(samples[0]) : 0;
	New.Blur_Samples = samples[1] != 0.0 ? int(samples[1]) : int(samples[0]);
}

/// Refuses a word that has been given already.
void Parser::Refuse_Tilt_Lens_Word_Twice(bool given, tilt_lens::Word word)
{
	if (given)
		Error("tilt_lens: %s is given twice.", tilt_lens::NameOf(word).c_str());
}

/// Says which words do nothing, and what a picture file would lose.
void Parser::Warn_Of_Idle_Tilt_Lens_Words(const Camera& New)
{
	const tilt_lens::TiltLens& lens = New.Tilt_Lens.lens;
	const std::string idle = tilt_lens::IdleWords(New.Tilt_Lens.spec, lens);

	if (!idle.empty())
		Warning(0, "tilt_lens: without an aperture everything is sharp, and this does nothing: %s.\n"
		           "Give aperture_diameter or f_stop, or leave it out.", idle.c_str());
	if (New.Tilt_Lens.spec.denoise && New.Tilt_Lens.Samples_Lens() && (New.Blur_Samples == 1))
		Warning(0, "tilt_lens: denoise compares the halves of a pixel's samples, and blur_samples 1 has none: it does nothing.");
	if (New.Tilt_Lens.spec.channels && (sceneData->defaultFileType != kPOVList_FileType_OpenEXR))
		Warning(0, "tilt_lens: channels are written into OpenEXR files only: give +FE.");
	if (sceneData->outputAlpha && (sceneData->defaultFileType != kPOVList_FileType_OpenEXR) && (lens.splits || New.Tilt_Lens.bokeh_parts_colours))
		Warning(0, "tilt_lens: colours that part at the edge of what is transparent are brighter than their alpha,\n"
		           "which this file format clips. Write OpenEXR (+FE), or render without alpha (-UA).");
}

/// The lens from the words and the camera's final vectors; parse errors for
/// words that contradict each other and for planes that no lens can focus.
void Parser::Resolve_Tilt_Lens(Camera& New)
{
	std::string error;

	if (New.Type != PERSPECTIVE_CAMERA)
		Error("tilt_lens is a camera type of its own and cannot be combined with another.");
	New.Tilt_Lens.spec.bokeh = (New.Bokeh != NULL);
	New.Tilt_Lens.finished = true;
	if (!tilt_lens::ResolveTiltLens(New.Tilt_Lens.spec, Vectors_Of(New), New.Tilt_Lens.lens, error))
	{
		// A declared camera is yet to be moved to where its planes and points of the world can be focused.
		if (&New != &sceneData->parsedCamera)
			return;
		Error("%s", error.c_str());
	}
	New.Tilt_Lens.vectors = Vectors_Of(New);
	if (New.Bokeh != NULL)
		Measure_Tilt_Lens_Bokeh(New);
	if (!New.Tilt_Lens.spec.right_given && New.Tilt_Lens.spec.Sensor_Is_Window())
	{
		// Almost certainly not what was meant: a window 1.33 wide at, say, 50.
		DBL width;
		VLength(width, New.Right);
		Warning(0, "tilt_lens: the sensor is what right and up span, %g wide, at image distance %g: a view of %.3g degrees.\n"
		           "Give right and up the sensor's size, or the field of view with angle.",
		           width, New.Tilt_Lens.lens.image_distance,
		           2.0 * atan2(0.5 * width, New.Tilt_Lens.lens.image_distance) / M_PI_180);
	}
	Warn_Of_Idle_Tilt_Lens_Words(New);
	if (New.Tilt_Lens.Samples_Lens() && (New.Blur_Samples <= 0))
		New.Blur_Samples = Default_Blur_Samples;
	New.Tilt_Lens.levels = tilt_lens::SampleLevels(New.Blur_Samples_Min, New.Blur_Samples, New.Variance, New.Confidence, &chdtri);
	New.Tilt_Lens.borders = boost::shared_ptr<tilt_lens::TileBorders>(new tilt_lens::TileBorders());
	if (New.Tilt_Lens.spec.show_focus && !New.Tilt_Lens.lens.IsPinhole())
		New.Tilt_Lens.labels = boost::shared_ptr<tilt_lens::ShownLabels>(new tilt_lens::ShownLabels());
	if (New.Tilt_Lens.spec.denoise)
		New.Tilt_Lens.denoised = boost::shared_ptr<tilt_lens::DenoisedPicture>(new tilt_lens::DenoisedPicture());
	if (New.Tilt_Lens.spec.channels)
		New.Tilt_Lens.channels.reset(new tilt_lens::LensChannels());
	New.Tilt_Lens.pilot = tilt_lens::PilotOfEnvironment();
	if (New.Tilt_Lens.pilot)
		New.Tilt_Lens.pilot_queue = boost::shared_ptr<tilt_lens::PilotQueue>(new tilt_lens::PilotQueue(New.Tilt_Lens.pilot));
}

}
