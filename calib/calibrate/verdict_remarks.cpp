// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/verdict_remarks.h"

#include "calibrate/check_light.h"
#include "calibrate/left_over.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

/// A check with a thousand corners behind it sees what no render shows: said are findings this many sigma from nothing..
const double SURE = 5;
/// ..without which the corners fit better by a tenth, so that it is not one aberration among others,
const double WORTH_SAYING = 0.9;
/// or by half, so that it is what limits the calibration.
const double DECIDES = 0.5;

/// Degrees: what tilts are known to in a good calibration, and ten times that.
const double TILT_SEEN = 0.05, TILT_LARGE = 0.5;

double Share(double part, double whole) { return whole > 0 ? part / whole : 1; }

const std::string& FileOf(const Task& task, size_t state, size_t photo) { return task.states[state].photos[photo].file; }

void AddOdd(const Calibration& c, const PhotographCheck& p, std::vector<Remark>& remarks)
{
	const std::string who = fmt::format("state {}: {}: ", c.task.states[p.state].name, FileOf(c.task, p.state, p.photo));
	if (p.odd_blur)
	{
		std::string advice = p.fits_state ? fmt::format("it fits the lens of state {}: file it there", c.task.states[*p.fits_state].name)
			: std::string("was the lens tilted, focused or stopped otherwise, or the camera shaken? Leave it out or file it in its own state");
		// Nobody is to throw away, or to file elsewhere, what is right.
		if (LightMayExplain(c, p))
			advice = "what was done to its light is enough for that, and misleads the fit of all photographs: mend the light, and look again before you leave it out";
		remarks.push_back({ Grade::POOR, who + fmt::format("its blur fits to {:.2f} px, that of the others to {:.2f} px; ", p.rms_blur, p.blur_typical) + advice });
	}
	if (p.odd_places)
		remarks.push_back({ Grade::POOR, who + fmt::format("its corners fit to {:.2f} px, those of the others to {:.2f} px: is it of the same camera and board? Leave it out, and look", p.rms_places, p.places_typical) });
}

/// "the squares are 1.00 +- 0.01 % wider than high", ..; empty where nothing is sure.
std::string ShapeWords(const BoardCheck& b)
{
	std::string words;
	const auto add = [&](const Estimate& e, const std::string& text)
	{
		if (std::abs(e.value) > SURE * e.sigma)
			words += (words.empty() ? "" : ", ") + text;
	};
	add(b.widening, fmt::format("its squares are {:.3f} +- {:.3f} % {} than high (or the pixels are)", 100 * std::abs(b.widening.value), 100 * b.widening.sigma, b.widening.value > 0 ? "wider" : "narrower"));
	add(b.bend_along_columns, fmt::format("it is bent by {:.2f} +- {:.2f} mm over its width", std::abs(b.bend_along_columns.value), b.bend_along_columns.sigma));
	add(b.bend_along_rows, fmt::format("it is bent by {:.2f} +- {:.2f} mm over its height", std::abs(b.bend_along_rows.value), b.bend_along_rows.sigma));
	add(b.twist, fmt::format("its corners are twisted by {:.2f} +- {:.2f} mm", std::abs(b.twist.value), b.twist.sigma));
	return words;
}

/// Aberrations act within every photograph: three numbers for each do not halve them. What a real lens explains is no focus that moved.
bool FocusMoved(const Calibration& c)
{
	const FocusCheck& f = c.focus_check;
	const double together = c.RealLensIsUsed() ? std::min(f.rms_together, c.real_lens->rms_blur) : f.rms_together;
	return f.known && together > MOST_OF_NOISE * NoiseOfBlur(c.task) && f.rms_apart < DECIDES * together;
}

}

