// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A render turned into a photograph: what sensor and file format do to the light.

#ifndef PAPER_PHOTOGRAPH_H
#define PAPER_PHOTOGRAPH_H

#include <opencv2/core.hpp>

#include <string>

namespace paper
{

/// camera.json's noise: Poisson of full_well x light, Gaussian of read noise (scenes/boxes/photos/README.md, Sensor).
struct Sensor
{
	double full_well_electrons = 0;
	double read_noise_electrons = 0;
};

/// Throws tiltcal::Error where the file has not got the two numbers.
Sensor ReadSensor(const std::string& camera_json);

/// `linear` light (1: full scale; CV_32FC1 or CV_32FC3) times `gain`, with noise, clipped, as 8-bit sRGB codes of the same channels.
/// Equal seeds give equal noise.
cv::Mat Expose(const cv::Mat& linear, double gain, const Sensor& sensor, unsigned seed);

/// Writes 8-bit `codes` in the format of the file `like`: for JPEG with its quantisation tables and its sampling of colours,
/// so that as much is lost; else as PNG. Grey `like`: grey. Atomically. Throws tiltcal::Error.
void WriteLike(const std::string& file, const cv::Mat& codes, const std::string& like);

/// Whether `file` is a grey JPEG or PNG. Throws tiltcal::Error.
bool IsGrey(const std::string& file);

}

#endif
