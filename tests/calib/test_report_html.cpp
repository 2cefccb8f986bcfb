// SPDX-License-Identifier: AGPL-3.0-or-later
//
// report.html of synthetic calibrations: well-formed, self-contained, complete, and the sketch against Merklinger's hinge rule.

#include <tiltcal/calibrate.h>
#include "base/plain_text.h"
#include "plane_page/plane_page.h"
#include "report/html.h"
#include "support/page_check.h"
#include "report/report_html.h"
#include "report/report_scene.h"
#include "support/synthetic_lens.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

namespace
{

using namespace tiltcal;
using synthetic::Lens;
using synthetic::Noise;
using synthetic::Tilted;
using testing::HasSubstr;

const char* const SPECIAL = "<b>&'\".png";

/// Names for the photographs, and sides of squares, which the synthetic lens leaves out.
State Named(State state)
{
	for (size_t p = 0; p < state.photos.size(); ++p)
	{
		state.photos[p].file = "folder/" + state.name + "-" + std::to_string(p + 1) + SPECIAL;
		for (Edge& e : state.photos[p].edges)
			e.square_px = 90;
	}
	return state;
}

Calibration CalibrationOf(const Lens& tilted, Model model, int photos = 6)
{
	const Noise noise{ 0.03, 0.06, 3 };
	return Calibrate(synthetic::MakeTask({ Named(synthetic::Photograph("untilted", {}, noise, photos)), Named(synthetic::Photograph("tilted", tilted, noise, photos)) }), { model, Poses::AUTO });
}

std::string PageOf(const Calibration& c)
{
	ReportPictures pictures(c.task);
	for (const State& state : c.task.states)
		for (size_t p = 0; p < state.photos.size(); ++p)
			pictures.Add(cv::Mat(c.task.height + 96, c.task.width, CV_8UC3, cv::Scalar(10, 20 * double(p), 90)));
	return ReportHtml(c, { "edges", "tiltcal calibrate --out '<out>'", "2000-01-01 00:00 UTC" }, pictures);
}

/// Everything that holds of every page.
void ExpectGoodPage(const Calibration& c)
{
	const std::string html = PageOf(c);
	const Page page = ReadPage(html);
	EXPECT_EQ(page.complaint, "");
	EXPECT_EQ(OutsideResource(page, html), "");
	EXPECT_THAT(page.text, HasSubstr("--out '<out>'"));
	size_t photos = 0;
	for (const State& state : c.task.states)
		for (size_t p = 0; p < state.photos.size(); ++p, ++photos)
			EXPECT_THAT(page.text, HasSubstr(state.name + "-" + std::to_string(p + 1) + SPECIAL));
	size_t images = 0;
	for (const PageElement& element : page.elements)
	{
		images += element.name == "img";
		for (const auto& [name, value] : element.attributes)
		{
			if (name == "d" || name == "x" || name == "y" || name == "x1" || name == "cx" || name == "viewBox")
			{
				EXPECT_EQ(value.find_first_not_of("0123456789.- MLZhvlm"), std::string::npos) << element.name << " " << name << "=" << value.substr(0, 200);
			}
		}
	}
	EXPECT_EQ(images, photos);
	for (const char* const word : { "nan", "inf ", "-nan" })
		EXPECT_EQ(page.text.find(word), std::string::npos) << word;
	EXPECT_EQ(page.Find("svg", "sketch").size(), c.task.states.size());
	EXPECT_EQ(page.Find("div", "plane").size(), c.task.states.size());
	EXPECT_EQ(page.Find("div", "plane-still").size(), c.task.states.size());
}

TEST(ReportHtml, IsWellFormedAndSelfContained)
{
	for (const Model model : { Model::PLANE, Model::RIGID, Model::CURVED, Model::PAPER })
	{
		SCOPED_TRACE(NameOf(model));
		ExpectGoodPage(CalibrationOf(Tilted(5, 30), model, 3));
	}
}

TEST(ReportHtml, LiveSketchKeepsItsTextsInsideItsScript)
{
	const std::string part = PlanePart("{\"remarks\": [\"</script><b>&amp;<!--\"]}");
	EXPECT_THAT(part, HasSubstr("\\u003c/script\\u003e\\u003cb\\u003e\\u0026amp;\\u003c!--"));
	EXPECT_EQ(part.find("</script>"), part.rfind("</script>"));
	const std::string page = PlanePage("<b>&", "", "{}");
	EXPECT_THAT(page, HasSubstr("<h1>&lt;b&gt;&amp;</h1>"));
	EXPECT_EQ(ReadPage(page).complaint, "");
}

TEST(ReportHtml, OfOnePhotographAState)
{
	ExpectGoodPage(CalibrationOf(Tilted(5, 0), Model::PLANE, 1));
}

TEST(ReportHtml, WithoutTiltedStates)
{
	const Noise noise{ 0.03, 0.06, 3 };
	const Calibration c = Calibrate(synthetic::MakeTask({ Named(synthetic::Photograph("untilted", {}, noise, 3)) }), { std::nullopt, Poses::AUTO });
	ExpectGoodPage(c);
	EXPECT_THAT(ReadPage(PageOf(c)).text, HasSubstr("No tilted state"));
}

TEST(ReportHtml, PicturesShareTheirRoom)
{
	// 40 pictures of noise, which JPEG cannot make small, may not exceed 15 MB by much: no less than 480 px each.
	Task task;
	task.width = 1200;
	task.height = 800;
	task.states.resize(1);
	task.states[0].photos.resize(40);
	ReportPictures pictures(task);
	cv::Mat noise(896, 1200, CV_8UC3);
	cv::randu(noise, 0, 255);
	pictures.Add(noise);
	EXPECT_LT(pictures.Uri(0).size(), 15000000u / 40);
	EXPECT_EQ(pictures.Uri(0).rfind("data:image/jpeg;base64,/9j/", 0), 0u);   // FF D8 FF in base64
	EXPECT_EQ(pictures.Uri(1), "");
}

struct Case
{
	double tilt, direction;
};

class SketchOf : public testing::TestWithParam<Case> {};

double Of(const PageElement& element, const char* name) { return std::stod(element.attributes.at(name)); }

/// Merklinger, "The Ins and Outs of Focus": the hinge lies f / sin(tilt) from the lens, in the plane through it parallel
/// to the sensor, and the plane of focus passes through it and, on the axis, through U.
TEST_P(SketchOf, PlaneThroughHinge)
{
	const Lens lens = Tilted(GetParam().tilt, GetParam().direction);
	const Calibration c = CalibrationOf(lens, Model::PLANE);
	const Page page = ReadPage("<!DOCTYPE html><html>" + SceneSvg(c, 1) + "</html>");
	ASSERT_EQ(page.complaint, "");
	const auto sides = page.Find("g", "side");
	const auto hinges = page.Find("circle", "hinge");
	const auto traces = page.Find("line", "plane-trace");
	ASSERT_EQ(sides.size(), 1u);
	ASSERT_EQ(hinges.size(), 1u);
	ASSERT_EQ(traces.size(), 1u);
	const double scale = Of(sides[0], "data-px-per-mm"), x0 = Of(sides[0], "data-axis-x"), y0 = Of(sides[0], "data-axis-y");
	const double hinge_x = Of(hinges[0], "cx"), hinge_y = Of(hinges[0], "cy");
	// Coordinates are written to 0.001.
	EXPECT_NEAR(hinge_x, x0, 0.002);
	// 0.06 px of noise move the tilt by some 0.005 degrees, a thousandth of it, and the hinge as much: three of these.
	const double distance = lens.f / std::sin(std::abs(lens.tilt) * M_PI / 180);
	EXPECT_NEAR(std::abs(hinge_y - y0) / scale, distance, 0.005 * distance);
	// The hinge is below (y down: larger) when the plane recedes upwards.
	EXPECT_EQ(hinge_y > y0, c.solution.states[1].lens_tilt.value > 0);
	// The trace's ends are written to 0.01; the hinge is one of them.
	const double x1 = Of(traces[0], "x1"), y1 = Of(traces[0], "y1"), x2 = Of(traces[0], "x2"), y2 = Of(traces[0], "y2");
	const double off = std::abs((x2 - x1) * (hinge_y - y1) - (y2 - y1) * (hinge_x - x1)) / std::hypot(x2 - x1, y2 - y1);
	EXPECT_LT(off, 0.02);
	const double crossing = x1 + (x2 - x1) * (y0 - y1) / (y2 - y1);
	EXPECT_NEAR((crossing - x0) / scale, lens.FocusDistance(), 0.003 * lens.FocusDistance());
}

INSTANTIATE_TEST_SUITE_P(Tilts, SketchOf, testing::Values(Case{ -5, 0 }, Case{ 5, 30 }, Case{ -4, 80 }), [](const auto& tested) { return "case" + std::to_string(tested.index); });

/// The hard cases of povray-patch/lens/MODEL.md: planes at infinity, parallel to the axis, behind the lens, nearly so.
TEST(ReportHtml, SketchOfEveryPlane)
{
	Calibration c = CalibrationOf(Tilted(5, 0), Model::PLANE, 2);
	const double infinity = std::numeric_limits<double>::infinity();
	const std::pair<Vec3<double>, double> planes[] = { { { 0, 0, 0 }, infinity }, { { 0, -1 / 500.0, 0 }, infinity }, { { 1 / 300.0, 0, 1e-12 }, 1e12 }, { { 0, -0.001, -0.001 }, -1000 },
		{ { 0, 0, 1e-30 }, 1e30 }, { { 0.0001, 0, 1 / 5.0 }, 5 }, { { 1e-8, 1e-8, 1 / 600.0 }, 600 } };
	for (const auto& [q, U] : planes)
	{
		SCOPED_TRACE(testing::Message() << q.x << " " << q.y << " " << q.z);
		c.solution.states[1].q = q;
		c.solution.states[1].focus_distance.value = U;
		const std::string sketch = SceneSvg(c, 1);
		for (const char* const word : { "nan", "inf\"", "inf " })
			EXPECT_EQ(sketch.find(word), std::string::npos) << word;
		const Page page = ReadPage("<!DOCTYPE html><html>" + sketch + "</html>");
		EXPECT_EQ(page.complaint, "");
		// The drawing is there, at a scale at which something is seen: the boards reach 800 mm, the panel has 520 units.
		ASSERT_EQ(page.Find("g", "side").size(), 1u);
		EXPECT_GT(Of(page.Find("g", "side")[0], "data-px-per-mm"), 0.1);
		// The oblique view is not collapsed: the first thing in it is a side of the frustum, most of the panel long.
		double x1, y1, x2, y2;
		const size_t oblique = sketch.find("class=\"oblique\"");
		ASSERT_EQ(std::sscanf(sketch.c_str() + sketch.find("<path d=", oblique), "<path d=\"M%lf %lfL%lf %lf", &x1, &y1, &x2, &y2), 4);
		EXPECT_GT(std::hypot(x2 - x1, y2 - y1), 100);
	}
}

TEST(Html, EscapesWhatMarkupWouldTakeForItsOwn)
{
	EXPECT_EQ(HtmlText("<b>&'\".png"), "&lt;b&gt;&amp;&#39;&quot;.png");
	EXPECT_EQ(HtmlText("caf\xC3\xA9"), "caf\xC3\xA9");
	// A byte that is no UTF-8, half a character, an overlong slash, a surrogate, a control character.
	EXPECT_EQ(HtmlText("a\xE9z"), "a\xEF\xBF\xBDz");
	EXPECT_EQ(HtmlText("a\xC3"), "a\xEF\xBF\xBD");
	EXPECT_EQ(HtmlText("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");
	EXPECT_EQ(HtmlText("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");
	EXPECT_EQ(HtmlText("\x1B[0m"), "\xEF\xBF\xBD[0m");
}

TEST(Html, NumbersAreNeverNaN)
{
	const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
	EXPECT_EQ(html::Number(nan, 2), "–");
	EXPECT_EQ(html::Number(infinity, 2), "∞");
	EXPECT_EQ(html::Number(-0.0004, 2), "0.00");
	EXPECT_EQ(html::WithSigma({ 618.4213, 0.314 }, "mm"), "618.42 ± 0.31 mm");
	EXPECT_EQ(html::WithSigma({ -5.05, 0.0123 }, "°"), "−5.050 ± 0.012°");
	EXPECT_EQ(html::WithSigma({ 5, nan }, "mm", 1), "5.0 mm");
	EXPECT_EQ(html::WithSigma({ infinity, 1 }, "mm", 1), "∞");
}

}
