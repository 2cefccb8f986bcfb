// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The one point of an area light that a lens sample asks has the mean of stock's whole grid.
//
//   area_lights CASE --stock POVRAY --ours POVRAY --work DIR
//
// Stock renders a pinhole picture of Sub x Sub pixels for every pixel, without `adaptive`, which only approximates that mean;
// ours renders through an opening too small to blur, with several seeds. Means of blocks of pixels are compared in units
// of their own standard errors: ours from the seeds, stock's from the differences of neighbouring sub-pixels, which hold
// jitter and where edges fall between sub-pixels.
//
// Exit 0: alike, 1: not, 2: wrong usage or a program failed.
#include "support/case_options.h"
#include "support/picture.h"
#include "support/run_povray.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

namespace
{

namespace fs = std::filesystem;

const int Width = 64, Height = 48, Sub = 8, Block = 8, Seeds = 8, Samples = 128;

struct Case
{
	std::string name;
	std::string light;   // options of the area light
	std::string more;    // objects
};

// Odd sizes: rows that weigh twice as much as others. All with a rod before the light, thinner than the light's points are apart.
const Case cases[] = {
	{"grid", "area_light <2, 0, 0>, <0, 0, 1.4>, 3, 5", ""},
	{"adaptive", "area_light <2, 0, 0>, <0, 0, 2>, 9, 6 adaptive 1", ""},
	{"jitter", "area_light <2, 0, 0>, <0, 0, 2>, 4, 3 jitter", ""},
	{"circular", "area_light <2, 0, 0>, <0, 0, 2>, 5, 5 circular orient jitter", ""},
	{"illumination", "area_light <2, 0, 0>, <0, 0, 2>, 4, 4 area_illumination", ""},
	{"mirror", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4", "plane { z, 2.5 pigment { rgb 0 } finish { ambient 0 diffuse 0 reflection 0.9 } }"},
	{"filter", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4 spotlight point_at <0, 0, 0.5> radius 20 falloff 35",
		"box { <-2, 1.5, -0.5>, <0.2, 1.6, 1> rotate <3, 17, 5> pigment { rgbf <1, 0.6, 0.2, 0.8> } finish { ambient 0 diffuse 0 } }"},
};

std::string Scene(const Case& c, bool ours)
{
	std::string light = c.light;
	// Stock's `adaptive` is what is not to be compared.
	const std::size_t adaptive = light.find(" adaptive 1");
	if (!ours && adaptive != std::string::npos)
		light.erase(adaptive, 11);
	return "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n"
		"#ifndef (Seed) #declare Seed = 0; #end\n"
		"camera { " + std::string(ours ? "tilt_lens { focal_distance 4 aperture_diameter 1e-7 seed Seed } " : "perspective ") +
		"location <0, 2.2, -3.4> right x * 4 / 3 up y direction z * 1.2 look_at <0, 0.3, 0.5>" +
		(ours ? " blur_samples " + std::to_string(Samples) + " variance 0" : "") + " }\n"
		"light_source { <0.4, 4, 0.3> rgb <0.9, 0.7, 0.5> " + light + " }\n"
		"light_source { <-3, 3, -1> rgb <0.1, 0.2, 0.3> area_light <1, 0, 0>, <0, 1, 0>, 2, 3 }\n"
		"#declare F = finish { ambient 0.05 diffuse 0.7 specular 0.2 };\n"
		"plane { y, 0 pigment { rgb 0.8 } finish { F } }\n"
		"sphere { <-0.7, 0.6, 0.6>, 0.6 pigment { rgb <0.8, 0.7, 0.5> } finish { F } }\n"
		"cylinder { <0.5, 1.1, -1>, <0.9, 1, 2>, 0.03 pigment { rgb 0.5 } finish { F } }\n" + c.more + "\n";
}

// The sum over blocks of squared differences and of their variances.
struct Comparison
{
	double squares = 0, variances = 0, mean = 0, mean_variance = 0;
	int count = 0;

	// In units of its standard error.
	double Mean() const { return mean / std::sqrt(mean_variance); }
	double Ratio() const { return squares / variances; }
};

// The variance of the mean of one block of stock's sub-pixels.
double StocksVariance(const Picture& fine, int x0, int y0, int size, int channel)
{
	double squares = 0;
	for (int y = y0; y < y0 + size; ++y)
		for (int x = x0; x < x0 + size; x += 2)
		{
			const std::size_t i = 3 * (std::size_t(y) * std::size_t(fine.width) + std::size_t(x)) + std::size_t(channel);
			squares += (fine.rgb[i] - fine.rgb[i + 3]) * (fine.rgb[i] - fine.rgb[i + 3]);
		}
	const double n = double(size) * size;
	return squares / n / n; // n / 2 pairs, each twice the variance of one
}

Comparison Compare(const std::vector<Picture>& ours, const Picture& stock)
{
	std::vector<Picture> blocks;
	for (const Picture& picture : ours)
		blocks.push_back(Coarser(picture, Block));
	const int fine = Block * Sub;
	const Picture truth = Coarser(stock, fine);
	Comparison sum;
	for (std::size_t i = 0; i < truth.rgb.size(); ++i)
	{
		const int block = int(i / 3), x = block % truth.width, y = block / truth.width;
		double mean = 0, squares = 0;
		for (const Picture& picture : blocks)
			mean += picture.rgb[i] / Seeds;
		for (const Picture& picture : blocks)
			squares += (picture.rgb[i] - mean) * (picture.rgb[i] - mean);
		// Half floats keep 11 bits: a pixel is rounded by up to 2^-12 of itself, whichever way.
		const double rounding = std::pow(mean / 4096, 2) / 3 / (Block * Block);
		const double variance = squares / (Seeds * (Seeds - 1)) + StocksVariance(stock, x * fine, y * fine, fine, int(i % 3)) + rounding;
		sum.squares += (mean - truth.rgb[i]) * (mean - truth.rgb[i]);
		sum.variances += variance;
		sum.mean += mean - truth.rgb[i];
		sum.mean_variance += 3 * variance; // the three channels see the same points: as if one
		++sum.count;
	}
	return sum;
}

}

int main(int argc, char** argv)
try
{
	std::map<std::string, std::string> option = ReadCaseOptions(argc, argv, "--stock POVRAY --ours POVRAY --work DIR");
	const std::string name = argv[1];
	for (const Case& c : cases)
	{
		if (c.name != name)
			continue;
		const fs::path work = option["--work"];
		fs::create_directories(work);
		std::ofstream(work / "ours.pov") << Scene(c, true);
		std::ofstream(work / "stock.pov") << Scene(c, false);
		RunPovray(option["--stock"], work, "stock.pov", "stock.exr", Width * Sub, Height * Sub);
		const Picture stock = ReadExr((work / "stock.exr").string());
		std::vector<Picture> ours;
		for (int seed = 0; seed < Seeds; ++seed)
		{
			RunPovray(option["--ours"], work, "ours.pov", "ours.exr", Width, Height, {"Declare=Seed=" + std::to_string(seed)});
			ours.push_back(ReadExr((work / "ours.exr").string()));
		}
		const Comparison result = Compare(ours, stock);
		// Squares of n/3 independent blocks over what is expected of them: within five standard deviations, sqrt(2/n) each,
		// and twice that, since the expectation is made of as many estimates of seven degrees of freedom and few blocks hold
		// most of it.
		const double ratio_limit = 1 + 2 * 5 * std::sqrt(2.0 / (result.count / 3));
		std::printf("%s: RMS of blocks %.6f, %.6f expected: squares %.2f (limit %.2f); mean %.6f, %.2f standard errors (limit 5)\n", name.c_str(),
			std::sqrt(result.squares / result.count), std::sqrt(result.variances / result.count), result.Ratio(), ratio_limit,
			result.mean / result.count, result.Mean());
		return result.Ratio() <= ratio_limit && std::abs(result.Mean()) <= 5 ? 0 : 1;
	}
	throw std::runtime_error("no case '" + name + "'");
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "area_lights: %s\n", error.what());
	return 2;
}
