// SPDX-License-Identifier: AGPL-3.0-or-later

#include "program/spelling.h"

#include <algorithm>

namespace tiltcal
{

namespace
{

const char* const INPUTS[] = { "any_orientation", "board", "circle_diameter", "edges_per_photo", "effects", "fix", "flat_field", "model", "opencv", "out", "overlay", "photo",
	"pitch", "poses", "prior", "square", "state", "target", "transfer",
	"untilted_free", "watch" };

}

std::string SpelledAsOptions(const std::string& text)
{
	std::string out = text;
	for (const std::string input : INPUTS)
	{
		const std::string quoted = "`" + input + "`";
		std::string option = "--" + input;
		std::replace(option.begin(), option.end(), '_', '-');
		for (size_t at = 0; (at = out.find(quoted, at)) != std::string::npos; at += option.size())
			out.replace(at, quoted.size(), option);
	}
	return out;
}

}
