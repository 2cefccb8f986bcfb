// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera_blocks.h"

#include <cstdio>

#include "nasty_words.h"
#include "random.h"

namespace
{

struct FloatWord
{
	const char* word;
	double low, high;
};

const FloatWord LensFloats[] = {
	{"focal_plane_tilt", -89, 89}, {"lens_tilt", -60, 60}, {"tilt_direction", -360, 360}, {"focal_distance", -1, 20},
	{"image_distance", 0.1, 3}, {"focal_length", 0.1, 2}, {"aperture_diameter", 0, 2}, {"f_stop", 0.1, 22},
	{"field_curvature", -2, 2} };

// An effect: words, each followed by numbers with commas between them.
struct EffectPhrase
{
	const char* words;
	int numbers;
	double low, high;
	bool repeats;   // the numbers may follow again, behind a comma
};

const EffectPhrase Effects[] = {
	{"blades", 1, 2, 12, false}, {"rotation", 1, -360, 360, false}, {"curvature", 1, -0.5, 1.2, false}, {"vignetting natural", 0, 0, 0, false},
	{"vignetting optical", 2, -0.5, 3, true}, {"chromatic lateral", 2, -0.1, 0.1, false}, {"chromatic axial", 2, -0.5, 0.5, false},
	{"pupil_magnification", 1, 0.2, 4, false}, {"bokeh { pigment { rgb 1 } }", 0, 0, 0, false} };

// Tokens, so that they can be left out, doubled and swapped.
class Writer
{
	public:
		Writer(Random& r, double share) : random(r), nasty(share) {}

		std::vector<std::string> tokens;

		void Say(const std::string& token) { tokens.push_back(token); }

		void Number(double low, double high)
		{
			char text[32];
			if (random.Chance(nasty) && random.Chance(0.5))
			{
				// of any magnitude
				std::snprintf(text, sizeof(text), "%s%.3ge%d", random.Chance(0.2) ? "-" : "", random.Uniform(1, 10), random.Below(618) - 309);
				Say(text);
			}
			else if (random.Chance(nasty))
				Say(random.Chance(0.04) ? random.Pick(NotNumbers) : random.Pick(NastyNumbers));
			else if (!random.Chance(nasty / 8))
			{
				std::snprintf(text, sizeof(text), "%.4g", random.Uniform(low, high));
				Say(text);
			}
		}

		void Vector(double size)
		{
			if (random.Chance(nasty))
			{
				Say(random.Pick(NastyVectors));
				return;
			}
			Say("<");
			for (int i = 0; i < 3; i++)
			{
				Number(-size, size);
				Say(i < 2 ? "," : ">");
			}
		}

		// Near what the camera should see, so that pictures come out of it.
		void Around(double x, double y, double z, double size)
		{
			char text[80];
			std::snprintf(text, sizeof(text), "<%.4g,%.4g,%.4g>", x + random.Uniform(-size, size),
				y + random.Uniform(-size, size), z + random.Uniform(-size, size));
			if (random.Chance(nasty))
				Vector(5);
			else
				Say(text);
		}

		void PlaneWords(int which)
		{
			if (which < 2)
			{
				Say(LensFloats[which].word);
				Number(LensFloats[which].low, LensFloats[which].high);
				if (random.Chance(0.4))
				{
					Say("tilt_direction");
					Number(-360, 360);
				}
			}
			else if (which == 2)
			{
				Say("focal_plane");
				Around(0, 0, 1, 2);
				Say(",");
				Vector(1);
			}
			else
			{
				Say("focal_points");
				for (int i = 0; i < 3; i++)
				{
					if (i > 0)
						Say(",");
					Around(0, 0, 1, 3);
				}
			}
		}

		void LensWord(int which)
		{
			const int floats = int(sizeof(LensFloats) / sizeof(LensFloats[0]));
			if (which < floats)
			{
				Say(LensFloats[which].word);
				Number(LensFloats[which].low, LensFloats[which].high);
			}
			else if (which == floats)
			{
				Say("shift");
				Say("<");
				Number(-1, 1);
				Say(",");
				Number(-1, 1);
				Say(">");
			}
			else if (which == floats + 1)
			{
				Say("distortion");
				for (int i = 0, n = 1 + random.Below(6); i < n; i++)
				{
					if (i > 0)
						Say(",");
					Number(-0.1, 0.1);
				}
			}
			else if (which == floats + 2)
			{
				Say("show");
				Say(random.Chance(0.9) ? (random.Chance(0.5) ? "focus" : "plane") : random.Pick(Strays));
				if (random.Chance(0.3))
					Number(-100.0, 4000.0);     // a width, which only focus takes
			}
			else
				PlaneWords(2 + which % 2);
		}

		void Effect()
		{
			const EffectPhrase& effect = Effects[random.Below(int(sizeof(Effects) / sizeof(Effects[0])))];
			Say(effect.words);
			for (int i = 0, n = effect.numbers * (effect.repeats ? 1 + random.Below(5) : 1); i < n; i++)
			{
				if (i > 0)
					Say(",");
				Number(effect.low, effect.high);
			}
		}

