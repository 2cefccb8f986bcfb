// SPDX-License-Identifier: AGPL-3.0-or-later

#include "target/target.h"

#include <tiltcal/error.h>
#include "base/file_set.h"
#include "base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace tiltcal
{

namespace
{

struct Paper
{
	const char* name;
	double shorter, longer;   // mm
};

/// ISO 216, smallest first; then ANSI and US sizes.
const Paper PAPERS[] = { { "a5", 148, 210 }, { "a4", 210, 297 }, { "a3", 297, 420 }, { "a2", 420, 594 }, { "a1", 594, 841 }, { "a0", 841, 1189 },
	{ "letter", 215.9, 279.4 }, { "legal", 215.9, 355.6 }, { "tabloid", 279.4, 431.8 } };
const size_t ISO_PAPERS = 6;

/// The strip: scale bar with its label, two lines of text.
const double STRIP_HEIGHT = 20, STRIP_WIDTH = SCALE_BAR_MM + 16;
/// Rounding of paper sizes given in decimal; far below what a printer can place.
const double SLACK = 1e-6;

struct Size
{
	double width = 0, height = 0;
};

Size PatternSize(const Board& t)
{
	switch (t.kind)
	{
	case TargetKind::CHECKERBOARD: return { t.columns * t.square_mm, t.rows * t.square_mm };
	case TargetKind::CIRCLES: return { (t.columns - 1) * t.square_mm + t.circle_diameter_mm, (t.rows - 1) * t.square_mm + t.circle_diameter_mm };
	case TargetKind::ASYMMETRIC_CIRCLES: break;
	}
	return { (2 * t.columns - 1) * t.square_mm + t.circle_diameter_mm, (t.rows - 1) * t.square_mm + t.circle_diameter_mm };
}

/// Half a square stays white: what detectors need beyond the outermost squares. The same
/// for circles beyond their rims.
double Quiet(const Board& t) { return 0.5 * t.square_mm; }

/// The least page.
Size Needed(const Board& t, double margin)
{
	const Size pattern = PatternSize(t);
	return { std::max(pattern.width + 2 * Quiet(t), STRIP_WIDTH) + 2 * margin, pattern.height + 2 * Quiet(t) + STRIP_HEIGHT + 2 * margin };
}

bool Holds(const Size& page, const Size& needed) { return page.width >= needed.width - SLACK && page.height >= needed.height - SLACK; }

/// Portrait where it fits, else landscape; width 0 when neither does.
Size Turned(const Paper& paper, const Size& needed)
{
	const Size portrait{ paper.shorter, paper.longer }, landscape{ paper.longer, paper.shorter };
	return Holds(portrait, needed) ? portrait : Holds(landscape, needed) ? landscape : Size{};
}

std::string NamesOfPapers()
{
	std::string names;
	for (const Paper& p : PAPERS)
		names += std::string(names.empty() ? "" : ", ") + p.name;
	return names;
}

[[noreturn]] void RefusePaper(const Board& t, const std::string& paper, const Size& needed)
{
	std::string better;
	for (size_t i = 0; i < ISO_PAPERS && better.empty(); ++i)
		if (Turned(PAPERS[i], needed).width > 0)
			better = fmt::format("--paper {} holds it", PAPERS[i].name);
	if (better.empty())
		better = fmt::format("give --paper {:.0f}x{:.0f} for a plotter, or a smaller --square", std::ceil(needed.width), std::ceil(needed.height));
	throw Refused(fmt::format("--paper {}: {} needs a page of {:.4g} x {:.4g} mm with its white zone, text and margins: {}",
		paper, Describe(t), needed.width, needed.height, better));
}

/// The page's size; `name` receives what to call it.
Size ChoosePaper(const Board& t, const std::string& text, const Size& needed, std::string& name)
{
	const size_t x = std::min(text.find('x'), text.size());
	const double w = FiniteNumber(text.substr(0, x)).value_or(0), h = FiniteNumber(text.substr(std::min(x + 1, text.size()))).value_or(0);
	if (w > 0 && h > 0 && std::isfinite(w * h))
	{
		name = fmt::format("{:g} x {:g} mm", w, h);
		if (!Holds({ w, h }, needed))
			RefusePaper(t, text, needed);
		return { w, h };
	}
	bool known = text == "auto";
	for (size_t i = 0; i < std::size(PAPERS); ++i)
	{
		const Paper& paper = PAPERS[i];
		if (text != paper.name && !(text == "auto" && i < ISO_PAPERS))
			continue;
		known = true;
		const Size size = Turned(paper, needed);
		if (size.width > 0)
		{
			name = fmt::format("{} {}", paper.name, size.width < size.height ? "portrait" : "landscape");
			return size;
		}
	}
	if (!known)
		throw UsageError(fmt::format("--paper {}: there is auto, {}, or WxH in mm such as 420x297", text, NamesOfPapers()));
	RefusePaper(t, text, needed);
}

}

TargetPage LayOut(const Board& target, const std::string& paper, double margin_mm)
{
	if (!(margin_mm >= 0) || !std::isfinite(margin_mm))
		throw UsageError(fmt::format("--margin {}: give the width of the unprinted rim in mm, 0 or more", margin_mm));
	const Size pattern = PatternSize(target);
	TargetPage page;
	page.target = target;
	const Size size = ChoosePaper(target, paper, Needed(target, margin_mm), page.paper);
	page.width = size.width;
	page.height = size.height;
	page.pattern_width = pattern.width;
	page.pattern_height = pattern.height;
	page.quiet = Quiet(target);
	page.strip = { margin_mm, page.height - margin_mm - STRIP_HEIGHT };
	// In the middle of what the margin and the strip leave.
	page.pattern = { 0.5 * (page.width - pattern.width), 0.5 * (margin_mm + page.strip.y - pattern.height) };
	return page;
}

std::vector<PagePoint> CircleCentres(const TargetPage& page)
{
	const Board& t = page.target;
	const PagePoint first = Origin(page);
	std::vector<PagePoint> centres;
	for (int j = 0; j < t.rows; ++j)
		for (int i = 0; i < t.columns; ++i)
		{
			const int steps = t.kind == TargetKind::CIRCLES ? i : 2 * i + j % 2;
			centres.push_back({ first.x + steps * t.square_mm, first.y + j * t.square_mm });
		}
	return centres;
}

std::vector<PagePoint> BlackSquares(const TargetPage& page)
{
	const Board& t = page.target;
	std::vector<PagePoint> squares;
	for (int j = 0; j < t.rows; ++j)
		for (int i = j % 2; i < t.columns; i += 2)
			squares.push_back({ page.pattern.x + i * t.square_mm, page.pattern.y + j * t.square_mm });
	return squares;
}

PagePoint Origin(const TargetPage& page)
{
	const double inwards = page.target.IsCheckerboard() ? page.target.square_mm : 0.5 * page.target.circle_diameter_mm;
	return { page.pattern.x + inwards, page.pattern.y + inwards };
}

bool LooksTheSameTurned(const Board& t)
{
	switch (t.kind)
	{
	case TargetKind::CHECKERBOARD: return (t.columns + t.rows) % 2 == 0;
	case TargetKind::CIRCLES: return true;
	case TargetKind::ASYMMETRIC_CIRCLES: break;
	}
	// The last row is moved where the first is not: turned, they change places.
	return t.rows % 2 == 0;
}

void CheckTargetSuffix(const std::string& file)
{
	const std::string suffix = std::filesystem::path(file).extension().string();
	if (suffix != ".svg" && suffix != ".pdf" && suffix != ".inc")
		throw UsageError(fmt::format("--out {}: the suffix says what to write: .pdf or .svg to print, .inc for POV-Ray", file));
}

void WriteTarget(const TargetPage& page, const std::string& file)
{
	FileSet set;
	WriteTarget(page, file, set);
	set.Commit();
}

void WriteTarget(const TargetPage& page, const std::string& file, FileSet& set)
{
	CheckTargetSuffix(file);
	const std::string suffix = std::filesystem::path(file).extension().string();
	if (suffix == ".inc")
		set.Text(file, TargetInc(page));
	else
		set.Write(file, [&](const std::string& temporary) { return (suffix == ".svg" ? PrintSvg : PrintPdf)(page, temporary); });
}

}
