// SPDX-License-Identifier: AGPL-3.0-or-later

#include "race_render.h"

#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <future>
#include <map>
#include <mutex>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

// FNV-1a: keys of files in a cache, nothing that anybody attacks.
std::uint64_t Hash(const std::string& text)
{
	std::uint64_t hash = 14695981039346656037u;
	for (unsigned char c : text)
		hash = (hash ^ c) * 1099511628211u;
	return hash;
}

// A program of some megabytes is hashed once.
std::uint64_t HashOfProgram(const fs::path& path)
{
	static std::mutex mutex;
	static std::map<fs::path, std::uint64_t> known;
	const std::lock_guard<std::mutex> lock(mutex);
	const auto found = known.find(path);
	return found != known.end() ? found->second : known[path] = Hash(tiltcal::ReadText(path.string(), "POV-Ray", size_t(1) << 30));
}

Picture Cropped(const Picture& picture, int left, int top, int width, int height)
{
	if (picture.width == width && picture.height == height)
		return picture;
	Picture part{width, height, {}, {}};
	for (int y = 0; y < height; ++y)
	{
		const auto row = picture.rgb.begin() + 3 * ((y + top) * picture.width + left);
		part.rgb.insert(part.rgb.end(), row, row + 3 * width);
	}
	return part;
}

Picture Clipped(Picture picture)
{
	for (double& value : picture.rgb)
		value = std::clamp(value, 0.0, 1.0);
	return picture;
}

}

int Renderer::Pad(const Setting& setting) const
{
	if (setting.opponent == Opponent::PINHOLES)
		return setting.seed; // one pixel is enough to be at another place in a block
	return setting.opponent == Opponent::STOCK || !programs.seed ? 3 * setting.seed : 0;
}

Renderer::Renderer(const Programs& all, const RaceScene& shown, const fs::path& folder, const std::string& name, const RaceSettings& settings)
	: programs(all), scene(shown), work(folder / name), cache(folder / "cache"), width(settings.width), height(settings.height),
	  judged{(width - settings.judged_width) / 2, (height - settings.judged_height) / 2, settings.judged_width, settings.judged_height}
{
	for (const fs::path& program : {programs.ours, programs.stock, programs.reference})
		if (!fs::exists(program))
			throw std::runtime_error("no POV-Ray at '" + program.string() + "'");
	fs::create_directories(work);
	fs::create_directories(cache);
}

std::vector<std::string> Renderer::Command(const fs::path& program, const Setting& setting, int w, int h, const Part& part) const
{
	const int pad = Pad(setting);
	const auto declare = [](const char* name, double value) { return fmt::format("Declare=Race_{}={:.9g}", name, value); };
	std::vector<std::string> command = {program.string(), "-D", "+WT1", "-A", "+I" + scene.file.string(),
		"+L" + scene.file.parent_path().string(), fmt::format("+W{}", w + 2 * pad), fmt::format("+H{}", h + 2 * pad),
		declare("Tilted", setting.tilted)};
	const auto render_part = [&] {
		command.insert(command.end(), {fmt::format("+SC{}", pad + part.left + 1), fmt::format("+EC{}", pad + part.left + part.width),
			fmt::format("+SR{}", pad + part.top + 1), fmt::format("+ER{}", pad + part.top + part.height)});
	};
	if (setting.opponent == Opponent::PINHOLES)
	{
		// Half floats, not clipped: the mean of clipped frames would be darker than the clipped mean.
		command.insert(command.end(), {"+FE", "+Oframe.exr", declare("Camera", 2), declare("Every_Point", setting.every_point), declare("Pad", pad)});
		if (part.width < w || part.height < h)
			render_part();
		return command;
	}
	command.insert(command.end(), {"+FP16", "File_Gamma=1", "+Opicture.ppm", declare("Camera", setting.opponent != Opponent::STOCK),
		declare("Min", setting.min), declare("Max", setting.max), declare("Variance", setting.variance),
		declare("Confidence", setting.confidence), declare("Bokeh", setting.bokeh), declare("Denoise", setting.denoise)});
	if (setting.grid)
		command.push_back(declare("Grid", 1));
	if (pad > 0 || part.width < w || part.height < h)
		render_part();
	if (pad > 0)
		command.push_back(declare("Pad", pad));
	else if (setting.seed != 0)
		command.push_back(declare("Seed", setting.seed));
	return command;
}

Rendered Renderer::Run(const fs::path& program, const Setting& setting) const
{
	const fs::path file = work / "picture.ppm";
	fs::remove(file);
	const Cost cost = RunMeasured(Command(program, setting, width, height, judged), work, work / "povray.log");
	const Picture picture = ReadPpm(file.string());
	const int pad = Pad(setting);
	if (picture.width != width + 2 * pad || picture.height != height + 2 * pad)
		throw std::runtime_error(fmt::format("POV-Ray wrote {} x {} pixels", picture.width, picture.height));
	return {Cropped(picture, pad + judged.left, pad + judged.top, judged.width, judged.height), cost};
}

Rendered Renderer::Render(const Setting& setting) const
{
	return Run(setting.opponent == Opponent::STOCK ? programs.stock : programs.ours, setting);
}

