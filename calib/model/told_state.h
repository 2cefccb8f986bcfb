// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What people write before a state's photographs: its name, and at what f-number they were taken.

#ifndef TILTCAL_TOLD_STATE_H
#define TILTCAL_TOLD_STATE_H

#include <optional>
#include <string>

namespace tiltcal
{

struct ToldState
{
	std::string name;                   ///< as it is written
	std::optional<double> f_number{};
};

/// "plus5" or "plus5:f_number=8". Throws UsageError, which begins with `where`: another word than f_number, or a number that is not above 0.
ToldState ParseToldState(const std::string& text, const std::string& where);

/// "NAME=GLOB" or "NAME:f_number=8=GLOB", GLOB with any characters. Throws UsageError, which names `option`.
struct ToldPhotographs
{
	ToldState state;
	std::string pattern;
};
ToldPhotographs ParseToldPhotographs(const std::string& text, const std::string& option);

/// Engraved f-numbers of one opening, which EXIF may hold as 5.6 or as 5.657; the next third of a stop is 12 % away.
bool IsSameFNumber(double a, double b);

}

#endif
