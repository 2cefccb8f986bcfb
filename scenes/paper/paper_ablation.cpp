// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_ablation.h"

#include "paper_brightness.h"
#include "paper_smooth_fit.h"
#include "profile.h"

#include <cmath>

namespace paper
{

namespace
{

using Json = nlohmann::ordered_json;

/// A picture brought to another step by step, and what difference each step leaves.
struct Fitted
{
	Errors gain, shading, moved, sharpened;
	Displacement displacement;
	cv::Mat matched;   ///< by the gain: luminance
	cv::Mat brightness;
};

Fitted Fit(const cv::Mat& a, const cv::Mat& b)
{
	Fitted f;
	const cv::Mat target = Brightness(a);
	f.matched = tiltcal::Compare(a, b, {}, tiltcal::Match::GAIN).matched;
	f.brightness = Brightness(f.matched);
	f.gain = Differences(target, f.brightness);
	const cv::Mat shaded = Brightness(tiltcal::Compare(a, b, {}, tiltcal::Match::SHADING).matched);
	f.shading = Differences(target, shaded);
	f.displacement = FitDisplacement(target, shaded);
	f.moved = Differences(target, f.displacement.picture);
	f.sharpened = Differences(target, FitSharpness(target, f.displacement.picture));
	return f;
}

Json ToJson(const Error& e) { return { { "mean_abs", e.mean_abs }, { "rms", e.rms } }; }

Json ToJson(const Displacement& d)
{
	return { { "rms_px", d.rms_px }, { "mean_x_px", d.mean_x_px }, { "mean_y_px", d.mean_y_px }, { "rounds", d.rounds } };
}

double Square(const Error& e) { return e.rms * e.rms; }

struct Parts
{
	Fitted whole, closed;
	Errors noise, seeds, closed_photograph;
};

Json OneArea(const Parts& p, Error Errors::*area)
{
	Json json;
	const auto put = [&](const char* name, const Errors& errors) { json["measured"][name] = ToJson(errors.*area); };
	put("gain", p.whole.gain);
	put("shading", p.whole.shading);
	put("moved", p.whole.moved);
	put("sharpened", p.whole.sharpened);
	put("noise", p.noise);
	const Error& pair = p.seeds.*area;
	json["measured"]["sampling"] = ToJson(Error{ pair.mean_abs / std::sqrt(2.0), pair.rms / std::sqrt(2.0) });
	put("closed_gain", p.closed.gain);
	put("closed_shading", p.closed.shading);
	put("closed_moved", p.closed.moved);
	put("closed_sharpened", p.closed.sharpened);
	put("closed_photograph", p.closed_photograph);

	const auto square = [&](const Errors& errors) { return Square(errors.*area); };
	const double whole = square(p.whole.gain), noise = square(p.noise), sampling = Square(pair) / 2, calibration = square(p.closed.gain) - Square(pair);
	const auto fall = [&](Errors Fitted::*before, Errors Fitted::*after)
	{
		return square(p.whole.*before) - square(p.whole.*after) - (square(p.closed.*before) - square(p.closed.*after));
	};
	const double model = whole - noise - sampling - calibration;
	const double brightness = fall(&Fitted::gain, &Fitted::shading), displacement = fall(&Fitted::shading, &Fitted::moved),
		sharpness = fall(&Fitted::moved, &Fitted::sharpened);
	json["squares"] = { { "whole", whole }, { "noise", noise }, { "sampling", sampling }, { "calibration", calibration }, { "model", model },
		{ "brightness", brightness }, { "displacement", displacement }, { "sharpness", sharpness }, { "rest", model - brightness - displacement - sharpness } };
	return json;
}

}

Json Ablation(const StatePictures& pictures, MatchedPictures& matched)
{
	Parts p;
	p.whole = Fit(pictures.photograph, pictures.render);
	p.closed = Fit(pictures.render, pictures.closed);
	// The gain of the photograph, so that every part is in the photograph's levels.
	const double gain = tiltcal::FitShading(pictures.photograph, pictures.render, 0).coefficients[0];
	const cv::Mat render = Brightness(pictures.render * gain);
	matched = { Brightness(pictures.photograph), render, Brightness(pictures.render_as_photo) };
	p.noise = Differences(matched.render_as_photo, render);
	p.seeds = Differences(render, Brightness(pictures.render_seed1 * gain));
	p.closed_photograph = Differences(matched.render_as_photo,
		Brightness(tiltcal::Compare(pictures.render_as_photo, pictures.closed, {}, tiltcal::Match::GAIN).matched));
	Json json;
	json["gain"] = gain;
	json["displacement"] = ToJson(p.whole.displacement);
	json["closed_displacement"] = ToJson(p.closed.displacement);
	json["red"] = OneArea(p, &Errors::red);
	json["green"] = OneArea(p, &Errors::green);
	json["picture"] = OneArea(p, &Errors::picture);
	return json;
}

}
