// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_ablation.h"

#include "paper_brightness.h"
#include "paper_smooth_fit.h"
#include "profile/profile.h"

#include <array>
#include <cmath>

namespace paper
{

namespace
{

using Json = nlohmann::ordered_json;

/// How a picture is brought to another: by one gain, also by a shading, also by a displacement, also by a change of blur.
const char* const STEPS[] = { "gain", "shading", "moved", "sharpened" };
const size_t STEP_COUNT = sizeof(STEPS) / sizeof(*STEPS);
using Stages = std::array<cv::Mat, STEP_COUNT>;   ///< brightness
using StageErrors = std::array<Errors, STEP_COUNT>;

struct Fit
{
	tiltcal::Shading gain, shading;
	Displacement displacement;
	Eigen::VectorXd sharpness;
};

/// Luminance b at each step of the fit.
Stages Apply(const Fit& fit, const cv::Mat& b)
{
	Stages stages;
	stages[0] = Brightness(tiltcal::ApplyShading(b, fit.gain));
	stages[1] = Brightness(tiltcal::ApplyShading(b, fit.shading));
	stages[2] = Move(stages[1], fit.displacement);
	stages[3] = ChangeSharpness(stages[2], fit.sharpness);
	return stages;
}

/// Brings b to a, both luminance.
Fit FitTo(const cv::Mat& a, const cv::Mat& b)
{
	Fit fit;
	const tiltcal::Comparison gain = tiltcal::Compare(a, b, {}, tiltcal::Match::GAIN), shading = tiltcal::Compare(a, b, {}, tiltcal::Match::SHADING);
	fit.gain = gain.shading;
	fit.shading = shading.shading;
	const cv::Mat target = Brightness(a), shaded = Brightness(shading.matched);
	fit.displacement = FitDisplacement(target, shaded);
	fit.sharpness = FitSharpness(target, Move(shaded, fit.displacement));
	return fit;
}

StageErrors Against(const cv::Mat& target, const Stages& stages)
{
	StageErrors errors;
	for (size_t k = 0; k < STEP_COUNT; ++k)
		errors[k] = Differences(target, stages[k]);
	return errors;
}

/// The difference of two seeds' renders, each taken through the same steps, which smooth grain a little.
StageErrors Grain(const Stages& a, const Stages& b)
{
	StageErrors errors;
	for (size_t k = 0; k < STEP_COUNT; ++k)
		errors[k] = Differences(a[k], b[k]);
	return errors;
}

Json ToJson(const Error& e) { return { { "mean_abs", e.mean_abs }, { "rms", e.rms } }; }

/// With the field at 9 x 6 places: [column, row, x, y].
Json ToJson(const Displacement& d, cv::Size size)
{
	Json json{ { "rms_px", d.rms_px }, { "mean_x_px", d.mean_x_px }, { "mean_y_px", d.mean_y_px }, { "rounds", d.rounds } };
	for (int j = 0; j < 6; ++j)
		for (int i = 0; i < 9; ++i)
		{
			const int column = (2 * i + 1) * size.width / 18, row = (2 * j + 1) * size.height / 12;
			const auto moved = DisplacementAt(d, column, row, size);
			json["field"].push_back({ column, row, moved[0], moved[1] });
		}
	return json;
}

double Square(const Error& e) { return e.rms * e.rms; }

struct Parts
{
	StageErrors whole, whole_grain;     ///< photograph and render; grain: of two seeds
	StageErrors closed, closed_grain;   ///< mean of two seeds' renders and the closed loop's
	Errors noise, closed_photograph;
};

Json OneArea(const Parts& p, Error Errors::*area)
{
	const auto square = [&](const Errors& errors) { return Square(errors.*area); };
	Json json;
	for (size_t k = 0; k < STEP_COUNT; ++k)
		json["measured"][STEPS[k]] = ToJson(p.whole[k].*area);
	json["measured"]["noise"] = ToJson(p.noise.*area);
	const Error& pair = p.whole_grain[0].*area;
	json["measured"]["sampling"] = ToJson(Error{ pair.mean_abs / std::sqrt(2.0), pair.rms / std::sqrt(2.0) });
	for (size_t k = 0; k < STEP_COUNT; ++k)
		json["measured"][std::string("closed_") + STEPS[k]] = ToJson(p.closed[k].*area);
	json["measured"]["closed_photograph"] = ToJson(p.closed_photograph.*area);

	// What is left after each step, less the parts that are no error of the model, as they are after that step.
	const double noise = square(p.noise), sampling = square(p.whole_grain[0]) / 2;
	std::array<double, STEP_COUNT> calibration{}, model{};
	for (size_t k = 0; k < STEP_COUNT; ++k)
	{
		calibration[k] = square(p.closed[k]) - sampling / 2 - square(p.closed_grain[k]) / 2;   // the mean of two seeds has half the grain
		model[k] = square(p.whole[k]) - noise - square(p.whole_grain[k]) / 2 - calibration[k];
	}
	json["squares"] = { { "whole", square(p.whole[0]) }, { "noise", noise }, { "sampling", sampling }, { "calibration", calibration[0] }, { "model", model[0] },
		{ "brightness", model[0] - model[1] }, { "displacement", model[1] - model[2] }, { "sharpness", model[2] - model[3] }, { "rest", model[3] } };
	return json;
}

}

Json Ablation(const StatePictures& pictures, MatchedPictures& matched)
{
	const Fit fit = FitTo(pictures.photograph, pictures.render);
	const Stages stages = Apply(fit, pictures.render);
	// In the photograph's levels, as every part is.
	const double gain = fit.gain.coefficients[0];
	const cv::Mat mean = (pictures.render + pictures.render_seed1) * (gain / 2), mean_brightness = Brightness(mean);
	const Fit closed = FitTo(mean, pictures.closed);
	matched = { Brightness(pictures.photograph), stages[0], Brightness(pictures.render_as_photo), mean_brightness };

	Parts p;
	p.whole = Against(matched.photograph, stages);
	p.whole_grain = Grain(stages, Apply(fit, pictures.render_seed1));
	p.closed = Against(mean_brightness, Apply(closed, pictures.closed));
	p.closed_grain = Grain(Apply(closed, pictures.render), Apply(closed, pictures.render_seed1));
	p.noise = Differences(matched.render_as_photo, mean_brightness);
	p.closed_photograph = Differences(matched.render_as_photo,
		Brightness(tiltcal::Compare(pictures.render_as_photo, pictures.closed, {}, tiltcal::Match::GAIN).matched));
	Json json;
	json["gain"] = gain;
	json["displacement"] = ToJson(fit.displacement, mean.size());
	json["closed_displacement"] = ToJson(closed.displacement, mean.size());
	json["red"] = OneArea(p, &Errors::red);
	json["green"] = OneArea(p, &Errors::green);
	json["picture"] = OneArea(p, &Errors::picture);
	return json;
}

}
