// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/verdict.h"
#include "calibrate/verdict_remarks.h"

#include "calibrate/check_light.h"
#include "calibrate/exif_check.h"
#include "calibrate/left_over.h"
#include "calibrate/one_photograph.h"
#include "effects/effects.h"

#include "solve/blur_fit.h"
#include "solve/each_edge.h"
#include <tiltcal/calibrate.h>
#include "model/focus_words.h"
#include "model/picture_view.h"
#include "model/tilt_angles.h"

#include <fmt/format.h>
#include "lens/angles.h"
#include "lens/field_curvature.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tiltcal
{

namespace
{

const double DEGREES = tilt_lens::DegreesPerRadian;

class Judgement
{
public:
	explicit Judgement(const Calibration& calibration) : c(calibration), observations(Observe(calibration.task, calibration.geometry)) {}

	Verdict Everything()
	{
		if (!c.refined)
			Say(Grade::POOR, "the joint refinement did not converge: geometry and blur are as solved one after the other, and each one's sigma does not know of the other's");
		else if (!c.jointly)
			Say(Grade::FAIR, "geometry and blur were not refined together: each one's sigma does not know of the other's, nor of what a thin lens leaves out");
		if (c.fits_without_answer > 0)
			Say(Grade::FAIR, fmt::format("{} of the fits that tell how far parts of the edges put the lens apart had no answer: the sigmas do not hold that, and may be too small. Photograph more poses", c.fits_without_answer));
		// Light first: it may be why photographs and an untilted lens look as if they were not what they are.
		AddRemarks(JudgeLight(c.light));
		AddRemarks(JudgeLightOfStates(c));
		AddRemarks(JudgeWidths(c));
		const bool spoiled = verdict.grade == Grade::POOR;
		bool odd = !c.refined;
		for (const std::vector<Remark>& remarks : { JudgePhotographs(c), JudgeBoard(c), JudgeUntilted(c) })
		{
			AddRemarks(remarks);
			odd = odd || std::any_of(remarks.begin(), remarks.end(), [](const Remark& r) { return r.grade != Grade::GOOD; });
		}
		// What these name is not the lens's aberrations. A slight fault of the light may be theirs: they move edges too.
		const bool explained = odd || spoiled;
		ImageDistance();
		ApertureAndFocus();
		Fold();
		for (size_t s = 0; s < c.solution.states.size(); ++s)
		{
			if (s > 0 || c.task.untilted_free)
				Tilt(s);
			if (s > 0)
				OneImageDistance(s);
			BothSides(s);
			AddRemarks(JudgeLeftOut(c, s));
			BlurAgainstGeometry(s);
		}
		Priors();
		for (const std::string& text : CompareWithExif(c))
			Say(Grade::FAIR, text);
		Stops();
		Correlations();
		if (!explained)
			Limit();
		return verdict;
	}

private:
	void Say(Grade grade, const std::string& text)
	{
		verdict.remarks.push_back({ grade, text });
		verdict.grade = std::max(verdict.grade, grade);
	}

	void AddRemarks(const std::vector<Remark>& remarks)
	{
		for (const Remark& r : remarks)
			Say(r.grade, r.text);
	}

	const std::string& StateName(size_t s) const { return c.task.states[s].name; }

	/// A distortion fitted where edges are may turn back where none are.
	void Fold()
	{
		const Geometry& g = c.MainGeometry();
		for (size_t s = 0; s < g.states.size() && Uses(c, EffectId::DISTORTION) && !c.RealLensIsUsed(); ++s)
			if (const auto fold = FirstFold({ g.w_px, g.distortion, g.states[s].principal_point, g.states[s].lens_normal }, c.task.width, c.task.height))
			{
				Say(Grade::POOR, fmt::format("state {}: the distortion turns back inside the picture, where no edges tell it: pixel ({:.0f}, {:.0f}) sees nothing, and POV-Ray refuses this camera. Photograph the board "
					"in the corners too, or render with `TiltCal_Distortion` 0", StateName(s), (*fold)[0], (*fold)[1]));
				return;
			}
	}

	void ImageDistance()
	{
		const double relative = c.solution.w_mm.sigma / c.solution.w_mm.value;
		if (relative > 0.003)
			Say(relative > 0.01 ? Grade::POOR : Grade::FAIR, fmt::format("the image distance is known to {:.1f} % only: photograph the board inclined by "
				"30 to 45 degrees in several directions, and filling the picture", 100 * relative));
		for (size_t s = 0; s < c.geometry.states.size(); ++s)
			if (c.geometry.states[s].principal_point_fixed)
				Say(Grade::FAIR, fmt::format("state {}: the principal point is not told by the photographs and was taken to be the picture's centre, give or take 2 % of its width: photograph the board in at least three poses", StateName(s)));
	}

	/// Three times the hundredth that is wanted of them (optimal_design.cpp), and ten times; 1/U by the boards' mean 1/z.
	void ApertureAndFocus()
	{
		const auto say = [&](double relative, const std::string& text)
		{
			if (relative > 0.03)
				Say(relative > 0.1 ? Grade::POOR : Grade::FAIR, text);
		};
		const Estimate& d = c.RealLensIsUsed() ? c.real_lens->aperture_diameter_mm : c.solution.aperture_diameter;
		const double of_d = d.sigma / d.value, of_focus = c.TiltOf(0).q_sigma.z / MeanNearness(c.geometry);
		say(of_d, fmt::format("the aperture is known to {:.0f} % only: photograph the board where it is much more blurred, before and behind the plane of focus", 100 * of_d));
		say(of_focus, fmt::format("where the lens is focused is known to {:.2g} 1/m only, {:.0f} % of where the boards are: photograph boards nearer to the plane of focus, and on both sides of it",
			1000 * c.TiltOf(0).q_sigma.z, 100 * of_focus));
	}

	void Tilt(size_t s)
	{
		const double wanted = 0.03, sigma = c.TiltOf(s).lens_tilt.sigma, scatters = c.TiltAsItScatters(s).lens_tilt.sigma;
		// A larger board is farther away, and its plane of focus less steep.
		const double by_board = c.task.board.square_sigma_mm / c.task.board.square_mm * std::abs(c.TiltOf(s).lens_tilt.value);
		const bool by_model = scatters <= wanted, by_size = by_board * by_board > 0.5 * sigma * sigma;
		if (sigma > wanted)
			Say(sigma > 0.15 ? Grade::POOR : Grade::FAIR, fmt::format("state {}: the tilt is known to {:.2f} degrees only: {}", StateName(s), sigma, by_size
				? "the board's size makes most of that: measure its squares better, over many of them"
				: by_model && c.RealLensIsUsed()
				? "parts of the edges, or the fifth order, put it apart: more photographs do not tell it better, a smaller aperture does"
				: by_model
				? "parts of the edges put it apart, by what a thin lens leaves out of the blur: more photographs do not tell it better, a smaller aperture does"
				: "photograph the board in more poses, inclined so that it is sharp in one part and blurred in another"));
		if (c.solution.states[s].chosen_by_power)
			Say(Grade::POOR, fmt::format("state {}: two planes of focus fit the blur, and the one that keeps the focal length was taken: photograph more poses", StateName(s)));
	}

	/// A lens that is tilted and not touched keeps f and w, so that the blur of every state, at the w that all share, tells one f. It moves to where a pivot takes it,
	/// which changes w by no more than 1 - cos of the tilt where that is no farther from the pupil than the sensor is, and pupils of two sizes change f by less. A real lens has a w for every state.
	void OneImageDistance(size_t s)
	{
		if (c.RealLensIsUsed())
			return;
		const StateLens &first = c.solution.states[0], &own = c.solution.states[s];
		const double f = first.focal_length.value, apart = std::abs(own.focal_length.value / f - 1), sigma = f * std::hypot(own.q_sigma.z, first.q_sigma.z);
		const double turned = 2 * (1 - std::cos(own.lens_tilt.value / DEGREES)), least = 0.001;
		if (apart > std::max(least, turned) + 4 * sigma)
			Say(Grade::POOR, fmt::format("state {}: its blur tells a focal length of {:.4g} mm, that of {} {:.4g} mm: {:.2f} +- {:.2f} % apart, and tilting the lens explains no more than {:.2f} %. Was the focus, or "
				"the zoom, touched between the two? They are taken to have one image distance, and all that is told is off where they have not: photograph {} again with the lens as it stands now",
				StateName(s), own.focal_length.value, StateName(0), f, 100 * apart, 100 * sigma, 100 * turned, StateName(0)));
	}

	/// Blur does not show its sign: with one side of the focus only, focus and aperture hide behind each other.
	void BothSides(size_t s)
	{
		int front = 0, all = 0;
		for (const Observation& o : observations)
		{
			if (o.state != s)
				continue;
			const double kappa = tilt_lens::InverseFocusDistanceOnBowl(c.solution.states[s].q, c.solution.field_curvature.value, c.geometry.states[s].lens_normal, o.P);
			front += kappa < 1;
			++all;
		}
		const double share = all ? double(std::min(front, all - front)) / all : 0;
		if (share < 0.05 && !WithinReach(s))
			Say(Grade::GOOD, fmt::format("state {}: no board reaches the plane of focus: how far the lens is focused follows from how blur grows towards the camera, best from boards at "
				"different distances", StateName(s)));
		else if (share < 0.05)
			Say(share < 0.01 && WithinReach(0) ? Grade::FAIR : Grade::GOOD, fmt::format("state {}: {:.0f} % of the edges lie on one side of the plane of focus: photograph boards that reach through it",
				StateName(s), 100 * (1 - share)));
	}

	/// Whether the picture shows the plane of focus no farther than ten times as far as the boards.
	bool WithinReach(size_t s) const
	{
		double farthest = 0;
		for (const Observation& o : observations)
			farthest = std::max(farthest, o.P.z);
		const Point& centre = c.geometry.states[s].principal_point;
		double nearest = 0;   // as 1/z
		for (const int right : { 0, c.task.width })
			for (const int down : { 0, c.task.height })
				nearest = std::max(nearest, Dot(c.solution.states[s].q, Vec3<double>{ (right - centre[0]) / c.geometry.w_px, (centre[1] - down) / c.geometry.w_px, 1 }));
		return 10 * farthest * nearest > 1;
	}

	void BlurAgainstGeometry(size_t s)
	{
		// The untilted state's tilt is held: what both say when it is let free.
		if (s == 0 && c.untilted_check.known && c.untilted_check.by_places)
			Disagree(s, { c.untilted_check.lens_tilt, c.untilted_check.tilt_direction }, { c.untilted_check.by_places->lens_tilt, c.untilted_check.by_places->tilt_direction });
		else if (s > 0 && s < c.geometry_alone.states.size() && s < c.blur_alone.size())
			Disagree(s, { c.blur_alone[s].lens_tilt, c.blur_alone[s].tilt_direction }, { c.geometry_alone.states[s].lens_tilt, c.geometry_alone.states[s].tilt_direction });
	}

	/// Degrees.
	struct TiltTold
	{
		Estimate size, direction;

		Eigen::Vector2d Vector() const { return TiltVector(size.value, direction.value); }
		/// Of a part of its vector along `unit`: the size's along the tilt, the direction's across it.
		double SigmaAlong(const Eigen::Vector2d& unit) const
		{
			const Eigen::Vector2d along = TiltVector(1, direction.value);
			return std::hypot(size.sigma * along.dot(unit), size.value * direction.sigma / DEGREES * (along.x() * unit.y() - along.y() * unit.x()));
		}
	};

	void Disagree(size_t s, const TiltTold& blur, const TiltTold& geometry)
	{
		const Eigen::Vector2d difference = blur.Vector() - geometry.Vector();
		const double apart = difference.norm();
		if (apart == 0)
			return;
		// What the camera leaves out of places is common to many of them, and does not average out as their noise does.
		const double of_places = PlacesAreLeftOver(c) ? c.geometry.rms / NoiseOfPlaces(c.task) : 1;
		const double sigma = std::hypot(blur.SigmaAlong(difference / apart), of_places * geometry.SigmaAlong(difference / apart));
		if (apart > 3 * sigma && apart > 0.05)
			Say(apart > 0.5 && apart > 5 * sigma ? Grade::POOR : Grade::FAIR, fmt::format("state {}: blur and geometry, each alone, disagree by {:.2f} degrees ({:.0f} sigma); {}. "
				"Was the board moved between the states, or the camera?", StateName(s), apart, apart / sigma, s || c.task.untilted_free ? "blur decides" : "it is taken to be untilted"));
	}

	void Priors()
	{
		const Solution& s = c.solution;
		for (const Prior& prior : c.task.priors)
		{
			const double f = s.focal_length.value, d = s.aperture_diameter.value;
			const double found = prior.quantity == Quantity::FOCAL_LENGTH ? f : prior.quantity == Quantity::F_NUMBER ? f / d : prior.quantity == Quantity::IMAGE_DISTANCE ? s.w_mm.value
				: prior.quantity == Quantity::FOCUS_DISTANCE ? s.focus_distance.value : d;
			// A distance as it was fitted, by its reciprocal.
			const double change = prior.quantity == Quantity::FOCUS_DISTANCE ? prior.value * (prior.value / found - 1) : found - prior.value;
			const double pull = std::abs(change) / std::max(prior.sigma, 1e-4 * prior.value);
			if (pull > 3)
				Say(pull > 6 ? Grade::POOR : Grade::FAIR, fmt::format("{} was given as {:.5g} +- {:.2g}, the photographs pull it to {}: are `square`, `pitch` and the value right?",
					prior.Name(), prior.value, prior.sigma, prior.quantity == Quantity::FOCUS_DISTANCE ? FocusWords(InverseFocus(s.states[0])).value_or(fmt::format("{:.5g}", found)) : fmt::format("{:.5g}", found)));
		}
	}

	/// Beyond three times what engraved numbers are off.
	void Stops()
	{
		const std::vector<Estimate>& ratios = c.StopRatios();
		for (size_t k = 1; k < ratios.size(); ++k)
		{
			const Stop &wide = c.task.stops[0], &own = c.task.stops[k];
			const double told = RatioByFNumbers(c.task.stops, k);
			if (std::abs(std::log(ratios[k].value / told)) > 3 * own.log_sigma)
				Say(Grade::FAIR, fmt::format("the photographs at f/{:g} show {:.3f} of the opening of those at f/{:g}, where the f-numbers say {:.3f}: are the photographs those of these f-numbers?",
					own.f_number, ratios[k].value, wide.f_number, told));
		}
	}

	void Correlations()
	{
		for (const Correlation& r : c.solution.correlations)
			if (std::abs(r.value) > 0.97 && r.first == "aperture_diameter" && r.second == "focus_distance" && !WithinReach(0))
				// Where nothing is sharp they are the slope and the offset of one line, and their sigmas are what counts.
				Say(Grade::GOOD, fmt::format("aperture_diameter and 1/U can hardly be told apart (correlation {:.3f}): boards at more different distances do", -r.value));
			else if (std::abs(r.value) > 0.97)
				Say(Grade::FAIR, fmt::format("{} and {} can hardly be told apart (correlation {:.3f}): their {} is known better than each", r.first, r.second, r.value, KnownBetter(r)));
	}

	/// What of the two does not change along the direction in which they are hardly known. Lengths by their ratio, tilts, which may be 0,
	/// by their difference; a tilt and a length have only a combination.
	static const char* KnownBetter(const Correlation& r)
	{
		const auto is_tilt = [](const std::string& name) { return name.find('.') != std::string::npos; };
		const int tilts = is_tilt(r.first) + is_tilt(r.second);
		return tilts == 1 ? "combination" : r.value > 0 ? tilts ? "difference" : "ratio" : tilts ? "sum" : "product";
	}

	void Limit()
	{
		const double rms = c.RealLensIsUsed() ? c.real_lens->rms_blur : c.solution.rms_blur, noise = NoiseOfBlur(c.task);
		if (rms <= MOST_OF_NOISE * noise)
			return;
		// Tilts of a thin lens were seen several sigmas off where glass that a real lens describes was not compared with one.
		const bool could_not = c.real_lens && !c.real_lens->failure.empty();
		Say(!c.real_lens || could_not ? Grade::FAIR : Grade::GOOD, fmt::format("the blur fits to {:.2f} px, its noise is {:.2f} px: what limits the result are aberrations that the model {} does "
			"not have, and the sigmas hold them only as far as {} put the lens apart{}", rms, noise, NameOf(c.Answer()), c.RealLensIsUsed() ? "parts of the edges and photographs left out" : "parts of the edges",
			could_not ? ". No real lens could be fitted: photograph at a smaller aperture" : c.real_lens ? "" : c.task.board.IsCheckerboard() ? ". Leave `model` and `effects` free, and a real lens is tried"
			: ". Photograph a checkerboard, and a real lens is tried"));
	}

	const Calibration& c;
	const std::vector<Observation> observations;
	Verdict verdict;
};

}

Verdict Judge(const Calibration& calibration)
{
	if (!calibration.IsJudged())
		return {};
	return Judgement(calibration).Everything();
}

}
