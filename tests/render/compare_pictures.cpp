// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Comparisons for the render tests' scripts, of OpenEXR and of 16-bit PPM pictures.
//
//   compare_pictures same A B            equal in every pixel, alpha too
//   compare_pictures rms LIMIT A B       RMS difference of red, green and blue at most LIMIT
//   compare_pictures differ LIMIT A B    ... at least LIMIT
//   compare_pictures alpha LIMIT A B     RMS difference of alpha at most LIMIT
//   compare_pictures channels LIMIT R G B A    red of A is that of R, and so on: RMS difference at most LIMIT
//   compare_pictures sum WHOLE PART...   the parts, black elsewhere, add up to the whole in every pixel
//   compare_pictures empty A             prints the shares of pixels, in percent, with alpha 0, which must be black,
//                                        and with an alpha between 0 and 1
//   compare_pictures all R,G,B X0,Y0,X1,Y1 A, none ...: every, no pixel of a region is of that colour, within 0.001
//   compare_pictures flat LIMIT A        the pixels differ by no more than LIMIT in any channel
//   compare_pictures series RATIO A B... the differences from picture to picture change smoothly: see below
//
// Every picture must be finite. Exit 0: as asked, 1: not, 2: wrong usage or an unreadable file.
#include "support/picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>

namespace
{

bool Same(const Picture& a, const Picture& b)
{
	std::size_t different = 0;
	double largest = LargestDifference(a, b);
	for (std::size_t i = 0; i < a.alpha.size(); ++i)
	{
		largest = std::max(largest, std::abs(a.alpha[i] - b.alpha[i]));
		bool differs = a.alpha[i] != b.alpha[i];
		for (std::size_t c = 3 * i; c < 3 * i + 3; ++c)
			differs = differs || a.rgb[c] != b.rgb[c];
		different += differs;
	}
	std::printf("%zu of %zu pixels differ, by up to %.6f\n", different, a.alpha.size(), largest);
	return different == 0;
}

bool Empty(const Picture& a)
{
	std::size_t empty = 0, partly = 0, lit = 0;
	for (std::size_t i = 0; i < a.alpha.size(); ++i)
	{
		empty += a.alpha[i] == 0;
		partly += a.alpha[i] != 0 && a.alpha[i] != 1;
		lit += a.alpha[i] == 0 && (a.rgb[3 * i] != 0 || a.rgb[3 * i + 1] != 0 || a.rgb[3 * i + 2] != 0);
	}
	const double percent = 100.0 / double(a.alpha.size());
	std::printf("%.2f %.2f\n", percent * double(empty), percent * double(partly));
	if (lit > 0)
		std::fprintf(stderr, "compare_pictures: %zu pixels are empty but not black\n", lit);
	return lit == 0;
}

// Numbers with commas between them.
std::vector<double> Numbers(const std::string& words, std::size_t count)
{
	std::vector<double> numbers;
	std::istringstream text(words);
	for (std::string word; std::getline(text, word, ',');)
		numbers.push_back(std::stod(word));
	if (numbers.size() != count)
		throw std::runtime_error("not " + std::to_string(count) + " numbers: " + words);
	return numbers;
}

bool Colour(bool all, const std::vector<double>& colour, const std::vector<double>& region, const Picture& a)
{
	int alike = 0, pixels = 0;
	for (int y = int(region[1]); y <= int(region[3]); ++y)
		for (int x = int(region[0]); x <= int(region[2]); ++x)
		{
			bool same = true;
			for (std::size_t c = 0; c < 3; ++c)
				same = same && std::abs(a.rgb.at(3 * std::size_t(y * a.width + x) + c) - colour[c]) < 0.001;
			alike += same;
			++pixels;
		}
	std::printf("%d of %d pixels are of that colour\n", alike, pixels);
	return alike == (all ? pixels : 0);
}

// A parameter moves in equal steps, so the difference of one step is near to that of the steps beside it: none may
// exceed RATIO times the larger of its two neighbours, nor fall below their smaller one divided by RATIO.
bool Series(double ratio, const std::vector<Picture>& pictures)
{
	std::vector<double> steps;
	for (std::size_t i = 1; i < pictures.size(); ++i)
		steps.push_back(RmsDifference(pictures[i - 1], pictures[i]));
	double worst = 1;
	for (std::size_t i = 0; i < steps.size(); ++i)
	{
		const double before = steps[i > 0 ? i - 1 : 1], after = steps[i + 1 < steps.size() ? i + 1 : i - 1];
		if (steps[i] == 0)
			worst = HUGE_VAL; // frames that are the same show nothing
		worst = std::max({worst, steps[i] / std::max(before, after), std::min(before, after) / steps[i]});
		std::printf("%.5f ", steps[i]);
	}
	std::printf("\nlargest ratio to a neighbour %.3f (limit %.3f)\n", worst, ratio);
	return worst <= ratio && steps.size() > 2;
}

bool Flat(double limit, const Picture& a)
{
	double largest = 0;
	for (std::size_t c = 0; c < 3; ++c)
	{
		double low = a.rgb[c], high = low;
		for (std::size_t i = c; i < a.rgb.size(); i += 3)
		{
			low = std::min(low, a.rgb[i]);
			high = std::max(high, a.rgb[i]);
		}
		largest = std::max(largest, high - low);
	}
	std::printf("pixels differ by up to %.6f (at most %.6f)\n", largest, limit);
	return largest <= limit;
}

bool Alpha(double limit, const Picture& a, const Picture& b)
{
	double sum = 0;
	for (std::size_t i = 0; i < a.alpha.size(); ++i)
		sum += std::pow(a.alpha[i] - b.alpha.at(i), 2);
	const double rms = std::sqrt(sum / double(a.alpha.size()));
	std::printf("RMS difference of alpha %.5f (at most %.5f)\n", rms, limit);
	return rms <= limit;
}

bool Channels(double limit, const std::vector<Picture>& pictures)
{
	Picture merged = pictures[3];
	for (std::size_t k = 0; k < merged.rgb.size(); ++k)
		merged.rgb[k] = pictures[k % 3].rgb.at(k);
	const double rms = RmsDifference(merged, pictures[3]);
	std::printf("RMS difference %.5f (at most %.5f)\n", rms, limit);
	return rms <= limit;
}

bool Run(const std::string& how, std::vector<std::string> words)
{
	if ((how == "all" || how == "none") && words.size() == 3)
		return Colour(how == "all", Numbers(words[0], 3), Numbers(words[1], 4), ReadPicture(words[2]));
	double limit = 0;
	if (how == "rms" || how == "differ" || how == "series" || how == "flat" || how == "alpha" || how == "channels")
	{
		limit = std::stod(words.at(0));
		words.erase(words.begin());
	}
	std::vector<Picture> pictures;
	for (const std::string& word : words)
	{
		pictures.push_back(ReadPicture(word));
		if (!AllFinite(pictures.back()))
		{
			std::printf("%s is not finite\n", word.c_str());
			return false;
		}
	}
	const auto a = pictures.begin();
	if (how == "empty" && pictures.size() == 1)
		return Empty(*a);
	if (how == "flat" && pictures.size() == 1)
		return Flat(limit, *a);
	if (pictures.size() < 2)
		throw std::runtime_error("too few pictures");
	if (how == "series")
		return Series(limit, pictures);
	if (how == "sum")
	{
		Picture sum = a[1];
		for (auto part = a + 2; part != pictures.end(); ++part)
			for (std::size_t k = 0; k < sum.rgb.size(); ++k)
				sum.rgb[k] += part->rgb.at(k);
		return Same(*a, sum);
	}
	if (how == "alpha")
		return Alpha(limit, a[0], a[1]);
	if (how == "channels" && pictures.size() == 4)
		return Channels(limit, pictures);
	if (how == "same")
		return Same(a[0], a[1]);
	const double rms = RmsDifference(a[0], a[1]);
	std::printf("RMS difference %.5f (%s %.5f)\n", rms, how == "rms" ? "at most" : "at least", limit);
	if (how == "rms")
		return rms <= limit;
	if (how == "differ")
		return rms >= limit;
	throw std::runtime_error("unknown comparison " + how);
}

}

int main(int argc, char** argv)
try
{
	if (argc < 3)
		throw std::runtime_error("usage: compare_pictures same|rms|differ|alpha|channels|sum|empty|flat|all|none|series ...");
	return Run(argv[1], {argv + 2, argv + argc}) ? 0 : 1;
}
catch (const std::exception& error)
{
	std::fprintf(stderr, "compare_pictures: %s\n", error.what());
	return 2;
}
