// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/commands.h"

#include "program/program.h"
#include "program/progress.h"
#include <tiltcal/photo.h>
#include <tiltcal/error.h>
#include "base/file_set.h"
#include "base/files.h"
#include "base/output_place.h"
#include "picture/image_io.h"
#include "measure/measure.h"
#include "report/overlay.h"
#include "report/write_csv.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <memory>

namespace tiltcal
{

namespace
{

struct Options
{
	std::string board, target = "checkerboard", transfer = "srgb", csv, overlay;
	double square = 1, circle_diameter = 0;
	std::vector<std::string> photos;
	DetectOptions detect;
};

/// FILE with -edges before the suffix.
std::string EdgesName(const std::string& file)
{
	const std::filesystem::path path(file);
	return (path.parent_path() / (path.stem().string() + "-edges" + path.extension().string())).string();
}

/// DIR/N-NAME.png: photographs of several folders may have one name.
std::string OverlayName(const std::string& folder, size_t number, const std::string& file)
{
	return (std::filesystem::path(folder) / fmt::format("{}-{}.png", number, std::filesystem::path(file).stem().string())).string();
}

void Run(const Options& o)
{
	// The side of a square plays no part in pixels, only its ratio to the circles.
	const Board board = MakeBoard(ParseTargetKind(o.target, "--target"), o.board, o.square, o.circle_diameter, "--target");
	const Transfer transfer = ParseTransfer(o.transfer);
	const std::vector<std::string> files = ExpandGlobs(o.photos, "PHOTO");
	PrepareFolderOf(o.csv);
	if (!o.overlay.empty())
		PrepareFolder(o.overlay, "overlay");
	FileSet set;
	std::vector<Photo> photos;
	std::string found;
	auto progress = std::make_unique<Progress>("measuring", files.size());
	for (const std::string& file : files)
	{
		cv::Mat grey;
		photos.push_back(MeasurePhoto(file, board, transfer, o.detect, {}, &grey));
		const Photo& p = photos.back();
		spdlog::info("[{}/{}] {}: {}", photos.size(), files.size(), file, CountText(p));
		found += fmt::format("{}: {}, {} {} left out, {}\n", file, CountText(p), p.edges_dropped, board.IsCheckerboard() ? "edges" : "arcs", RatioText(p));
		if (!o.overlay.empty())
			set.Text(OverlayName(o.overlay, photos.size(), file), PngOf(DrawMeasured(grey, p)));
		progress->Done(photos.size());
	}
	progress.reset();
	fmt::print(ReportBeside({ o.csv }), "{}", found);
	// Nothing lies beside a device.
	if (!PlaceOf(o.csv).through)
		set.Text(EdgesName(o.csv), EdgesCsv(photos));
	set.Text(o.csv, CornersCsv(photos));
	set.Commit();
}

}

void AddDetect(CLI::App& app)
{
	auto o = std::make_shared<Options>();
	CLI::App* c = app.add_subcommand("detect", "Corners of a checkerboard and blur widths of its edges, or centres and outlines of a grid of circles, as CSV.");
	c->add_option("--board", o->board, "Squares of the board, columns x rows, such as 12x9 (squares, not inner corners); of the other targets circles")->required();
	c->add_option("--target", o->target, "checkerboard, circles or asymmetric-circles, as tiltcal target --kind prints them")->capture_default_str();
	c->add_option("--square", o->square, "Spacing of circles, mm (asymmetric: distance of rows); wanted only with --circle-diameter")->capture_default_str();
	c->add_option("--circle-diameter", o->circle_diameter, "Diameter of a circle, mm; 0: half the distance of neighbouring centres")->capture_default_str();
	c->add_option("photos", o->photos, "PHOTO...: pictures, names or quoted patterns")->required();
	c->add_option("--csv", o->csv, "FILE for the corners; the edges go to FILE with -edges before the suffix")->required();
	c->add_option("--overlay", o->overlay, "DIR for pictures of what was measured: corners, edges and their blur discs; created if missing");
	c->add_option("--transfer", o->transfer, "Transfer curve of 8 and 16 bit pictures: srgb, linear or a gamma; OpenEXR is linear")->capture_default_str();
	c->add_flag("--any-orientation", o->detect.any_orientation, "Accept a board that stands upside down (a mirrored picture looks the same)");
	c->footer("Example:\n  tiltcal detect --board 12x9 'target/untilted-*.png' --csv corners.csv\n\n"
		"Columns: file,column,row,x_px,y_px,sigma_px and file,x_px,y_px,nx,ny,blur_px,sigma_px;\n"
		"pixel centres at integers, (0, 0) top left, y downwards; blur is the diameter of the blur disc.\n"
		"Blur radii up to 0.5 of a square are measured; more blurred photographs are refused. Above 0.4 corners and\n"
		"widths are rough, and their sigmas too small by up to three times.\n"
		"Circles, dark on white or white on dark: the corners are the images of the circles' centres, column and row their\n"
		"places in spacings (asymmetric: 0, 2, 4, .. and 1, 3, 5, ..), the edges parts of their outlines. Circles must be some 12\n"
		"pixels across; blur radii up to 0.6 of a circle's are measured. Circles look the same turned by 180\n"
		"degrees, as many columns as rows by 90: the picture's top left circle is the first. Asymmetric grids need an odd\n"
		"number of rows.\n"
		"Exit codes: 0 done, 1 refused, 2 wrong usage, 3 unreadable or unwritable file.");
	c->callback([o] { Run(*o); });
}

}