std::string Renderer::Key(const fs::path& program, const Setting& setting) const
{
	std::string text = tiltcal::ReadText(scene.file.string(), "a scene") + tiltcal::ReadText((scene.file.parent_path() / "race_camera.inc").string(), "the race's camera");
	text += fmt::format("{} {}\n", judged.width, judged.height);
	for (const std::string& word : Command("", setting, width, height, judged))
		if (word.compare(0, 2, "+I") != 0 && word.compare(0, 2, "+L") != 0)
			text += word + "\n";
	return fmt::format("{}-{:016x}", scene.name, Hash(text) ^ HashOfProgram(program));
}

Picture Renderer::Reference(const Setting& setting) const
{
	const fs::path& program = setting.opponent == Opponent::STOCK ? programs.stock : programs.reference;
	const fs::path file = cache / (Key(program, setting) + ".raw");
	if (fs::exists(file))
		return ReadRaw(file.string(), judged.width, judged.height);
	const Picture picture = Run(program, setting).picture;
	// A race that is interrupted must not leave half a picture.
	fs::path partial = file;
	partial += fmt::format(".{}", scene.name);
	WriteRaw(picture, partial.string());
	fs::rename(partial, file);
	return picture;
}

Rendered Renderer::RenderOrReuse(const Setting& setting, bool reuse, int repeat) const
{
	const std::string key = Key(setting.opponent == Opponent::STOCK ? programs.stock : programs.ours, setting);
	const fs::path raw = cache / (key + ".raw"), times = cache / fmt::format("{}.time{}", key, repeat);
	Rendered rendered;
	if (reuse && fs::exists(raw) && std::ifstream(times) >> rendered.cost.cpu >> rendered.cost.wall >> rendered.cost.rss)
	{
		rendered.picture = ReadRaw(raw.string(), judged.width, judged.height);
		return rendered;
	}
	rendered = Render(setting);
	WriteRaw(rendered.picture, raw.string());
	std::ofstream(times) << rendered.cost.cpu << ' ' << rendered.cost.wall << ' ' << rendered.cost.rss << '\n';
	return rendered;
}

double Renderer::StartUp(Opponent opponent, bool tilted) const
{
	Setting setting;
	setting.opponent = opponent;
	setting.tilted = tilted;
	setting.max = 1;
	double least = 1e9;
	for (int i = 0; i < 4; ++i)
	{
		const fs::path& program = opponent == Opponent::STOCK ? programs.stock : programs.ours;
		// One pixel of the picture, whose file is written whole, however small the part that is judged.
		least = std::min(least, RunMeasured(Command(program, setting, width, height, {judged.left, judged.top, 1, 1}), work, work / "povray.log").cpu);
	}
	return least;
}

Cost Renderer::Pinholes(int frames, bool tilted, PinholesFor purpose, double& start_up, const std::function<void(int, const Picture&)>& each) const
{
	Setting setting;
	setting.opponent = Opponent::PINHOLES;
	setting.tilted = tilted;
	setting.every_point = purpose == PinholesFor::CHECK;
	// POV-Ray sleeps through most of a short frame, hence more processes than cores.
	const int batches = std::min(frames, 16), length = (frames + batches - 1) / batches;
	const auto folder = [&](int batch) { return work / fmt::format("pinholes{}", batch); };
	const auto pad = [&](int batch) { return purpose == PinholesFor::CHECK ? batch : 0; };
	const auto run = [&](int batch, const Part& part) {
		fs::create_directories(folder(batch));
		Setting own = setting;
		own.seed = pad(batch);
		std::vector<std::string> command = Command(programs.stock, own, width, height, part);
		command.insert(command.end(), {fmt::format("+KFI{}", batch * length + 1), fmt::format("+KFF{}", std::min((batch + 1) * length, frames))});
		return RunMeasured(command, folder(batch), folder(batch) / "povray.log");
	};
	// All batches at once.
	const auto run_all = [&](const Part& part) {
		std::vector<std::future<Cost>> runs;
		for (int batch = 0; batch < batches; ++batch)
			runs.push_back(std::async(std::launch::async, run, batch, part));
		Cost cost;
		for (std::future<Cost>& one : runs)
		{
			const Cost of_batch = one.get();
			cost.cpu += of_batch.cpu;
			cost.wall = std::max(cost.wall, of_batch.wall);
			cost.rss = std::max(cost.rss, of_batch.rss);
		}
		return cost;
	};
	// As crowded as the frames are, and with files as large: they are much of a frame's time.
	start_up = purpose == PinholesFor::RACE ? run_all({judged.left, judged.top, 1, 1}).cpu : 0;
	const Cost cost = run_all({0, 0, width, height});
	Picture sum{width, height, std::vector<double>(3 * std::size_t(width) * std::size_t(height), 0.0), {}};
	for (int i = 1; i <= frames; ++i)
	{
		const int batch = (i - 1) / length;
		const std::size_t digits = std::to_string(std::min((batch + 1) * length, frames)).size();
		const fs::path file = folder(batch) / fmt::format("frame{:0{}}.exr", i, digits);
		const Picture frame = Cropped(ReadExr(file.string()), pad(batch), pad(batch), width, height);
		fs::remove(file);
		for (std::size_t k = 0; k < sum.rgb.size(); ++k)
			sum.rgb[k] += frame.rgb[k];
		if ((i & (i - 1)) != 0)
			continue;
		Picture mean = sum;
		for (double& value : mean.rgb)
			value /= i;
		each(i, Clipped(mean));
	}
	return cost;
}
