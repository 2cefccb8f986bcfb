// SPDX-License-Identifier: AGPL-3.0-or-later

#include "page_check.h"

#include <cctype>

namespace
{

/// Resolves the five entities and &#39;; sets `bad` at any other ampersand and at <.
std::string Unescape(const std::string& raw, bool& bad)
{
	static const std::map<std::string, std::string> entities{ { "&amp;", "&" }, { "&lt;", "<" }, { "&gt;", ">" }, { "&quot;", "\"" }, { "&#39;", "'" } };
	std::string out;
	for (size_t i = 0; i < raw.size();)
	{
		if (raw[i] == '<')
			bad = true;
		if (raw[i] != '&')
		{
			out += raw[i++];
			continue;
		}
		const size_t end = raw.find(';', i);
		const auto found = end == std::string::npos ? entities.end() : entities.find(raw.substr(i, end - i + 1));
		if (found == entities.end())
		{
			bad = true;
			return out;
		}
		out += found->second;
		i = end + 1;
	}
	return out;
}

/// Reads `name a="b" c="d"`; false where an attribute is not quoted or comes twice.
bool ReadTag(const std::string& tag, PageElement& element)
{
	size_t i = 0;
	const auto skip = [&] { while (i < tag.size() && std::isspace(static_cast<unsigned char>(tag[i]))) ++i; };
	while (i < tag.size() && !std::isspace(static_cast<unsigned char>(tag[i])))
		element.name += tag[i++];
	for (skip(); i < tag.size(); skip())
	{
		const size_t equals = tag.find("=\"", i);
		const size_t end = equals == std::string::npos ? equals : tag.find('"', equals + 2);
		if (end == std::string::npos)
			return false;
		const std::string name = tag.substr(i, equals - i);
		bool bad = name.empty() || name.find_first_of(" \t\n<>&'") != std::string::npos;
		const std::string value = Unescape(tag.substr(equals + 2, end - equals - 2), bad);
		if (bad || !element.attributes.emplace(name, value).second)
			return false;
		i = end + 1;
	}
	return !element.name.empty();
}

/// The > that ends a tag: not one within quotes.
size_t EndOfTag(const std::string& html, size_t from)
{
	bool quoted = false;
	for (size_t i = from; i < html.size(); ++i)
	{
		quoted ^= html[i] == '"';
		if (html[i] == '>' && !quoted)
			return i;
	}
	return std::string::npos;
}

}

Page ReadPage(const std::string& html)
{
	Page page;
	std::vector<std::string> open;
	size_t at = html.find("<html");
	if (html.rfind("<!DOCTYPE html>", 0) != 0 || at == std::string::npos)
		page.complaint = "no DOCTYPE or no html element";
	while (page.complaint.empty() && at < html.size())
	{
		const size_t begin = html.find('<', at);
		bool bad = false;
		page.text += Unescape(html.substr(at, begin - at), bad) + " ";
		if (bad)
			page.complaint = "raw & in " + html.substr(at, 80);
		if (begin == std::string::npos)
			break;
		const size_t end = EndOfTag(html, begin);
		if (end == std::string::npos)
			page.complaint = "tag without end: " + html.substr(begin, 80);
		if (!page.complaint.empty())
			break;
		std::string tag = html.substr(begin + 1, end - begin - 1);
		at = end + 1;
		if (tag[0] == '/')
		{
			if (open.empty() || open.back() != tag.substr(1))
				page.complaint = "</" + tag.substr(1) + "> closes " + (open.empty() ? "nothing" : open.back());
			else
				open.pop_back();
			continue;
		}
		const bool alone = tag.back() == '/';
		if (alone)
			tag.pop_back();
		PageElement element;
		if (!ReadTag(tag, element))
			page.complaint = "bad tag: <" + tag.substr(0, 120);
		if (!alone)
			open.push_back(element.name);
		if (element.name == "style")
			at = html.find("</style>", at);
		page.elements.push_back(element);
	}
	if (page.complaint.empty() && !open.empty())
		page.complaint = "not closed: " + open.back();
	return page;
}

std::vector<PageElement> Page::Find(const std::string& name, const std::string& its_class) const
{
	std::vector<PageElement> found;
	for (const PageElement& element : elements)
	{
		const auto at = element.attributes.find("class");
		if (element.name == name && at != element.attributes.end() && at->second == its_class)
			found.push_back(element);
	}
	return found;
}

std::string OutsideResource(const Page& page, const std::string& html)
{
	for (const PageElement& element : page.elements)
	{
		for (const char* const name : { "script", "link", "iframe", "object", "embed", "base" })
			if (element.name == name)
				return "element " + element.name;
		for (const auto& [name, value] : element.attributes)
		{
			if ((name == "src" || name == "href" || name == "srcset" || name == "xlink:href") && value.rfind("data:", 0) != 0)
				return name + "=" + value.substr(0, 80);
			// A namespace is a name, not an address that is fetched.
			if (name != "xmlns" && name != "alt" && name != "aria-label" && value.rfind("data:", 0) != 0 && value.find("//") != std::string::npos)
				return name + "=" + value.substr(0, 80);
		}
	}
	for (const char* const text : { "url(", "@import" })
		if (html.find(text) != std::string::npos)
			return text;
	return "";
}
