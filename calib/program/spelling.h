// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Inputs stand in backquotes in the library's messages: `flat_field`. On a command line they are options: --flat-field.

#ifndef TILTCAL_SPELLING_H
#define TILTCAL_SPELLING_H

#include <string>

namespace tiltcal
{

/// The text with every input spelled as an option. What stands in backquotes and is none of tiltcal's inputs stays.
std::string SpelledAsOptions(const std::string& text);

}

#endif
