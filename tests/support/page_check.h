// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_PAGE_CHECK_H
#define TILTCAL_PAGE_CHECK_H

#include <map>
#include <string>
#include <vector>

/// An element's start tag.
struct PageElement
{
	std::string name;
	std::map<std::string, std::string> attributes;   ///< unescaped
};

/// A page read as XML (its DOCTYPE, contents of <style> and code in <script> aside).
struct Page
{
	std::vector<PageElement> elements;
	std::string text;       ///< all text, unescaped, elements replaced by a space
	std::string complaint;  ///< what is not well-formed, empty when all is

	/// Elements with this name and class.
	std::vector<PageElement> Find(const std::string& name, const std::string& its_class) const;
};

Page ReadPage(const std::string& html);

/// Why the page would need a network or another file; empty when it does not.
std::string OutsideResource(const Page& page, const std::string& html);

#endif
