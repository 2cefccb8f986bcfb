// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "lens/aberrated_lens.h"
#include "lens/angles.h"
#include "lens/effects.h"
#include "lens/optics.h"
#include "lens/statistics.h"

namespace tilt_lens
{

RenderCounts& RenderCounts::operator+=(const RenderCounts& o)
{
	pixels += o.pixels;
	samples += o.samples;
	rays += o.rays;
	early += o.early;
	rare += o.rare;
	min_samples = std::min(min_samples, o.min_samples);
	max_samples = std::max(max_samples, o.max_samples);
	for(int i = 0; i < 64; i++)
	{
		levels[i] += o.levels[i];
		level_samples[i] = std::max(level_samples[i], o.level_samples[i]);
	}
	return *this;
}

double RenderCounts::RmsError() const
{
	double sum = 0.0;

	for(int i = 0; i < 64; i++)
	{
		if(levels[i].pixels == 0.0)
			continue;
		double exponent;
		const double v = levels[i].SumOfVariances(&exponent);
		// Changes are kept up to the last power of two; go on to the number itself.
		sum += v * std::pow(double(1u << (i / 2)) / level_samples[i], exponent);
	}
	return pixels > 0 ? std::sqrt(sum / double(pixels)) : 0.0;
}

bool RenderCounts::ErrorIsKnown() const
{
	return std::none_of(levels, levels + 64, [](const LevelChanges& of) { return of.pixels > 0.0 && of.changes == 0; });
}

bool RenderCounts::MayMissLight() const
{
	const double promised = 1.25, seen = RmsError();
	return rare.Most() > (promised * promised - 1.0) * seen * seen * double(pixels);
}

FocusCounts CountFocus(const TiltLens& lens, const CameraVectors& camera,
                       int width, int height, int left, int top, int right, int bottom)
{
	// kappa (times w) is linear over the picture, or nearly so over a pixel: its range
	// there is the value at the centre plus or minus half of the changes across.
	const auto seen_from_lens = [&lens](const Vec3d& v)
	{
		return DirectionBeforePupils(lens.normal, lens.pupil_magnification, DirectionFromExitPupil(lens.axis, lens.pupil_magnification, v));
	};
	const double across = Dot(lens.inverse_focus, seen_from_lens(camera.right)) / width;
	const double down = Dot(lens.inverse_focus, seen_from_lens(camera.up)) / height;
	const double half_range = 0.5 * (std::fabs(across) + std::fabs(down));
	FocusCounts count;

	const double seen_across = lens.Depth(camera.right) / width;
	for(int y = top; y <= bottom; y++)
	{
		const Vec3d row = lens.direction + (0.5 / width - 0.5) * camera.right + (0.5 - (y + 0.5) / height) * camera.up;
		const double row_seen = lens.Depth(row);
		const double row_kappa = Dot(lens.inverse_focus, seen_from_lens(row));

		for(int x = left; x <= right; x++)
		{
			const bool seen = row_seen + x * seen_across > 0.0;
			double kappa = row_kappa + x * across;
			const Vec3d pixel = row + (double(x) / width) * camera.right;
			if(lens.aberrates && seen)
				kappa = InverseFocusAlongLensAxis(lens, pixel) * Dot(seen_from_lens(pixel), lens.normal);
			else if((lens.distorts || lens.Curves()) && seen)
			{
				const Vec3d v = seen_from_lens(pixel);
				kappa = lens.Kappa(!lens.distorts ? v :
				                   UndistortDirection(lens.distortion, lens.basis_x, lens.basis_y, lens.normal, v));
			}

			if(!seen && (!lens.IsPinhole() || lens.weighs))
				count.empty++;
			else if(std::fabs(kappa) <= half_range || kappa == 0.0)
				count.infinity++;
			else if(kappa > 0.0)
				count.front++;
			else
				count.behind++;
		}
	}
	return count;
}

namespace
{

__attribute__((format(printf, 2, 3)))
void Append(std::string& text, const char* format, ...)
{
	char line[256];
	va_list arguments;
	va_start(arguments, format);
	std::vsnprintf(line, sizeof(line), format, arguments);
	va_end(arguments);
	text += line;
}

/// Degrees as they are printed with two places: no "-0.00".
double WithoutMinusZero(double degrees)
{
	return std::fabs(degrees) < 0.005 ? 0.0 : degrees;
}

void AppendPlane(std::string& text, const TiltLens& lens)
{
	const Vec3d& q = lens.inverse_focus_camera;
	const double qxy = std::hypot(q.x, q.y);

	if(!(MaxAbs(q) > 0.0))
	{
		text += "Plane of Focus:  at infinity\n";
		return;
	}
	// The plane and its mirror normal are the same plane: say the angle below 90.
	// Normalized, because the squares of a distant or near plane's q leave the numbers.
	const Vec3d m = Normalized(q.z < 0.0 ? -1.0 * q : q);
	if(lens.Curves() || lens.aberrates)
		Append(text, "Bowl of Focus:   touches, on the lens axis, the\n");
	Append(text, "Plane of Focus:  %.3f deg to the sensor", AngleFromAxis(m) * DegreesPerRadian);
	if(qxy > 0.0)
		Append(text, ", receding towards %.2f deg", WithoutMinusZero(TiltDirection(m) * DegreesPerRadian));
	if(std::fabs(q.z) > 1e-12 * qxy)
		Append(text, "\n  Distance:      %.6g along the axis", 1.0 / q.z);
	else
		Append(text, "\n  Distance:      parallel to the axis, %.6g from it", 1.0 / qxy);
	if(qxy > 0.0)
		Append(text, "   Hinge:  %.6g from the lens", 1.0 / qxy);
	text += "\n";
}

double Percent(uint64_t part, uint64_t all)
{
	return all > 0 ? 100.0 * double(part) / double(all) : 0.0;
}

/// Of pixels with a single sample denoise knows no error: it is what the comparison with their neighbours says.
double WithSingleSamples(double denoised_rms, const RenderCounts& counts)
{
	return std::hypot(denoised_rms, std::sqrt(counts.levels[0].SumOfVariances() / double(counts.pixels)));
}

}

std::string StatisticsText(const TiltLens& lens, const FocusCounts& focus, const RenderCounts& counts, double denoised_rms)
{
	std::string text = "Tilt lens\n";
	const double focal_length = 1.0 / lens.power;

	AppendPlane(text, lens);
	Append(text, "Lens Tilt:       %.3f deg   Focal Length: %.6g   Image Distance: %.6g\n",
	       AngleFromAxis(lens.normal_camera) * DegreesPerRadian, focal_length, lens.image_distance);
	if(lens.IsPinhole())
		text += "Aperture:        0 (a pinhole: everything is sharp)\n";
	else
		Append(text, "Aperture:        diameter %.6g (f/%.3g)\n", lens.aperture_diameter, std::fabs(focal_length) / lens.aperture_diameter);
	const uint64_t all = focus.All();
	Append(text, "Pixels in Focus: in front %.2f%%  at infinity %.2f%%  behind %.2f%%  empty %.2f%%\n",
	       Percent(focus.front, all), Percent(focus.infinity, all), Percent(focus.behind, all), Percent(focus.empty, all));
	const std::string effects = EffectNames(lens);
	Append(text, "Effects:         %s\n", effects.empty() ? "none" : effects.c_str());
	if(counts.pixels > 0)
	{
		const double sampled = counts.RmsError();
		// Denoising is not expected to add error.
		const double rms = denoised_rms < 0.0 ? sampled : std::min(sampled, WithSingleSamples(denoised_rms, counts));
		Append(text, "Samples/Pixel:   min %u  mean %.2f  max %u   Camera Rays: %.0f\n", counts.min_samples,
		       double(counts.samples) / double(counts.pixels), counts.max_samples, double(counts.rays));
		if(!counts.ErrorIsKnown())
		{
			text += "Estimated Error: unknown, one sample a pixel does not tell\n";
			return text;
		}
		const bool least = counts.MayMissLight();
		Append(text, "Estimated Error: %s%.5f RMS of the picture (linear), %.2f of 255 levels\n", least ? ">= " : "", rms, 255.0 * rms);
		if(least)
			text += counts.early > 0 ?
			        "  at least: few samples met small bright lights, and pixels that stopped\n"
			        "  early may have missed them; a larger minimum in blur_samples finds them\n" :
			        "  at least: few samples met small bright lights, and pixels beside them may\n"
			        "  have met none; more blur_samples find them\n";
		if(denoised_rms >= 0.0)
			Append(text, "  before denoise: %.5f\n", sampled);
	}
	return text;
}

}
