// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/plain_text.h"

#include <algorithm>

namespace tiltcal
{

namespace
{

const char* const REPLACEMENT = "\xEF\xBF\xBD";   // U+FFFD

std::string Cleaned(const std::string& text, bool one_line)
{
	std::string out;
	for (size_t i = 0; i < text.size();)
	{
		const size_t length = Utf8Length(text, i);
		const unsigned char c = static_cast<unsigned char>(text[i]);
		if (length == 0 || (one_line && (c < 0x20 || c == 0x7F)))
			out += REPLACEMENT;
		else
			out.append(text, i, length);
		i += std::max<size_t>(length, 1);
	}
	return out;
}

}

size_t Utf8Length(const std::string& text, size_t i)
{
	const auto byte = [&](size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
	const unsigned first = byte(i);
	const size_t length = first < 0x80 ? 1 : first >= 0xC2 && first < 0xE0 ? 2 : first >= 0xE0 && first < 0xF0 ? 3 : first >= 0xF0 && first < 0xF5 ? 4 : 0;
	for (size_t k = 1; k < length; ++k)
		if ((byte(i + k) & 0xC0) != 0x80)
			return 0;
	// Overlong forms, surrogates, beyond U+10FFFF.
	const unsigned second = byte(i + 1);
	const bool bad = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
	return bad ? 0 : length;
}

std::string CleanUtf8(const std::string& text) { return Cleaned(text, false); }

std::string OneLine(const std::string& text) { return Cleaned(text, true); }

std::string WithUnixLines(const std::string& text)
{
	std::string out;
	out.reserve(text.size());
	for (size_t i = text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0; i < text.size(); ++i)
		if (text[i] != '\r')
			out += text[i];
		else if (i + 1 == text.size() || text[i + 1] != '\n')
			out += '\n';
	return out;
}

std::string HtmlText(const std::string& text)
{
	std::string out;
	for (size_t i = 0; i < text.size();)
	{
		const size_t length = Utf8Length(text, i);
		const unsigned char c = static_cast<unsigned char>(text[i]);
		if (length == 0 || c < 0x20 || c == 0x7F)
			out += "\xEF\xBF\xBD";
		else if (c == '&')
			out += "&amp;";
		else if (c == '<')
			out += "&lt;";
		else if (c == '>')
			out += "&gt;";
		else if (c == '"')
			out += "&quot;";
		else if (c == '\'')
			out += "&#39;";
		else
			out.append(text, i, length);
		i += std::max<size_t>(length, 1);
	}
	return out;
}

}