		// Words of the block, numbers with and without commas where there are several.
		void Aberrations()
		{
			static const char* const words[] = { "focal_length", "f_stop", "spherical", "coma", "astigmatism", "curvature", "distortion", "pupil", "fifth_order", "etendue" };
			Say("aberrations");
			Say("{");
			for (int i = random.Below(6); i > 0; i--)
			{
				const int word = random.Below(10);
				Say(words[word]);
				if (word == 9)
					continue;
				if (word < 8)
					Number(word < 2 ? 0.5 : -5, 5);
				else
				{
					Say("{");
					for (int k = 0, n = random.Chance(0.9) ? 10 : random.Below(13); k < n; k++)
					{
						if (k > 0 && !random.Chance(0.02))
							Say(",");
						Number(-3, 3);
					}
					Say("}");
				}
			}
			Say("}");
		}

		void TiltLens()
		{
			Say("tilt_lens");
			if (random.Chance(0.05))
				return;
			Say("{");
			if (random.Chance(0.15))
				// anything goes with anything
				for (int i = random.Below(7); i > 0; i--)
					LensWord(random.Below(13));
			else
			{
				const int plane = random.Below(5);
				has_distance = plane < 2 ? random.Chance(0.5) : true;
				if (plane < 4)
					PlaneWords(plane);
				if (has_distance && (plane < 2 || plane == 4))
					LensWord(3);                            // focal_distance
				if (random.Chance(0.5))
					LensWord(random.Chance(0.5) ? 4 : 5);   // one of image_distance, focal_length
				has_aperture = random.Chance(0.6);
				if (has_aperture)
					LensWord(random.Chance(0.7) ? 6 : 7);   // one of aperture_diameter, f_stop
				for (int word = 8; word <= 11; word++)
					if (random.Chance(0.15))
						LensWord(word);                     // field_curvature, shift, distortion, show
				while (random.Chance(0.3))
					Effect();
				if (random.Chance(0.2))
					Aberrations();
				if (random.Chance(0.15))
					Say("denoise");
				if (random.Chance(0.1))
					Say("area_light_grid");
				if (random.Chance(0.1))
					Say("channels");
				if (random.Chance(0.1))
					Say(random.Chance(0.8) ? "seed 12" : "seed 1.5");
			}
			Say("}");
		}

		void BlurSamples()
		{
			// The second may be below the first, and neither may be large: see the header.
			static const char* const counts[] = {
				"0", "-5", "1", "2", "3", "7", "15", "16", "17", "33", "64", "100", "128", "1000", "4096", "0.5", "-1e308", "1e308", "1e400",
				"(1e308*1e308)", "((1e308*1e308)-(1e308*1e308))", "-0", "1e-310", "-2147483648", "-2147483649" };
			static const char* const usual[] = { "4", "7", "16", "37", "64", "100", "256" };
			Say("blur_samples");
			if (random.Chance(0.3))
			{
				Say(random.Chance(nasty) ? random.Pick(counts) : "4");
				Say(",");
			}
			Say(random.Chance(nasty) ? random.Pick(counts) : random.Pick(usual));
		}

		void Transformation()
		{
			switch (random.Below(8))
			{
				case 0: Say("translate"); Vector(2); break;
				case 1: Say("rotate"); Vector(40); break;
				case 2: Say("scale"); Number(0.1, 3); break;
				case 3: Say("scale"); Around(1, 1, 1, 0.5); break;
				case 4: Say("scale"); Say("<"); Number(-2, -1); Say(","); Number(0.5, 1); Say(","); Number(0.5, 1); Say(">"); break;
				case 5: Say("scale"); Say(nasty > 0.0 ? random.Pick(NastyNumbers) : "2"); break;
				case 6:
					Say("matrix");
					Say("<");
					for (int i = 0; i < 12; i++)
					{
						if (i > 0)
							Say(",");
						const double unit = i < 9 && i % 4 == 0 ? 1.0 : 0.0;
						Number(unit - 0.3, unit + 0.3);
					}
					Say(">");
					break;
				default:
					Say("transform");
					Say("{");
					Say(random.Chance(0.5) ? "rotate" : "scale");
					Around(1, 1, 1, 0.5);
					if (random.Chance(0.3))
						Say("inverse");
					Say("}");
			}
		}

