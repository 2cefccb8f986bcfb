// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the difference between photograph and render is made of.

#ifndef PAPER_ABLATION_H
#define PAPER_ABLATION_H

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>

namespace paper
{

/// One state's pictures, luminance in linear light, CV_32FC1 of one size.
struct StatePictures
{
	cv::Mat photograph;
	cv::Mat render;             ///< through the calibrated camera
	cv::Mat render_seed1;       ///< the same with another seed: all three renders are denoised, or none
	cv::Mat render_as_photo;    ///< the mean of both through sensor and file format, with the gain of the photograph
	cv::Mat closed;             ///< through the camera that was calibrated from boards that the calibrated camera photographed; a third seed
};

/// The brightness of the photograph, of the render brought to it by one gain, of the render's own photograph, and of the mean of two seeds
/// that this was made of.
struct MatchedPictures
{
	cv::Mat photograph, render, render_as_photo, mean;
};

/// For each of red, green and picture: `measured`, the mean absolute and RMS differences, and `squares`, into which the square of
/// the RMS of `measured.gain` is divided:
///
///     noise         render_as_photo - mean of both seeds
///     sampling      (render - render_seed1) / sqrt 2
///     calibration   square of (mean of both seeds - closed) less 3/2 of that of sampling: the grain of different seeds has no part in common
///     model         what is left of the whole
///       brightness, displacement, sharpness   by how much this falls when a smooth shading, then a smooth displacement, then a smooth
///                   change of blur are fitted to the photograph. The same is fitted in the closed loop, and grain is taken through
///                   the same steps, so that neither calibration's error nor smoothed grain counts here
///       rest        what is left of it then: the shape of the blur, and outliers
///
/// Noise, sampling and calibration are measured without the photograph; what they have in common with the model's error is zero in
/// the mean. Small squares may come out negative, by chance.
nlohmann::ordered_json Ablation(const StatePictures& pictures, MatchedPictures& matched);

}

#endif
