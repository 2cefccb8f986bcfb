// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The results that Baba, Nakane and Hiura print: Tables 1 and 2, and their lens (Canon 6D, TS-E 45 mm, f/2.8).

#ifndef PAPER_PUBLISHED_H
#define PAPER_PUBLISHED_H

namespace paper
{

struct Published
{
	const char* state;
	double tilt_deg;      ///< Table 1; none for the untilted state
	double red, green;    ///< Table 2, mean brightness error of 255
};

const Published PUBLISHED[] = { { "untilted", 0, 16.49, 11.49 }, { "plus5", 4.152, 16.42, 11.16 }, { "minus5", -5.030, 6.474, 7.851 } };

const double PUBLISHED_IMAGE_DISTANCE_MM = 55.39, PUBLISHED_APERTURE_MM = 18.81, PUBLISHED_FOCUS_DISTANCE_MM = 618.4;

}

#endif
