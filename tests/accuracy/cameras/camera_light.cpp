// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera_light.h"

#include "support/srgb.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <random>
#include <stdexcept>

namespace cameras
{

namespace
{

/// Shot noise grows with the root of the light; the read noise does not.
void AddNoise(cv::Mat& picture, const Light& light, unsigned seed)
{
	if (light.snr <= 0)
		return;
	const double white = 0.8, at_white = white / light.snr, read = 0.1 * at_white;
	const double shot = std::sqrt(at_white * at_white - read * read) / std::sqrt(white);
	std::mt19937 random(seed);
	std::normal_distribution<float> normal(0, 1);
	for (int y = 0; y < picture.rows; ++y)
		for (int x = 0; x < picture.cols; ++x)
		{
			float& v = picture.at<float>(y, x);
			v += static_cast<float>(std::sqrt(shot * shot * std::max(v, 0.f) + read * read)) * normal(random);
		}
}

/// The sensor's codes over full scale, clipped, as three channels.
cv::Mat Expose(const cv::Mat& negative, const Light& light, unsigned seed)
{
	cv::Mat picture;
	negative.convertTo(picture, CV_32F, light.exposure);   // a copy
	AddNoise(picture, light, seed);
	const double levels = std::ldexp(1.0, light.bits) - 1;
	cv::Mat codes;
	picture.convertTo(codes, CV_16U, levels);
	cv::min(codes, levels, codes);
	cv::Mat colours;
	if (light.mosaic)
		cv::cvtColor(codes, colours, cv::COLOR_BayerRG2BGR);
	else
		cv::merge(std::vector<cv::Mat>{ codes, codes, codes }, colours);
	colours.convertTo(colours, CV_32F, 1 / levels);
	if (light.power != 1)
		cv::pow(colours, light.power, colours);
	return colours;
}

void Cook(cv::Mat& coded, const Light& light)
{
	if (light.tone_curve > 0)
		for (int y = 0; y < coded.rows; ++y)
			for (int x = 0; x < coded.cols * 3; ++x)
			{
				float& v = coded.ptr<float>(y)[x];
				const float smooth = v * v * (3 - 2 * v);
				v += static_cast<float>(light.tone_curve) * (smooth - v);
			}
	if (light.sharpen > 0)
	{
		cv::Mat soft;
		cv::GaussianBlur(coded, soft, cv::Size(), 1);
		coded += light.sharpen * (coded - soft);
	}
	coded = cv::max(cv::min(coded, 1.0), 0.0);
}

}

std::vector<Light> AllLights()
{
	const auto with = [](const char* name, auto change)
	{
		Light light;
		light.name = name;
		change(light);
		return light;
	};
	return {
		with("clean", [](Light& l) { l.snr = 0; }),
		with("snr200", [](Light&) {}),
		with("snr50", [](Light& l) { l.snr = 50; }),
		with("snr20", [](Light& l) { l.snr = 20; }),
		with("bayer", [](Light& l) { l.mosaic = true; l.snr = 100; }),
		with("bayer-snr30", [](Light& l) { l.mosaic = true; l.snr = 30; }),
		with("jpeg", [](Light& l) { l.jpeg = true; l.snr = 100; }),
		with("bayer-jpeg", [](Light& l) { l.mosaic = l.jpeg = true; l.snr = 100; }),
		with("12bit", [](Light& l) { l.bits = 12; l.snr = 100; l.srgb = false; }),
		with("12bit-in-16", [](Light& l) { l.bits = 12; l.white_level = 4095; l.snr = 100; l.srgb = false; }),
		with("12bit-in-16-clipped", [](Light& l) { l.bits = 12; l.white_level = 4095; l.snr = 100; l.srgb = false; l.exposure = 1.6; }),
		with("clipped", [](Light& l) { l.exposure = 1.6; }),
		with("clipped-exr", [](Light& l) { l.exposure = 1.6; l.exr = true; }),
		with("sharpened", [](Light& l) { l.sharpen = 0.8; }),
		with("tone-curve", [](Light& l) { l.tone_curve = 0.5; }),
		with("power-0.8", [](Light& l) { l.power = 0.8; }),
		with("power-1.2", [](Light& l) { l.power = 1.2; }),
		with("sharpened-bayer", [](Light& l) { l.sharpen = 0.4; l.mosaic = true; l.snr = 100; }),
		with("sharpened-tone-curve", [](Light& l) { l.sharpen = 0.8; l.tone_curve = 0.5; }),
		with("cooked-jpeg", [](Light& l) { l.sharpen = 0.5; l.tone_curve = 0.3; l.jpeg = l.mosaic = true; l.snr = 100; }),
	};
}

Light LightOf(const std::string& name)
{
	std::string names;
	for (const Light& light : AllLights())
	{
		if (light.name == name)
			return light;
		names += " " + light.name;
	}
	throw std::runtime_error("no light '" + name + "'; there are" + names);
}

std::string Develop(const cv::Mat& linear, const Light& light, unsigned seed, const std::string& stem)
{
	cv::Mat colours = Expose(linear, light, seed);
	const std::string file = stem + (light.jpeg ? ".jpg" : light.exr ? ".exr" : ".tif");
	if (light.exr)
	{
		if (!cv::imwrite(file, colours))
			throw std::runtime_error(file + ": cannot be written");
		return file;
	}
	if (light.srgb)
	{
		for (int y = 0; y < colours.rows; ++y)
			for (int x = 0; x < colours.cols * 3; ++x)
				colours.ptr<float>(y)[x] = static_cast<float>(SrgbCode(colours.ptr<float>(y)[x]));
		Cook(colours, light);
	}
	cv::Mat codes;
	colours.convertTo(codes, light.jpeg ? CV_8U : CV_16U, light.jpeg ? 255 : light.white_level ? light.white_level : 65535);
	if (!light.mosaic && !light.jpeg)
		cv::extractChannel(codes, codes, 0);
	if (!cv::imwrite(file, codes, light.jpeg ? std::vector<int>{ cv::IMWRITE_JPEG_QUALITY, 92 } : std::vector<int>{ cv::IMWRITE_TIFF_COMPRESSION, 1 }))
		throw std::runtime_error(file + ": cannot be written");
	return file;
}

}
