// SPDX-License-Identifier: AGPL-3.0-or-later

#include "inputs.h"

#include "base/files.h"
#include "camera/opencv_yaml.h"
#include "camera/pose.h"
#include "camera/pose_points.h"
#include "camera/state_camera.h"
#include "profile/profile.h"
#include "support/posed_camera.h"
#include <tiltcal/error.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

using namespace tiltcal;

namespace
{

/// Scene points as that camera sees them.
std::vector<PosePoint> Points()
{
	static const std::vector<PosePoint> points = Photographed(TiltedCamera(), LookAt({ 250, 180, -700 }, { 10, -5, 0 }),
		{ { -150, -100, 0 }, { 150, -90, 40 }, { -120, 80, 90 }, { 130, 100, -60 }, { 10, 20, 100 }, { -40, 60, -90 } });
	return points;
}

/// calibrate's keys of effects too.
std::string JsonWithEffects()
{
	nlohmann::ordered_json json = nlohmann::ordered_json::parse(StateCameraJson(TiltedCamera(), "seed"));
	for (const char* const name : { "vignetting_natural", "vignetting_optical", "chromatic_lateral", "chromatic_axial", "blades" })
		json["effects"].push_back({ { "name", name }, { "used", true } });
	json["vignetting"]["optical"] = { { "radius_mm", 14.5 }, { "distance_mm", 32.5 }, { "rims", { { { "radius_mm", 14.5 }, { "distance_mm", 32.5 } }, { { "radius_mm", 12 }, { "distance_mm", -20 } } } } };
	json["chromatic"] = { { "lateral_red", 1e-4 }, { "lateral_blue", -1e-4 }, { "axial_red_per_mm", 1e-5 }, { "axial_blue_per_mm", 2e-5 } };
	json["aperture_diameter_mm"] = 16;   // import knows none; blades widen a known one
	json["blades"] = { { "count", 8 }, { "rotation_deg", 22.5 }, { "curvature", 0.5 }, { "aperture_diameter_mm", 16.5 } };
	json["states"].push_back(json["states"][0]);
	return json.dump(1, '\t') + "\n";
}

std::string PointsCsv()
{
	std::string csv = "u_px,v_px,x,y,z\n# a remark\n";
	for (const PosePoint& p : Points())
		csv += fmt::format("{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", p.u, p.v, p.world.x, p.world.y, p.world.z);
	return csv;
}

void NeedNumbers(const std::string& what, const std::string& text)
{
	std::istringstream lines(text);
	for (std::string line; std::getline(lines, line);)
	{
		// Remarks have names in them, of which one may be nan.
		line = line.compare(0, 2, "# ") == 0 ? "" : line.substr(0, line.find("//"));
		for (const char* const word : { "nan", "inf", "1e+30," })
			if (line.find(word) != std::string::npos)
				throw std::runtime_error(fmt::format("{} says {}:\n{}", what, word, text));
	}
}

void Pose(const StateCamera& camera, const std::vector<PosePoint>& points, const std::string& file)
{
	NeedNumbers("the pose", PoseInc(camera, SolvePose(camera, points, file), 1));
}

void ReadCalibration(const std::string& file, const std::string& folder)
{
	const StateCamera camera = ReadStateCamera(file, "");
	NeedNumbers("the block", CameraBlockOf(camera, {}, 1));
	const std::string exported = folder + "/exported.yml";
	WriteOpenCv(camera, exported);
	NeedNumbers("the export", ReadText(exported, "a file"));
	Pose(camera, Points(), file);
}

void ReadOpenCvFile(const std::string& file, const std::string& folder)
{
	double lost = 0;
	const StateCamera camera = ReadOpenCv(file, 0.02, "", lost);
	const std::string imported = folder + "/imported.json";
	std::ofstream(imported, std::ios::binary) << StateCameraJson(camera, file);
	try
	{
		ReadStateCamera(imported, "");
	}
	catch (const Error& e)
	{
		throw std::runtime_error(fmt::format("what import writes is refused: {}", e.what()));
	}
}

void Take(const Input& input, const std::string& file, const std::string& folder)
{
	switch (input.kind)
	{
	case InputKind::JSON: return ReadCalibration(file, folder);
	case InputKind::CSV: return Pose(TiltedCamera(), ReadPosePoints(file), file);
	case InputKind::YAML:
	case InputKind::XML: return ReadOpenCvFile(file, folder);
	case InputKind::LINE: break;
	}
	const cv::Mat grey(20, 30, CV_32FC1, cv::Scalar(0.5f));
	Compare(grey, grey, { ParseLine(input.bytes) }, Match::GAIN);
}

}

const char* NameOf(InputKind kind)
{
	switch (kind)
	{
	case InputKind::JSON: return "json";
	case InputKind::CSV: return "csv";
	case InputKind::YAML: return "yml";
	case InputKind::XML: return "xml";
	case InputKind::LINE: break;
	}
	return "line";
}

std::vector<Input> InputSeeds(const std::string& folder)
{
	std::vector<Input> seeds{ { InputKind::JSON, StateCameraJson(TiltedCamera(), "seed") }, { InputKind::JSON, JsonWithEffects() }, { InputKind::CSV, PointsCsv() },
		{ InputKind::LINE, "0.5,1,29,19" } };
	for (const InputKind kind : { InputKind::YAML, InputKind::XML })
	{
		const std::string file = fmt::format("{}/seed.{}", folder, NameOf(kind));
		WriteOpenCv(TiltedCamera(), file);
		seeds.push_back({ kind, ReadText(file, "a file") });
	}
	return seeds;
}

bool TryInput(const Input& input, const std::string& folder)
{
	const std::string file = fmt::format("{}/current.{}", folder, NameOf(input.kind));
	std::ofstream(file, std::ios::binary) << input.bytes;
	try
	{
		Take(input, file, folder);
		return true;
	}
	catch (const Error& e)
	{
		const std::string what = e.what(), named = input.kind == InputKind::LINE ? "--line" : file;
		const bool code = e.Code() == EXIT_FILE || e.Code() == EXIT_REFUSED || (input.kind == InputKind::LINE && e.Code() == EXIT_USAGE);
		if (!code || what.find(named) == std::string::npos || what.find_first_of("\n\r\x1b") != std::string::npos || what.size() > 1000)
			throw std::runtime_error(fmt::format("bad refusal, exit code {}: {}", int(e.Code()), what));
		return false;
	}
}
