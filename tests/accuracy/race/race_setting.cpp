// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_setting.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace fs = std::filesystem;
using nlohmann::json;

std::string Label(const Setting& setting)
{
	if (setting.opponent == Opponent::PINHOLES)
		return fmt::format("{} frames", setting.max);
	std::string label = setting.min > 0 ? fmt::format("{}, {}", setting.min, setting.max) : fmt::format("{}", setting.max);
	label += fmt::format(" variance {:g}", setting.variance);
	if (setting.confidence != 0.9)
		label += fmt::format(" confidence {:g}", setting.confidence);
	if (setting.bokeh)
		label += " bokeh";
	if (setting.denoise)
		label += " denoise";
	if (setting.grid)
		label += " area_light_grid";
	return label;
}

const char* Name(Opponent opponent)
{
	switch (opponent)
	{
		case Opponent::STOCK: return "stock";
		case Opponent::OURS: return "ours";
		case Opponent::RAW: return "ours-raw";
		case Opponent::FIXED: return "ours-fixed";
		case Opponent::GRID: return "ours-grid";
		case Opponent::PINHOLES: return "pinholes";
	}
	return "";
}

std::vector<RaceScene> ReadScenes(const fs::path& folder)
{
	std::vector<RaceScene> scenes;
	for (const auto& entry : fs::directory_iterator(folder))
	{
		if (entry.path().extension() != ".pov")
			continue;
		RaceScene scene;
		scene.file = fs::absolute(entry.path());
		scene.name = entry.path().stem().string();
		std::ifstream file(entry.path());
		std::string line;
		const auto tail = [&](const std::string& head, std::string& value) {
			if (line.compare(0, head.size(), head) == 0)
				value = line.substr(head.size());
		};
		std::string tilted, area_lights;
		while (std::getline(file, line) && line.compare(0, 2, "//") == 0)
		{
			tail("// Title: ", scene.title);
			tail("// Shows: ", scene.shows);
			tail("// Tilted: ", tilted);
			tail("// Area lights: ", area_lights);
		}
		scene.tilted = tilted == "yes";
		scene.area_lights = area_lights == "yes";
		if (scene.title.empty())
			throw std::runtime_error(scene.file.string() + " has no line \"// Title: ...\" at its top");
		scenes.push_back(scene);
	}
	std::sort(scenes.begin(), scenes.end(), [](const RaceScene& a, const RaceScene& b) { return a.name < b.name; });
	if (scenes.empty())
		throw std::runtime_error("no scenes in " + folder.string());
	return scenes;
}

// A list of objects; in each, every word may have one value or a list of them: all combinations.
static std::vector<Setting> Settings(const json& list, Opponent opponent)
{
	std::vector<Setting> settings;
	const auto values = [](const json& object, const char* key, double standard) {
		if (!object.contains(key))
			return std::vector<double>{standard};
		const json& value = object.at(key);
		return value.is_array() ? value.get<std::vector<double>>() : std::vector<double>{value.get<double>()};
	};
	for (const json& object : list)
		for (double min : values(object, "min", 0))
			for (double max : values(object, "max", 0))
				for (double variance : values(object, "variance", 0))
					for (double confidence : values(object, "confidence", 0.9))
					{
						Setting setting;
						setting.opponent = opponent;
						setting.min = int(min);
						setting.max = int(max);
						setting.variance = variance;
						setting.confidence = confidence;
						setting.bokeh = object.value("bokeh", false);
						setting.denoise = opponent == Opponent::OURS;
						setting.grid = opponent == Opponent::GRID;
						if (setting.max < 1 || setting.min > setting.max)
							throw std::runtime_error("blur_samples " + Label(setting) + " of " + Name(opponent) + " makes no sense");
						settings.push_back(setting);
					}
	return settings;
}

RaceSettings ReadSettings(const fs::path& file, const std::string& mode)
try
{
	std::ifstream stream(file);
	if (!stream)
		throw std::runtime_error("cannot read it");
	const json all = json::parse(stream, nullptr, true, true);
	json j = all.at("full");
	if (mode != "full")
		j.merge_patch(all.at(mode));
	RaceSettings settings;
	settings.width = j.at("width");
	settings.height = j.at("height");
	const std::vector<int> judged = j.value("judged", std::vector<int>{settings.width, settings.height});
	if (judged.size() != 2 || judged[0] < 1 || judged[1] < 1 || judged[0] > settings.width || judged[1] > settings.height)
		throw std::runtime_error("\"judged\" is not the size of a part of the picture");
	settings.judged_width = judged[0];
	settings.judged_height = judged[1];
	settings.repeats = j.at("repeats");
	settings.short_repeats = std::max(settings.repeats, j.value("short_repeats", 0));
	settings.short_run = j.value("short_run", 0.0);
	settings.longest_run = j.at("longest_run");
	settings.enough = j.at("enough");
	settings.reference_samples = j.at("reference_samples");
	settings.reference_seeds = j.at("reference_seeds");
	settings.reference_error = j.at("reference_error");
	settings.limit_samples = j.at("limit_samples");
	settings.pinhole_frames = j.at("pinhole_frames");
	settings.check_frames = j.at("check_frames");
	settings.errors = j.at("errors").get<std::vector<double>>();
	settings.rel_mse = j.at("rel_mse").get<std::vector<double>>();
	settings.stock = Settings(j.at("stock"), Opponent::STOCK);
	settings.ours = Settings(j.at("ours"), Opponent::OURS);
	settings.raw = Settings(j.at("raw"), Opponent::RAW);
	settings.fixed = Settings(j.at("fixed"), Opponent::FIXED);
	settings.grid = Settings(j.value("grid", json::array()), Opponent::GRID);
	if (settings.pinhole_frames + settings.check_frames > 0 && (settings.judged_width < settings.width || settings.judged_height < settings.height))
		throw std::runtime_error("pinholes are judged as whole pictures");
	if (settings.reference_seeds < 2 || settings.errors.empty())
		throw std::runtime_error("at least two reference_seeds and one of errors are needed");
	return settings;
}
catch (const std::exception& error)
{
	throw std::runtime_error(file.string() + ": " + error.what());
}
