// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Names and texts of others, made fit for our files: a file name may hold any byte but / and 0.

#ifndef TILTCAL_PLAIN_TEXT_H
#define TILTCAL_PLAIN_TEXT_H

#include <string>

namespace tiltcal
{

/// Length of the UTF-8 character at text[i] (RFC 3629), or 0.
size_t Utf8Length(const std::string& text, size_t i);

/// Bytes that are no UTF-8, such as Latin-1's umlauts, become U+FFFD, as in our JSON.
std::string CleanUtf8(const std::string& text);

/// For comments: CleanUtf8, and control characters become U+FFFD, so that nothing ends the line.
std::string OneLine(const std::string& text);

/// For HTML and XML, in texts and in attributes' values: their five characters as entities; bytes that are no UTF-8 and control characters become U+FFFD.
std::string HtmlText(const std::string& text);

/// Without a byte order mark; lines that end with CR LF or CR end with LF.
std::string WithUnixLines(const std::string& text);

}

#endif
