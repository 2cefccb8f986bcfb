// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a camera makes of light: noise, a mosaic of colours, clipping, sharpening, a tone curve, bits.

#ifndef CAMERA_LIGHT_H
#define CAMERA_LIGHT_H

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace cameras
{

struct Light
{
	std::string name;
	double snr = 200;          ///< white over its noise: shot noise, and a read noise of a tenth of white's; 0: none
	double exposure = 1;       ///< times full scale; the board's white is at 0.8
	bool mosaic = false;       ///< a Bayer pattern, demosaiced by OpenCV (bilinear)
	int bits = 16;             ///< of the sensor, linear
	int white_level = 0;       ///< 0: scaled to the file's own; otherwise the code of full scale, as raw converters leave 12 bits in 16
	double power = 1;          ///< a tone curve that makes this power of light
	double sharpen = 0;        ///< amount of an unsharp mask of 1 px, on the sRGB codes
	double tone_curve = 0;     ///< 0 none to 1 strong: an S about middle grey, on the sRGB codes
	bool jpeg = false;         ///< 8 bits, quality 92
	bool exr = false;
	bool srgb = true;          ///< the file's codes; otherwise linear
};

/// By name; throws std::runtime_error, which lists them.
Light LightOf(const std::string& name);
std::vector<Light> AllLights();

/// Writes a photograph of `linear` (CV_32FC1, 1 is full scale) to `stem` and an extension, which is returned with it.
std::string Develop(const cv::Mat& linear, const Light& light, unsigned seed, const std::string& stem);

}

#endif
