// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The target's page through cairo: one drawing in millimetres, two kinds of file.

#include "target/target.h"

#include "lens/angles.h"
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tiltcal
{

namespace
{

const double POINTS_PER_MM = 72 / 25.4;

struct SurfaceEnd { void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); } };
struct ContextEnd { void operator()(cairo_t* c) const { cairo_destroy(c); } };
using Surface = std::unique_ptr<cairo_surface_t, SurfaceEnd>;
using Context = std::unique_ptr<cairo_t, ContextEnd>;

void DrawPattern(cairo_t* c, const TargetPage& page)
{
	if (page.target.IsCheckerboard())
		for (const PagePoint& p : BlackSquares(page))
			cairo_rectangle(c, p.x, p.y, page.target.square_mm, page.target.square_mm);
	else
		for (const PagePoint& p : CircleCentres(page))
		{
			cairo_new_sub_path(c);
			cairo_arc(c, p.x, p.y, 0.5 * page.target.circle_diameter_mm, 0, 2 * tilt_lens::Pi);
		}
	cairo_fill(c);
}

/// Text with its baseline at (x, y), `size` high, smaller where `width` is not enough.
void DrawText(cairo_t* c, double x, double y, double size, double width, const std::string& text)
{
	cairo_set_font_size(c, size);
	cairo_text_extents_t extents;
	cairo_text_extents(c, text.c_str(), &extents);
	if (extents.x_advance > width)
		cairo_set_font_size(c, size * width / extents.x_advance);
	cairo_move_to(c, x, y);
	cairo_show_text(c, text.c_str());
}

/// An arrow towards the target's upper edge, 6 mm high.
void DrawUp(cairo_t* c, double x, double y)
{
	cairo_move_to(c, x + 2, y);
	cairo_line_to(c, x + 4, y + 3);
	cairo_line_to(c, x, y + 3);
	cairo_close_path(c);
	cairo_rectangle(c, x + 1.4, y + 3, 1.2, 3);
	cairo_fill(c);
	DrawText(c, x + 4.6, y + 6, 3.2, 7, "up");
}

/// A ruler of SCALE_BAR_MM: black and white in turn by 10 mm, its outer ends are the measure.
void DrawScaleBar(cairo_t* c, double x, double y)
{
	const double step = 10, height = 2.5, line = 0.2;
	for (int i = 0; i * step < SCALE_BAR_MM; i += 2)
		cairo_rectangle(c, x + i * step, y, step, height);
	cairo_rectangle(c, x, y, SCALE_BAR_MM, line);
	cairo_rectangle(c, x, y + height - line, SCALE_BAR_MM, line);
	cairo_rectangle(c, x + SCALE_BAR_MM - line, y, line, height);
	cairo_fill(c);
	DrawText(c, x, y + height + 3.6, 3.2, 20, "0");
	DrawText(c, x + SCALE_BAR_MM - 12, y + height + 3.6, 3.2, 20, fmt::format("{:g} mm", SCALE_BAR_MM));
}

void DrawStrip(cairo_t* c, const TargetPage& page)
{
	const PagePoint& s = page.strip;
	const double width = page.width - 2 * s.x;
	DrawUp(c, s.x, s.y + 1);
	DrawScaleBar(c, s.x + 14, s.y + 1);
	DrawText(c, s.x, s.y + 13.5, 3.6, width, fmt::format("{}, pattern {:.6g} x {:.6g} mm", Describe(page.target), page.pattern_width, page.pattern_height));
	DrawText(c, s.x, s.y + 18.5, 3.6, width, fmt::format("Print at 100 % (no fit to page), check the scale bar: {:g} mm", SCALE_BAR_MM));
}

/// Everything, in mm. False when cairo could not write it.
bool Print(const TargetPage& page, Surface surface, double units_per_mm)
{
	Context context(cairo_create(surface.get()));
	cairo_t* const c = context.get();
	cairo_scale(c, units_per_mm, units_per_mm);
	cairo_set_source_rgb(c, 1, 1, 1);
	cairo_paint(c);
	cairo_set_source_rgb(c, 0, 0, 0);
	cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
	DrawPattern(c, page);
	DrawStrip(c, page);
	cairo_show_page(c);
	const bool drawn = cairo_status(c) == CAIRO_STATUS_SUCCESS;
	cairo_surface_finish(surface.get());
	return drawn && cairo_surface_status(surface.get()) == CAIRO_STATUS_SUCCESS;
}

}

bool PrintSvg(const TargetPage& page, const std::string& file)
{
	Surface surface(cairo_svg_surface_create(file.c_str(), page.width, page.height));
	cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_MM);
	return Print(page, std::move(surface), 1);
}

bool PrintPdf(const TargetPage& page, const std::string& file)
{
	Surface surface(cairo_pdf_surface_create(file.c_str(), page.width * POINTS_PER_MM, page.height * POINTS_PER_MM));
	cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, Describe(page.target).c_str());
	cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATOR, "tiltcal " TILTCAL_VERSION);
	return Print(page, std::move(surface), POINTS_PER_MM);
}

}
