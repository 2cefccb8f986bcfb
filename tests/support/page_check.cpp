// SPDX-License-Identifier: AGPL-3.0-or-later

#include "support/page_check.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cstring>

namespace
{

// All that there is, and as it is written: pugixml passes over what it does not know where it replaces entities itself.
const unsigned AS_WRITTEN = pugi::parse_minimal | pugi::parse_doctype | pugi::parse_comments | pugi::parse_pi | pugi::parse_declaration |
	pugi::parse_cdata | pugi::parse_ws_pcdata | pugi::parse_fragment;
const unsigned RESOLVED = pugi::parse_doctype | pugi::parse_ws_pcdata | pugi::parse_fragment | pugi::parse_escapes;

/// An ampersand that begins none of the five entities and not &#39;, or a <: the start of what is wrong, else empty.
std::string BadText(const std::string& written)
{
	for (size_t i = 0; i < written.size(); ++i)
	{
		bool good = written[i] != '&';
		for (const char* const entity : { "&amp;", "&lt;", "&gt;", "&quot;", "&#39;" })
			good = good || written.compare(i, std::strlen(entity), entity) == 0;
		if (!good || written[i] == '<')
			return written.substr(i, 80);
	}
	return "";
}

/// What is wrong with an element and those in it, as they are written.
std::string Complaint(const pugi::xml_node& element)
{
	std::map<std::string, int> names;
	for (const pugi::xml_attribute& attribute : element.attributes())
	{
		if (++names[attribute.name()] > 1)
			return std::string("twice: ") + attribute.name() + " of " + element.name();
		if (const std::string bad = BadText(attribute.value()); !bad.empty())
			return std::string("raw & or < in ") + attribute.name() + " of " + element.name() + ": " + bad;
	}
	for (const pugi::xml_node& child : element.children())
	{
		std::string bad;
		if (child.type() == pugi::node_element)
			bad = Complaint(child);
		else if (child.type() != pugi::node_pcdata)
			bad = std::string("neither element nor text in ") + element.name();
		else if (std::strcmp(element.name(), "style") != 0 && std::strcmp(element.name(), "script") != 0)
			bad = BadText(child.value());
		if (!bad.empty())
			return bad;
	}
	return "";
}

void Collect(const pugi::xml_node& element, Page& page)
{
	PageElement found{ element.name(), {} };
	for (const pugi::xml_attribute& attribute : element.attributes())
		found.attributes.emplace(attribute.name(), attribute.value());
	page.elements.push_back(found);
	page.text += " ";
	for (const pugi::xml_node& child : element.children())
		if (child.type() == pugi::node_element)
			Collect(child, page);
		else if (found.name != "style" && found.name != "script")
			page.text += child.value();
	if (element.first_child())
		page.text += " ";
}

/// Scripts without their code, which is no XML: what it does, cli.plane_page_* tries in a browser.
std::string WithoutCode(const std::string& html)
{
	const std::string begin = "<script>", end = "</script>";
	std::string out;
	size_t at = 0;
	for (size_t from; (from = html.find(begin, at)) != std::string::npos; at = std::min(html.find(end, from), html.size()))
		out += html.substr(at, from + begin.size() - at);
	return out + html.substr(at);
}

}

Page ReadPage(const std::string& whole)
{
	Page page;
	const std::string html = WithoutCode(whole);
	pugi::xml_document written, resolved;
	const pugi::xml_parse_result parsed = written.load_buffer(html.data(), html.size(), AS_WRITTEN, pugi::encoding_utf8);
	int pages = 0, others = 0;
	for (const pugi::xml_node& node : written.children())
		if (std::strcmp(node.name(), "html") == 0)
			++pages;
		else if (node.type() != pugi::node_doctype && !(node.type() == pugi::node_pcdata && std::strspn(node.value(), " \t\r\n") == std::strlen(node.value())))
			++others;
	if (!parsed)
		page.complaint = std::string(parsed.description()) + ": " + html.substr(static_cast<size_t>(parsed.offset), 80);
	else if (html.rfind("<!DOCTYPE html>", 0) != 0 || pages != 1 || others != 0)
		page.complaint = "not a DOCTYPE and one html element";
	else
		page.complaint = Complaint(written.child("html"));
	if (!page.complaint.empty())
		return page;
	if (resolved.load_buffer(html.data(), html.size(), RESOLVED, pugi::encoding_utf8))
		Collect(resolved.child("html"), page);
	else
		page.complaint = "entities that cannot be resolved";
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
		for (const char* const name : { "link", "iframe", "object", "embed", "base" })
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
	for (const char* const text : { "url(", "@import", "fetch(", "XMLHttpRequest", "import(", "WebSocket" })
		if (html.find(text) != std::string::npos)
			return text;
	return "";
}
