// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Brightness profiles of two pictures, as in the paper's Fig. 7 and Table 2.

#ifndef TILTCAL_PROFILE_H
#define TILTCAL_PROFILE_H

#include "profile/shading.h"

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

class FileSet;

/// From (x0, y0) to (x1, y1), pixels; pixel centres at integers.
struct Line
{
	double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
	std::string text;
};

/// "x0,y0,x1,y1". Throws UsageError.
Line ParseLine(const std::string& text);

struct ProfileSample
{
	double position, x, y;   ///< pixels along the line, and where
	double a, b;             ///< brightness 0..255
};

struct LineProfile
{
	Line line;
	std::vector<ProfileSample> samples;
	double mean_abs_error = 0;
};

enum class Match { NONE, GAIN, SHADING };

/// "none", "gain", "shading". Throws UsageError.
Match ParseMatch(const std::string& text);

struct Comparison
{
	Match match = Match::NONE;
	double gain = 1;                  ///< of both, before anything else: 1, but for light of another unit, most of it brighter than white, what makes A's brightest hundredth white
	Shading shading;                  ///< B was multiplied by it
	std::vector<LineProfile> lines;
	double mean_abs_error = 0, rms_error = 0;   ///< over the whole picture
	cv::Mat matched;                  ///< B after the match, linear luminance
};

/// Compares two linear pictures of the same size (grey or colour). Brightness is 255
/// times the sRGB code of the Rec. 709 luminance, clipped to 0..255, which for grey
/// pictures is the 8-bit value before rounding. Along a line it is sampled at steps of
/// one pixel, bilinearly in linear light. Throws UsageError: a line leaves the picture.
Comparison Compare(const cv::Mat& a, const cv::Mat& b, const std::vector<Line>& lines, Match match);

/// The result in words, as printed.
std::string ComparisonText(const Comparison& comparison);

/// The names under which the pictures were given.
struct ComparedFiles
{
	std::string a, b;
};

/// The result for programs: match, shading {order, coefficients}, lines, mean_abs_error.
std::string ComparisonJson(const Comparison& comparison, const ComparedFiles& files);

/// profile-N.csv (position,x,y,a,b) and profile.png (gnuplot) and side-by-side.png into
/// `folder`, as parts of `set`. `a` is the first picture, linear. Throws FileError.
void WriteComparison(const Comparison& comparison, const cv::Mat& a, const ComparedFiles& files, const std::string& folder, FileSet& set);

}

#endif
