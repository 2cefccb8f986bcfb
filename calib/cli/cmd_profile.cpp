// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "program/program.h"
#include <tiltcal/error.h>
#include "base/distinct_files.h"
#include "base/file_set.h"
#include "base/files.h"
#include "picture/image_io.h"
#include "profile/profile.h"

#include <fmt/format.h>

#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string a, b, match = "none", transfer = "srgb", transfer_a, transfer_b, out = ".", json;
	std::vector<std::string> lines;
};

void Run(const Options& o)
{
	CheckDistinct({ { "A", o.a }, { "B", o.b } }, { { "--out", Join(o.out, "profile.png") }, { "--out", Join(o.out, "side-by-side.png") }, { "--json", o.json } });
	const Match match = ParseMatch(o.match);
	std::vector<Line> lines;
	for (const std::string& text : o.lines)
		lines.push_back(ParseLine(text));
	const Transfer transfer_a = ParseTransfer(o.transfer_a.empty() ? o.transfer : o.transfer_a);
	const Transfer transfer_b = ParseTransfer(o.transfer_b.empty() ? o.transfer : o.transfer_b);
	const cv::Mat a = ReadLinear(o.a, transfer_a), b = ReadLinear(o.b, transfer_b);
	if (a.size() != b.size())
		throw Refused(fmt::format("{} is {}x{} pixels, {} is {}x{}: only pictures of the same size can be compared; render at the photograph's size",
			o.a, a.cols, a.rows, o.b, b.cols, b.rows));
	PrepareFolder(o.out);
	if (!o.json.empty())
		PrepareFolderOf(o.json);
	const Comparison c = Compare(a, b, lines, match);
	FileSet set;
	WriteComparison(c, a, { o.a, o.b }, o.out, set);
	if (!o.json.empty())
		set.Text(o.json, ComparisonJson(c, { o.a, o.b }));
	set.Commit();
	fmt::print(ReportBeside({ o.json }), "{}", ComparisonText(c));
}

}

void AddProfile(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("profile", "Compares the brightness of two pictures of the same size along lines.");
	c->add_option("A", o->a, "The photograph: PNG, JPEG, TIFF or OpenEXR")->required();
	c->add_option("B", o->b, "The render that is brought to A's brightness")->required();
	c->add_option("--line", o->lines, "x0,y0,x1,y1 in pixels, (0,0) the centre of the top left one; may be repeated");
	c->add_option("--match", o->match, "none, gain (one factor) or shading (polynomial of order 4 over the picture)")->capture_default_str();
	c->add_option("--transfer", o->transfer, "Transfer curve of 8 and 16 bit pictures: srgb, linear or a gamma; OpenEXR is linear")->capture_default_str();
	c->add_option("--transfer-a", o->transfer_a, "The same for A alone");
	c->add_option("--transfer-b", o->transfer_b, "The same for B alone");
	c->add_option("--out", o->out, "Folder for profile-N.csv, profile.png and side-by-side.png; created if missing")->capture_default_str();
	c->add_option("--json", o->json, "FILE for the results as JSON");
	c->footer("Example:\n  tiltcal profile photo.png render.exr --line 0,660,1799,660 --line 900,0,900,1199 --match shading --out profiles\n\n"
		"Brightness is 0 to 255: the sRGB code of the luminance. The match is fitted in linear light, robustly,\n"
		"over the whole picture, and printed.\n"
		"Exit codes: 0 done, 1 refused (sizes differ), 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
