// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The one point of an area light that a lens sample asks has the mean of stock's whole grid; with `area_light_grid` the grid itself is asked, and
// is stock's.
//
//   area_lights CASE --stock POVRAY --ours POVRAY --work DIR
//
// Stock renders a pinhole picture of Sub x Sub pixels for every pixel, without `adaptive`, which only approximates that mean;
// ours renders through an opening too small to blur, with several seeds. Means of blocks of pixels are compared in units
// of their own standard errors: ours from the seeds, stock's from the differences of neighbouring sub-pixels, which hold
// jitter and where edges fall between sub-pixels. In the case `opened` the opening is wide, and stock's are the means of pinhole pictures through
// points of the lens, whose standard errors come from groups of them with other points.
//
// Exit 0: alike, 1: not, 2: wrong usage or a program failed.
#include "support/case_options.h"
#include "support/picture.h"
#include "support/run_povray.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
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
const int Groups = 12, Pinholes = 64; // of an opened lens, and as many seeds of ours

struct Case
{
	std::string name;
	std::string light;   // options of the area light
	std::string more;    // objects
	bool grid = false;   // by the word area_light_grid: then `adaptive` is stock's too
	double opening = 1e-7;
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
	{"refraction", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4",
		"box { <-3, -1, -0.1>, <3, 3, 0.1> rotate <10, 17, 0> translate -1.8 * z pigment { rgbf <0.9, 0.95, 1, 0.9> } finish { ambient 0 diffuse 0.05 reflection 0.08 } interior { ior 1.4 } }"},
	{"parallel", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4 parallel point_at <0.2, 0, 0.5>", ""},
	{"cylinder", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4 cylinder point_at <0.2, 0, 0.5> radius 1.2 falloff 2", ""},
	// Lights of groups beside those of all; in one group the others count too. Edges aslant: those along a row lie between stock's sub-pixels alike in all of a block.
	{"groups", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4",
		"light_group {\n"
		"	light_source { <1.5, 3, -1> rgb <0.6, 0.3, 0.1> area_light <1.5, 0, 0>, <0, 0, 1>, 4, 3 jitter }\n"
		"	box { <-0.1, 0.01, -0.9>, <1.4, 0.02, 0.3> rotate 17 * y pigment { rgb 0.7 } finish { F } }\n"
		"	cylinder { <0.3, 0.6, -0.9>, <1.1, 0.5, 0.3>, 0.03 pigment { rgb 0.5 } finish { F } }\n"
		"	global_lights on\n"
		"}\n"
		"light_group {\n"
		"	light_source { <-1.4, 2.5, -1.5> rgb <0.1, 0.4, 0.7> area_light <1, 0, 0>, <0, 0, 1>, 5, 5 circular orient }\n"
		"	box { <-1.5, 0.01, -1>, <-0.3, 0.02, 0> rotate 17 * y pigment { rgb 0.8 } finish { F } }\n"
		"	cylinder { <-1.4, 0.5, -0.8>, <-0.4, 0.6, -0.4>, 0.03 pigment { rgb 0.5 } finish { F } }\n"
		"}"},
	// Photons are shot before the camera is asked, by both alike: what is looked up of them has no noise of its own here.
	{"photons", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4",
		"global_settings { photons { spacing 0.08 } }\n"
		"sphere { <0.2, 0.5, -0.6>, 0.4 pigment { rgbt <0.95, 0.97, 1, 0.95> } finish { ambient 0 diffuse 0.1 reflection 0.05 } interior { ior 1.5 }\n"
		"	photons { target refraction on reflection off } }"},
	{"word", "area_light <2, 0, 0>, <0, 0, 1.4>, 3, 5", "", true},
	{"word_adaptive", "area_light <2, 0, 0>, <0, 0, 2>, 9, 6 adaptive 0", "", true},
	{"word_jitter", "area_light <2, 0, 0>, <0, 0, 2>, 5, 5 adaptive 1 circular orient jitter", "", true},
	{"word_opened", "area_light <2, 0, 0>, <0, 0, 2>, 9, 6 adaptive 0", "", true, 0.6},
	{"opened", "area_light <2, 0, 0>, <0, 0, 2>, 5, 4", "", false, 0.6},
};

std::string Number(double value)
{
	char text[32];
	std::snprintf(text, sizeof text, "%.9g", value);
	return text;
}

// Stock's camera: a pinhole in the middle of the lens, or frame_number of the group Group: through a point S of the lens, in uniform and well spread
// points of four dimensions (the pixel's two and the lens's), shifted at random from group to group (rand is linear in its seed: seeds in a row would give
// a lattice of shifts). With q = z / 4 the picture through S is that of M = 1 - S q^T.
std::string StocksCamera(const Case& c)
{
	if (c.opening < 1e-3)
		return "camera { perspective location Eye right x * 4 / 3 up y direction z * 1.2 look_at Aim }\n";
	return "#declare Z = vnormalize(Aim - Eye); #declare X = vnormalize(vcross(y, Z)); #declare Y = vcross(Z, X);\n"
		"#declare R = seed(7919 * pow(Group + 1, 3)); #declare P = array[4]; #declare G = 1.1673039782614187;\n"
		"#for (D, 0, 3) #declare P[D] = mod(rand(R) + frame_number / pow(G, D + 1), 1); #end\n"
		"#macro World(V) (V.x * X + V.y * Y + V.z * Z) #end\n"
		"#declare S = " + Number(c.opening / 2) + " * sqrt(P[2]) * (cos(2 * pi * P[3]) * X + sin(2 * pi * P[3]) * Y);\n"
		"#macro M(V) (World(V) - V.z / 4 * S) #end\n"
		"camera { perspective location Eye + S right M(x * 4 / 3) up M(y)\n"
		"	direction M(<(P[0] - 0.5) * 4 / 3 / image_width, (P[1] - 0.5) / image_height, 1.2>) }\n";
}

std::string Scene(const Case& c, bool ours)
{
	std::string light = c.light;
	// Stock's `adaptive` is what is not to be compared.
	const std::size_t adaptive = light.find(" adaptive 1");
	if (!ours && !c.grid && adaptive != std::string::npos)
		light.erase(adaptive, 11);
	return "#version 3.7;\nglobal_settings { assumed_gamma 1 }\n"
		"#ifndef (Seed) #declare Seed = 0; #end\n"
		"#declare Eye = <0, 2.2, -3.4>; #declare Aim = <0, 0.3, 0.5>;\n" +
		(ours ? "camera { tilt_lens { focal_distance 4 aperture_diameter " + Number(c.opening) + " seed Seed " + (c.grid ? "area_light_grid " : "") + "} "
			"location Eye right x * 4 / 3 up y direction z * 1.2 look_at Aim blur_samples " + std::to_string(Samples) + " variance 0 }\n" : StocksCamera(c)) +
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
	double largest = 0; // difference of a block in units of its standard error
	int count = 0;

	// In units of its standard error.
	double Mean() const { return mean / std::sqrt(mean_variance); }
	double Ratio() const { return squares / variances; }
};

// Means of blocks, and their variances.
struct BlockMeans
{
	Picture mean;
	std::vector<double> variance;
	std::vector<Picture> each; // that the mean is of, where they are independent
};

// Of stock's sub-pixels.
BlockMeans OfSubPixels(const Picture& fine)
{
	const int size = Block * Sub;
	BlockMeans blocks{Coarser(fine, size), {}, {}};
	const double n = double(size) * size;
	for (int i = 0; i < int(blocks.mean.rgb.size()); ++i)
	{
		const int x0 = i / 3 % blocks.mean.width * size, y0 = i / 3 / blocks.mean.width * size;
		double squares = 0;
		for (int y = y0; y < y0 + size; ++y)
			for (int x = x0; x < x0 + size; x += 2)
			{
				const std::size_t k = 3 * (std::size_t(y) * std::size_t(fine.width) + std::size_t(x)) + std::size_t(i % 3);
				squares += (fine.rgb[k] - fine.rgb[k + 3]) * (fine.rgb[k] - fine.rgb[k + 3]);
			}
		blocks.variance.push_back(squares / n / n); // n / 2 pairs, each twice the variance of one
	}
	return blocks;
}

// Of pictures that are independent of each other.
BlockMeans OfPictures(const std::vector<Picture>& pictures)
{
	const double n = double(pictures.size());
	std::vector<Picture> coarse;
	for (const Picture& picture : pictures)
		coarse.push_back(Coarser(picture, Block));
	BlockMeans blocks{coarse[0], {}, coarse};
	for (std::size_t i = 0; i < coarse[0].rgb.size(); ++i)
	{
		double mean = 0, squares = 0;
		for (const Picture& picture : coarse)
			mean += picture.rgb[i] / n;
		for (const Picture& picture : coarse)
			squares += (picture.rgb[i] - mean) * (picture.rgb[i] - mean);
		blocks.mean.rgb[i] = mean;
		blocks.variance.push_back(squares / (n * (n - 1)));
	}
	return blocks;
}

// `flat_rounds_alike`: pixels of a block that are the same are rounded the same way, and the mean keeps it.
Comparison Compare(const BlockMeans& ours, const BlockMeans& stock, bool flat_rounds_alike)
{
	Comparison sum;
	for (std::size_t i = 0; i < ours.mean.rgb.size(); ++i)
	{
		// Half floats keep 11 bits: a pixel is rounded by up to 2^-12 of itself, whichever way.
		const double rounding = std::pow(ours.mean.rgb[i] / 4096, 2) / 3 / (flat_rounds_alike ? 1 : Block * Block);
		const double variance = ours.variance[i] + stock.variance[i] + rounding, off = ours.mean.rgb[i] - stock.mean.rgb[i];
		sum.squares += off * off;
		sum.largest = std::max(sum.largest, std::abs(off) / std::sqrt(variance));
		sum.variances += variance;
		sum.mean += off;
		sum.mean_variance += 3 * variance; // the three channels see the same points: as if one
		++sum.count;
	}
	return sum;
}

bool JudgeSum(const Case& c, const Comparison& result)
{
	// Squares of n/3 independent blocks over what is expected of them: within five standard deviations, sqrt(2/n) each,
	// and twice that, since the expectation is made of as many estimates of seven degrees of freedom and few blocks hold
	// most of it.
	const double ratio_limit = 1 + 2 * 5 * std::sqrt(2.0 / (result.count / 3));
	std::printf("%s: RMS of blocks %.6f, %.6f expected: squares %.2f (limit %.2f); mean %.6f, %.2f standard errors (limit 5)\n", c.name.c_str(),
		std::sqrt(result.squares / result.count), std::sqrt(result.variances / result.count), result.Ratio(), ratio_limit,
		result.mean / result.count, result.Mean());
	return result.Ratio() <= ratio_limit && std::abs(result.Mean()) <= 5;
}

// Pinhole pictures have their lens points in common over all blocks, so that their sums say less. Each block by itself: Student's t of the
// degrees of freedom that the one of the two variances has which alone would count, once in a thousand for all blocks together.
bool JudgeBlocks(const Case& c, const Comparison& result)
{
	const double limit = boost::math::quantile(boost::math::complement(boost::math::students_t(Groups - 1), 0.0005 / result.count));
	std::printf("%s: RMS of blocks %.6f, %.6f expected; the largest is %.2f of its standard error (limit %.2f)\n", c.name.c_str(),
		std::sqrt(result.squares / result.count), std::sqrt(result.variances / result.count), result.largest, limit);
	return result.largest <= limit;
}

// All blocks together, however they hang together: the differences of a picture of ours and a group of stock's are as likely with the other sign where
// both have one mean. The sum of squared block means, each over its squares, is to be among the largest two of all 2048 choices of signs once in a thousand.
bool JudgeSigns(const Case& c, const BlockMeans& ours, const BlockMeans& stock)
{
	const std::size_t pairs = ours.each.size(), blocks = ours.mean.rgb.size();
	std::vector<double> products(pairs * pairs, 0.0); // of two pairs' differences, over blocks
	for (std::size_t i = 0; i < blocks; ++i)
	{
		double squares = 0;
		for (std::size_t k = 0; k < pairs; ++k)
			squares += std::pow(ours.each[k].rgb[i] - stock.each[k].rgb[i], 2);
		for (std::size_t k = 0; k < pairs && squares > 0; ++k)
			for (std::size_t l = 0; l < pairs; ++l)
				products[k * pairs + l] += (ours.each[k].rgb[i] - stock.each[k].rgb[i]) * (ours.each[l].rgb[i] - stock.each[l].rgb[i]) / squares;
	}
	const auto sum = [&](unsigned signs) {
		double all = 0;
		for (std::size_t k = 0; k < pairs; ++k)
			for (std::size_t l = 0; l < pairs; ++l)
				all += ((signs >> k ^ signs >> l) & 1u ? -1 : 1) * products[k * pairs + l];
		return all;
	};
	const unsigned choices = 1u << (pairs - 1);
	const double own = sum(0);
	unsigned beyond = 0;
	for (unsigned signs = 1; signs < choices; ++signs)
		beyond += sum(signs) >= own;
	std::printf("%s: of %u choices of signs %u put the blocks farther apart (at least %u wanted)\n", c.name.c_str(), choices, beyond, choices / 1000);
	return beyond >= choices / 1000;
}

BlockMeans Stocks(const std::string& povray, const fs::path& work, const Case& c)
{
	std::ofstream(work / "stock.pov") << Scene(c, false);
	if (c.opening < 1e-3)
	{
		RunPovray(povray, work, "stock.pov", "stock.exr", Width * Sub, Height * Sub);
		return OfSubPixels(ReadExr((work / "stock.exr").string()));
	}
	std::vector<Picture> groups;
	for (int group = 0; group < Groups; ++group)
	{
		RunPovray(povray, work, "stock.pov", "stock.exr", Width, Height,
			{"+KFI1", "+KFF" + std::to_string(Pinholes), "Declare=Group=" + std::to_string(group)});
		Picture mean;
		for (int frame = 1; frame <= Pinholes; ++frame)
		{
			const Picture picture = ReadExr((work / ("stock" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) + ".exr")).string());
			if (frame == 1)
				mean = picture;
			for (std::size_t i = 0; frame > 1 && i < mean.rgb.size(); ++i)
				mean.rgb[i] += picture.rgb[i];
		}
		for (double& value : mean.rgb)
			value /= Pinholes;
		groups.push_back(mean);
	}
	return OfPictures(groups);
}

BlockMeans Ours(const std::string& povray, const fs::path& work, const Case& c)
{
	std::ofstream(work / "ours.pov") << Scene(c, true);
	std::vector<Picture> pictures;
	for (int seed = 0; seed < (c.opening < 1e-3 ? Seeds : Groups); ++seed)
	{
		RunPovray(povray, work, "ours.pov", "ours.exr", Width, Height, {"Declare=Seed=" + std::to_string(seed)});
		pictures.push_back(ReadExr((work / "ours.exr").string()));
	}
	return OfPictures(pictures);
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
		const BlockMeans ours = Ours(option["--ours"], work, c), stock = Stocks(option["--stock"], work, c);
		const Comparison result = Compare(ours, stock, c.opening > 1e-3);
		if (c.opening < 1e-3)
			return JudgeSum(c, result) ? 0 : 1;
		const bool blocks = JudgeBlocks(c, result);
		return JudgeSigns(c, ours, stock) && blocks ? 0 : 1;
	}
	throw std::runtime_error("no case '" + name + "'");
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "area_lights: %s\n", error.what());
	return 2;
}
