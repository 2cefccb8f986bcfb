// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The target as a POV-Ray object that emits exact radiances.

#include "target/target.h"

#include <fmt/format.h>

namespace tiltcal
{

namespace
{

/// #declare TiltCal_Target_<name> = <value>;
std::string Number(const std::string& name, double value, const std::string& comment)
{
	return fmt::format("#declare TiltCal_Target_{} = {:.10g};   // {}\n", name, value, comment);
}

std::string Polygon(double left, double bottom, double right, double top, const std::string& z)
{
	return fmt::format("polygon {{ 5, <{0:.10g}, {1:.10g}, {4}>, <{2:.10g}, {1:.10g}, {4}>, <{2:.10g}, {3:.10g}, {4}>, <{0:.10g}, {3:.10g}, {4}>, <{0:.10g}, {1:.10g}, {4}>",
		left, bottom, right, top, z);
}

}

std::string TargetInc(const TargetPage& page)
{
	const Board& t = page.target;
	const PagePoint origin = Origin(page);
	const auto x = [&](double page_x) { return page_x - origin.x; };
	const auto y = [&](double page_y) { return origin.y - page_y; };

	std::string out = fmt::format(
		"// A calibration target, written by tiltcal {}: {}, on its page of {}.\n"
		"// Frame: mm, origin at the first {}, x along the columns, y up the rows, z into the board.\n"
		"// Radiance is exact: it emits, and takes no light. Use: object {{ TiltCal_Target }}\n\n"
		"#ifndef (TiltCal_Target_Black)\n\t#declare TiltCal_Target_Black = 0;   // linear light\n#end\n"
		"#ifndef (TiltCal_Target_White)\n\t#declare TiltCal_Target_White = 0.8;   // as paper; at 1 a picture clips it\n#end\n",
		TILTCAL_VERSION, Describe(t), page.paper, t.IsCheckerboard() ? "inner corner" : "circle's centre");
	out += Number("Columns", t.columns, t.IsCheckerboard() ? "squares" : "circles");
	out += Number("Rows", t.rows, t.IsCheckerboard() ? "squares" : "circles");
	out += Number("Square", t.square_mm, t.IsCheckerboard() ? "mm, side of a square" : "mm, spacing");
	if (!t.IsCheckerboard())
		out += Number("Circle_Diameter", t.circle_diameter_mm, "mm");
	out += Number("Left", x(0), "mm, the page's edges") + Number("Right", x(page.width), "mm") + Number("Bottom", y(page.height), "mm") + Number("Top", y(0), "mm");

	// Beside every pigment: a union's finish does not reach parts that have a pigment of their own.
	out += "#declare TiltCal_Target_Finish = finish { emission 1 ambient 0 diffuse 0 };\n";
	out += "\n#declare TiltCal_Target = union {\n\t// The paper: 0.001 mm behind the pattern, which no picture can show.\n\t"
		+ Polygon(x(0), y(page.height), x(page.width), y(0), "0.001") + " pigment { color rgb TiltCal_Target_White } finish { TiltCal_Target_Finish } }\n\tunion {\n";
	if (t.IsCheckerboard())
		for (const PagePoint& p : BlackSquares(page))
			out += "\t\t" + Polygon(x(p.x), y(p.y + t.square_mm), x(p.x + t.square_mm), y(p.y), "0") + " }\n";
	else
		for (const PagePoint& p : CircleCentres(page))
			out += fmt::format("\t\tdisc {{ <{:.10g}, {:.10g}, 0>, z, {:.10g} }}\n", x(p.x), y(p.y), 0.5 * t.circle_diameter_mm);
	return out + "\t\tpigment { color rgb TiltCal_Target_Black } finish { TiltCal_Target_Finish }\n\t}\n}\n";
}

}
