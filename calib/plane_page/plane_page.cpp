// SPDX-License-Identifier: AGPL-3.0-or-later

#include "plane_page/plane_page.h"

#include "base/plain_text.h"
#include "plane_page/texts.h"

namespace tiltcal
{

namespace
{

/// In JSON these stand in strings only; written so they end no script, and are well-formed XML.
std::string EscapedJson(const std::string& json)
{
	std::string out;
	for (const char c : json)
		if (c == '<')
			out += "\\u003c";
		else if (c == '>')
			out += "\\u003e";
		else if (c == '&')
			out += "\\u0026";
		else
			out += c;
	return out;
}

}

std::string PlaneStyle() { return PlaneStyleText; }

std::string PlaneScript() { return std::string("(() => {\n'use strict';\n") + PlaneScriptText + "})();\n"; }

std::string PlanePart(const std::string& lens)
{
	return "<div class=\"plane\"><script type=\"application/json\">" + EscapedJson(lens) + "</script></div>\n";
}

std::string PlanePage(const std::string& title, const std::string& about, const std::string& lens)
{
	return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/><meta name=\"viewport\" content=\"width=device-width\"/><meta name=\"color-scheme\" content=\"light dark\"/><title>"
		+ HtmlText(title) + ": the plane of focus</title>\n<style>\n" + PlaneStyleText + PlanePageStyleText + "</style></head>\n<body><h1>" + HtmlText(title) + "</h1>\n<p class=\"about\">" + about
		+ "</p>\n" + PlanePart(lens) + "<p class=\"plane-still\">This page draws with JavaScript, which is switched off here.</p>\n<script>\n" + PlaneScript() + "</script></body></html>\n";
}

}