		void CameraWord(int which)
		{
			switch (which)
			{
				case 0: Say("right"); Around(1.33, 0, 0, 0.2); break;
				case 1: Say("up"); Around(0, 1, 0, 0.2); break;
				case 2: Say("direction"); Around(0, 0, 1, 0.2); break;
				case 3: Say("sky"); Around(0, 1, 0, 0.3); break;
				case 4: Say("angle"); Number(1, 150); break;
				case 5: case 6:
					// what the block has said already contradicts these, which need not be seen often
					if (!has_aperture || random.Chance(0.1))
					{
						Say("aperture");
						Number(0, 2);
					}
					break;
				case 7:
					if (!has_distance || random.Chance(0.1))
					{
						Say("focal_point");
						Around(0, 0, 1, 2);
					}
					break;
				case 8: case 9: BlurSamples(); break;
				case 10: Say("variance"); Number(0, 0.01); break;
				case 11: Say("confidence"); Number(0.5, 1); break;
				case 12: Say("normal { bumps 0.1 scale 0.5 }"); break;
				case 13: Say("bokeh { pigment { rgb 0.7 } }"); break;
				case 14: Say("look_at"); Around(0, 0, 0, 1); break;
				default: Transformation();
			}
		}

		void Camera(bool copies)
		{
			Say("camera");
			Say("{");
			if (copies)
				Say(random.Chance(0.9) ? "Other" : "NoCamera");
			else if (random.Chance(0.97))
				TiltLens();
			else
				nasty = 0.0;    // stock makes pixels that are not finite of such cameras, which is its own affair
			if (random.Chance(copies ? 0.1 : 0.02))
				TiltLens();
			if (random.Chance(0.05))
				Say(random.Pick(OtherTypes));
			Say("\n");
			if (!copies || random.Chance(0.2))
			{
				Say("location");
				Around(0, 1, -5, 1);
			}
			if (random.Chance(0.05))
			{
				// what cannot be looked at
				Say(random.Chance(0.5) ? "location 0 look_at 0" : "look_at <0,5,-5> location <0,1,-5> sky y");
			}
			for (int i = random.Below(5); i > 0; i--)
			{
				CameraWord(random.Below(18));
				if (random.Chance(0.2))
					Say("\n");
			}
			if (random.Chance(0.6))
			{
				Say("look_at");
				Around(0, 0, 0, 1);
			}
			if (random.Chance(0.25))
				Transformation();
			Say("\n");
			Say("}");
			Say("\n");
		}

		// Leaves out, doubles, swaps and slips in tokens. What follows blur_samples stays what it is: see the header.
		void Damage()
		{
			const int at = random.Below(int(tokens.size()));
			for (int i = at - 5; i <= at + 2; i++)
				if (i >= 0 && i < int(tokens.size()) && tokens[std::size_t(i)] == "blur_samples")
					return;
			const auto token = tokens.begin() + at;
			switch (random.Below(5))
			{
				case 0: tokens.erase(token); break;
				case 1: tokens.insert(token, std::string(*token)); break;
				case 2: if (at > 0) std::swap(token[0], token[-1]); break;
				case 3: tokens.insert(token, random.Pick(Strays)); break;
				default: *token = random.Pick(Strays);
			}
		}

	private:
		Random& random;
		double nasty;   // share of numbers that are not usual ones
		bool has_aperture = false, has_distance = false;
};

const char* const World =
	"light_source { <3,5,-5>, 1 }\n"
	"sphere { 0, 1 pigment { rgb 0.8 } }\n"
	"plane { y, -1 pigment { checker rgb 0.2 rgb 0.7 } }\n"
	// fog makes pixels that are not numbers of rays that are not
	"fog { fog_type 2 distance 20 rgb 0.5 fog_offset 0 fog_alt 1 up y }\n"
	"background { rgb 0.5 }\n";

}

Block CameraBlock(std::uint64_t seed, std::uint64_t index)
{
	Random random(seed, index);
	static const double shares[] = { 0.0, 0.02, 0.06, 0.3 };
	Writer writer(random, shares[random.Below(4)]);

	const bool copies = random.Chance(0.15);
	if (copies)
	{
		writer.Say("#declare Other =");
		writer.Camera(false);
	}
	writer.Camera(copies);
	if (random.Chance(0.3))
		for (int i = 1 + random.Below(3); i > 0; i--)
			writer.Damage();

	static const char* const old_versions[] = { "3.1", "3.5", "3.6" };
	Block block;
	block.scene = std::string("#version ") + (random.Chance(0.93) ? "3.7" : random.Pick(old_versions)) + ";\n"
		"global_settings { assumed_gamma 1 }\n"
		"#declare Infinite = 1e308*1e308;\n#declare NotANumber = Infinite-Infinite;\n#declare Tiny = 1e-310;\n#declare Huge = 1e308;\n"
		"#declare Vector = <Infinite,NotANumber,0>;\n#declare NoCamera = 1;\n";
	const bool last = random.Chance(0.5);
	if (last)
		block.scene += World;
	for (const std::string& token : writer.tokens)
		block.scene += token == "\n" ? token : token + " ";
	block.scene += "\n";
	if (!last)
		block.scene += World;

	if (random.Chance(0.2))
		block.options.push_back("+UA");
	if (random.Chance(0.1))
		block.options.push_back("+A0.1");
	block.options.push_back(random.Chance(0.9) ? "+WT1" : "+WT2");
	return block;
}
