// SPDX-License-Identifier: AGPL-3.0-or-later

#include "model/state_names.h"

#include "base/plain_text.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <regex>

namespace tiltcal
{

namespace
{

/// Not isalnum: that is the locale's, POV-Ray's identifiers are ASCII.
bool IsLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

bool IsIdentifier(const std::string& name)
{
	return !name.empty() && (IsLetter(name[0]) || name[0] == '_')
		&& std::all_of(name.begin(), name.end(), [](char c) { return IsLetter(c) || IsDigit(c) || c == '_'; });
}

/// TiltCal_<these> are the files' own: camera-*.inc (write_inc.cpp), pose's (pose_inc.cpp), target's (target_inc.cpp).
bool IsTaken(const std::string& name)
{
	static const std::regex taken("Rim|Distortion|Real_Lens|Blur_Samples|Denoise|Pose(_Location|_Look_At|_Sky|_Camera)?|Target(_.*)?");
	return std::regex_match(name, taken);
}

/// What a camera-<state>.inc declares behind TiltCal_<state>_.
bool IsDeclared(const std::string& rest)
{
	static const std::regex declared("Body|Pose|Photos|Photo_([0-9]+_)?(Location|Look_At|Sky)|Image_Distance|Aperture_Diameter(_f[0-9_]+)?|Focus_Distance|Focal_Length|"
		"Focal_Plane_Tilt|Tilt_Direction|Lens_Tilt|Shift_[XY]|Principal_Point_[XY]|Field_Curvature|Psf_Floor|[KP][1-3]|Rim[0-9]*_(Radius|Distance)|"
		"(Lateral|Axial)_(Red|Blue)|Lens_Centre");
	return std::regex_match(rest, declared);
}

/// An identifier like `name`; empty where nothing is left of it.
std::string Offered(const std::string& name)
{
	std::string out;
	for (size_t i = 0; i < name.size(); i += std::max<size_t>(Utf8Length(name, i), 1))
		if (IsLetter(name[i]) || IsDigit(name[i]))
			out += name[i];
		else if (!out.empty() && out.back() != '_')
			out += '_';
	while (!out.empty() && out.back() == '_')
		out.pop_back();
	return out.empty() || (IsLetter(out[0]) && !IsTaken(out)) ? out : "state_" + out;
}

}

std::string WithUnderscores(const std::string& name)
{
	std::string out = name;
	for (char& c : out)
		if (c == '-' || c == '.' || c == ' ')
			c = '_';
	return IsIdentifier(out) ? out : name;
}

void CheckStateName(const std::string& name)
{
	if (IsIdentifier(name) && !IsTaken(name))
		return;
	const std::string offered = Offered(name);
	throw UsageError(fmt::format("the state's NAME '{}' {}; {}", OneLine(name),
		IsIdentifier(name) ? "is what the .inc files call something else by" : "is not of letters, digits and _, the first no digit",
		offered.empty() ? "give one such as plus5" : fmt::format("call it {}", offered)));
}

void CheckStateNames(const std::vector<std::string>& names)
{
	for (size_t i = 0; i < names.size(); ++i)
	{
		CheckStateName(names[i]);
		for (size_t k = 0; k < names.size(); ++k)
		{
			if (k < i && names[k] == names[i])
				throw UsageError(fmt::format("the state's NAME '{}' is already taken; give every state its own", names[i]));
			const std::string prefix = names[k] + "_";
			if (names[i].rfind(prefix, 0) == 0 && IsDeclared(names[i].substr(prefix.size())))
				throw UsageError(fmt::format("the state's NAME '{}' is what the .inc of state {} calls something else by; give another", names[i], names[k]));
		}
	}
}

}