std::vector<Remark> JudgePhotographs(const Calibration& c)
{
	std::vector<Remark> remarks;
	for (const PhotographCheck& p : c.photographs)
	{
		AddOdd(c, p, remarks);
		if (p.same_as)
			remarks.push_back({ Grade::FAIR, fmt::format("{} and {} are the same photograph, noise and all: it is counted twice, and the sigmas are too small; leave one out",
				FileOf(c.task, p.state, p.photo), FileOf(c.task, p.same_as->first, p.same_as->second)) });
	}
	if (FocusMoved(c))
		remarks.push_back({ Grade::POOR, fmt::format("the blur fits to {:.2f} px with one plane of focus a state, to {:.2f} px with one for each photograph: the lens did not stand still between photographs of a state{}. "
			"Switch autofocus off, touch neither focus nor tilt, and photograph again", c.focus_check.rms_together, c.focus_check.rms_apart,
			JudgeLight(c.light).empty() ? "" : ", or what was done to the light makes it look so: mend the light first") });
	return remarks;
}

std::vector<Remark> JudgeWidths(const Calibration& c)
{
	double most = 0;
	std::string widest;
	for (size_t s = 0; s < c.task.states.size(); ++s)
		for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
			if (const double ratio = RatiosOf(c.task.states[s].photos[p]).most; ratio > most)
			{
				most = ratio;
				widest = FileOf(c.task, s, p);
			}
	// Circles are read to wider blurs.
	if (!c.task.board.IsCheckerboard() || c.task.states.size() < 2 || most <= MOST_BLUR_RATIO)
		return {};
	return { { Grade::FAIR, fmt::format("{}: the blur's radius reaches {:.2f} of a square. Beyond a quarter the discs of an edge reach into the next one's, and the sigmas need not hold how far tilts are off by that, "
		"some tenths of a per cent: take larger squares, a smaller aperture, or boards nearer to what is in focus", widest, most) } };
}

std::vector<Remark> JudgeBoard(const Calibration& c)
{
	std::vector<Remark> remarks;
	const BoardCheck& b = c.board_check;
	const std::string shape = b.known ? ShapeWords(b) : "";
	const double left = Share(b.rms_free, b.rms_flat);
	if (!b.known)
		remarks.push_back({ Grade::FAIR, "whether the board is as it was told could not be checked: with its shape free the corners have no answer. Photograph more poses" });
	if (!shape.empty() && left < WORTH_SAYING)
		remarks.push_back({ left < DECIDES ? Grade::POOR : Grade::FAIR, fmt::format("the corners fit to {:.3f} px, and to {:.3f} px if the board is not as it was told: {}. The image distance would change by {:.3f} mm. "
			"Measure the print in both directions, and glue it to glass", b.rms_flat, b.rms_free, shape, b.w_change) });
	else if (PlacesAreLeftOver(c))
		remarks.push_back({ Grade::GOOD, fmt::format("the corners fit to {:.3f} px, their noise is {:.3f} px: places are limited by what {}", c.geometry.rms, NoiseOfPlaces(c.task),
			c.RealLensIsUsed() ? "a thin lens leaves out of them, and the real lens, whose numbers are told, is to have"
			: c.jointly ? "the camera model leaves out, and the sigmas hold that as far as parts of the edges put the lens apart" : "the camera model leaves out, and the sigmas do not hold that") });
	return remarks;
}

std::vector<Remark> JudgeUntilted(const Calibration& c)
{
	const Estimate& tilt = c.untilted_check.lens_tilt;
	const double size = std::abs(tilt.value);
	if (!c.untilted_check.known && !c.task.untilted_free)
		return { { Grade::FAIR, fmt::format("state {}: whether its lens stands straight could not be checked: with its tilt free the blur has no answer. Photograph more poses of it", c.task.states[0].name) } };
	if (c.task.untilted_free || size < SURE * tilt.sigma || size < TILT_SEEN)
		return {};
	const bool light = SharpeningIsSeen(c.light) || BendIsSeen(c.light);
	return { { size > TILT_LARGE ? Grade::POOR : Grade::FAIR, fmt::format("state {}: its blur says that the lens is tilted by {:.2f} +- {:.2f} degrees towards {:.0f}, {}", c.task.states[0].name, size, tilt.sigma,
		c.untilted_check.tilt_direction.value + (tilt.value < 0 ? 180 : 0), light ? "which need not be so: what was done to the light changes blur by itself. Mend the light first; what is told then is the lens's"
		: "and it is taken to be straight: its own tilt, the principal point and the focus distance are off by that, those of the others hardly. Set the lens straight, or give `untilted_free`") } };
}

}
