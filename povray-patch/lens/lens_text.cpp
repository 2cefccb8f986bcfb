// SPDX-License-Identifier: AGPL-3.0-or-later

#include <cstdio>

#include "lens/lens_text.h"
#include "lens/words.h"

namespace tilt_lens
{

namespace
{

/// All digits.
std::string Number(double x)
{
	char text[40];
	std::snprintf(text, sizeof(text), "%.17g", x);
	return text;
}

std::string List(const double* x, int count)
{
	std::string text;
	for(int i = 0; i < count; i++)
		text += (i > 0 ? ", " : "") + Number(x[i]);
	return text;
}

std::string Vector(const Vec3d& v)
{
	const double x[3] = { v.x, v.y, v.z };
	return "[" + List(x, 3) + "]";
}

std::string Pair(double x, double y)
{
	const double both[2] = { x, y };
	return "[" + List(both, 2) + "]";
}

std::string Quoted(const std::string& text)
{
	std::string out = "\"";
	for(const char c : text)
		out += c == '\n' ? "\\n" : std::string(1, c);
	return out + "\"";
}

void Add(std::string& text, const std::string& name, const std::string& values)
{
	text += name + (values.empty() ? "" : " ") + values + "\n";
}

std::string AberrationValues(const LensSpec& spec)
{
	std::string text = "{";
	if(spec.aberrations_focal_length)
		text += " focal_length " + Number(spec.aberrations_focal_length.value);
	if(spec.aberrations_f_stop)
		text += " f_stop " + Number(spec.aberrations_f_stop.value);
	if(spec.aberrations_etendue)
		text += " " + std::string(EtendueWord);
	for(int i = 0; i < ThirdOrderTerms; i++)
		if(spec.aberrations[i] != 0.0)
			text += " " + std::string(AberrationWords[i]) + " " + Number(spec.aberrations[i]);
	bool fifth = false;
	for(int i = ThirdOrderTerms; i < AberrationTerms; i++)
		fifth = fifth || spec.aberrations[i] != 0.0;
	if(fifth)
		text += " " + std::string(FifthOrderWord) + " { " + List(spec.aberrations + ThirdOrderTerms, FifthOrderTerms) + " }";
	return text + " }";
}

}

std::string OtherWords(const LensSpec& spec)
{
	std::string text;

	if(spec.distortion_given)
		Add(text, NameOf(Word::Distortion), List(spec.distortion, DistortionTerms));
	if(spec.field_curvature)
		Add(text, NameOf(Word::FieldCurvature), Number(spec.field_curvature.value));
	if(spec.blades)
		Add(text, NameOf(Word::Blades), Number(spec.blades.value) +
		    (spec.blade_rotation ? " rotation " + Number(spec.blade_rotation.value) : "") +
		    (spec.blade_curvature ? " curvature " + Number(spec.blade_curvature.value) : ""));
	if(spec.natural_vignetting)
		Add(text, NameOf(Word::NaturalVignetting), "");
	if(spec.rim_count > 0)
	{
		double rims[2 * MostRims];
		for(int i = 0; i < spec.rim_count; i++)
		{
			rims[2 * i] = spec.rims[i].radius;
			rims[2 * i + 1] = spec.rims[i].distance;
		}
		Add(text, NameOf(Word::OpticalVignetting), List(rims, 2 * spec.rim_count));
	}
	// Of three wavelengths the scene states the first and the last.
	if(spec.lateral_given || spec.axial_given)
	{
		const double lateral[2] = { spec.lateral[0], spec.lateral[2] }, axial[2] = { spec.axial[0], spec.axial[2] };
		if(spec.lateral_given)
			Add(text, NameOf(Word::LateralChromatic), List(lateral, 2));
		if(spec.axial_given)
			Add(text, NameOf(Word::AxialChromatic), List(axial, 2));
	}
	if(spec.pupil_magnification)
		Add(text, NameOf(Word::PupilMagnification), Number(spec.pupil_magnification.value));
	if(spec.aberrations_given)
		Add(text, NameOf(Word::Aberrations), AberrationValues(spec));
	if(spec.denoise)
		Add(text, NameOf(Word::Denoise), "");
	if(spec.area_light_grid)
		Add(text, NameOf(Word::AreaLightGrid), "");
	if(spec.channels)
		Add(text, NameOf(Word::Channels), "");
	if(spec.seed)
		Add(text, NameOf(Word::Seed), Number(spec.seed.value));
	return text;
}

std::string LensText(const LensSpec& spec, const CameraVectors& camera, const TiltLens& lens, int width, int height)
{
	// The camera's frame, as lens_spec.cpp has it.
	const Vec3d x = Normalized(camera.right), z = lens.axis;
	const Vec3d y = Normalized(camera.up - Dot(x, camera.up) * x);
	const Vec3d shift = spec.shift ? spec.shift.value : Vec3d{ 0.0, 0.0, 0.0 };
	const double w = lens.image_distance, depth = Dot(z, lens.direction), to_sensor = w / depth;
	std::string text = "{";
	const auto add = [&text](const char* key, const std::string& value)
	{
		text += std::string(text.size() > 1 ? ", \"" : "\"") + key + "\": " + value;
	};

	add("inverse_focus", Vector(lens.inverse_focus_camera));
	add("image_distance", Number(w));
	add("focal_length", Number(1.0 / lens.power));
	add("lens_normal", Vector(lens.normal_camera));
	add("aperture_diameter", Number(lens.aperture_diameter));
	add("field_curvature", Number(lens.field_curvature));
	add("right", Pair(to_sensor * Dot(x, camera.right), to_sensor * Dot(y, camera.right)));
	add("up", Pair(to_sensor * Dot(x, camera.up), to_sensor * Dot(y, camera.up)));
	add("skew", Pair(Dot(x, lens.direction) / depth - shift.x / w, Dot(y, lens.direction) / depth - shift.y / w));
	add("shift", Pair(shift.x, shift.y));
	add("sensor_is_window", spec.angle_given ? "false" : "true");
	add("location", Vector(camera.location));
	add("axes", "[" + Vector(x) + ", " + Vector(y) + ", " + Vector(z) + "]");
	add("drive", spec.focal_plane_tilt ? "\"plane\"" : "\"lens\"");
	add("hold", spec.focal_length ? "\"focal_length\"" : "\"image_distance\"");
	add("pixels", Pair(width, height));
	add("focal_point_outside", spec.focal_point ? "true" : "false");
	add("aperture_outside", spec.aperture != 0.0 ? "true" : "false");
	add("other_words", Quoted(OtherWords(spec)));
	return text + "}\n";
}

}
