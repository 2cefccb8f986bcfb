// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/pilot_run.h"

#include <tiltcal/error.h>
#include "tiltcost/denoise_cost.h"
#include "tiltcost/progress.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>

namespace tiltcost
{

namespace
{

/// All blocks, one sample each of some of their pixels; of slow scenes as many as there are in a tenth of the time.
const PilotPlan ScoutPilot = {1 << 24, 1};
const double ScoutShare = 0.1;

/// A file that grows: what came since the last look.
class Growing
{
public:
	explicit Growing(const std::string& name) : file(name) {}

	std::string Next()
	{
		std::ifstream in(file, std::ios::binary);
		in.seekg(at);
		std::string text{std::istreambuf_iterator<char>(in), {}};
		at += std::streamoff(text.size());
		return text;
	}

	bool IsThere() const
	{
		std::error_code none;
		return std::filesystem::exists(file, none);
	}

private:
	std::string file;
	std::streamoff at = 0;
};

[[noreturn]] void NoTiltLens(const RenderLog& log)
{
	if (log.pinhole)
		throw tiltcal::Refused("the lens has aperture 0: a pinhole, which takes one ray a pixel and has no blur to sample. "
			"For blur, write aperture_diameter D (world units) or f_stop N into the tilt_lens block");
	throw tiltcal::Refused("the camera samples no tilt_lens: it is of another type, has aperture 0, or shows focus or plane. "
		"Write it as\n  camera { tilt_lens { aperture_diameter D } location .. look_at .. focal_point .. }\n"
		"(povray-patch/REFERENCE.md has all words)");
}

double Samples(const std::vector<PilotBlock>& blocks)
{
	double samples = 0;
	for (const PilotBlock& block : blocks)
		samples += double(block.pixels.size()) * block.pixels[0].back().samples;
	return samples;
}

class PilotRenders
{
public:
	PilotRenders(const Job& what, const tiltcal::TemporaryFolder& where) : job(what), folder(where) {}

	/// `frame`: of an animation, else none.
	PilotRun Run(const PilotPlan& plan, double seconds, const std::string& title, const std::string& number, std::optional<int> frame = {},
		const std::vector<int>& chosen = {});

	/// Which frames the scene and the options ask for. No pixel is traced.
	FrameRange Frames();

private:
	bool Watch(double seconds);

	const Job& job;
	const tiltcal::TemporaryFolder& folder;
	std::unique_ptr<Growing> pilot, messages;
	std::string last_message;
	int done = 0, wanted = 0;
	Progress progress;
};

/// POV-Ray takes its options apart at spaces, unless they are quoted.
std::string Quoted(const std::string& path)
{
	return path.find_first_of(" \t") == std::string::npos ? path : '"' + path + '"';
}

bool PilotRenders::Watch(double seconds)
{
	// The letter occurs once in what is written of a block.
	const std::string grown = pilot->Next();
	done += int(std::count(grown.begin(), grown.end(), 'o'));
	if (wanted == ScoutPilot.blocks)
		progress.Show(fmt::format("{} blocks, {:.0f} s", done, seconds));
	else
		progress.Show(fmt::format("{} of {} blocks, {:.0f} s{}", std::min(done, wanted), wanted, seconds, TimeLeft(double(done) / std::max(wanted, 1), seconds)));

	// A camera without a lens to sample begins no file and renders the whole picture: half of it, or of radiosity's pretrace, is enough to know.
	const std::string said = messages->Next();
	const size_t at = said.rfind("Rendered ");
	double rendered = 0, all = 0;
	const double patience = 3;
	return pilot->IsThere() || seconds < patience || at == std::string::npos ||
		std::sscanf(said.c_str() + at, "Rendered %lf of %lf", &rendered, &all) != 2 || rendered < all / 2;
}

PilotRun PilotRenders::Run(const PilotPlan& plan, double seconds, const std::string& title, const std::string& number, std::optional<int> frame,
	const std::vector<int>& chosen)
{
	const std::string file = folder.File("pilot" + number), log = folder.File("log" + number);
	pilot = std::make_unique<Growing>(file);
	messages = std::make_unique<Growing>(log);
	done = 0;
	wanted = plan.blocks;
	progress.Begin(title);
	std::vector<std::string> environment = {fmt::format("{}={},{},{:g},{}", tilt_lens::PilotVariable, plan.blocks, plan.samples, seconds, file)};
	if (!chosen.empty())
	{
		const std::string names = folder.File("blocks" + number);
		std::ofstream(names) << fmt::format("{}\n", fmt::join(chosen, "\n"));
		environment.push_back(fmt::format("{}={}", tilt_lens::PilotBlocksVariable, names));
	}
	if (job.may_write)
		environment.push_back(fmt::format("{}=1", tilt_lens::PilotWritesVariable));
	const tiltcal::ProcessResult result = tiltcal::RunProcess({PilotCommand(job, folder, frame), "", environment, "", log},
		[this](double elapsed) { return Watch(elapsed); });
	progress.End();

	PilotRun run;
	const std::string said = Contents(log);
	run.log = ReadRenderLog(said);
	CheckPilotRender(job, result, said);
	if (plan.samples == 1)
		run.scouted = ParseScouted(Contents(file));
	else
		run.blocks = ParsePilot(Contents(file));
	if (run.blocks.empty() && run.scouted.empty())
		NoTiltLens(run.log);
	const double trace = TraceSeconds(run.blocks) + TraceSeconds(run.scouted), samples = Samples(run.blocks);
	run.wall = result.wall;
	run.machine.threads = run.log.threads;
	run.machine.pixels = run.log.pixels;
	run.machine.rows = run.log.rows;
	if (run.log.camera_rays > 0 && samples > 0)
		run.machine.rays_per_sample = run.log.camera_rays / samples;
	run.machine.start_cpu = std::max(0.0, result.cpu - trace);
	run.machine.start_wall = std::max(0.0, result.wall - trace / run.log.threads);
	return run;
}

FrameRange PilotRenders::Frames()
{
	const std::string log = folder.File("frames");
	const auto said = [&] { return ReadRenderLog(Contents(log)); };
	std::vector<std::string> command = PilotCommand(job, folder);
	for (const char* option : {"+SR2", "+ER2", "+SC2", "+EC2", "+Q1"})
		command.emplace_back(option);
	// POV-Ray says how many frames it is to render before it parses the first, then which there are, then the picture's size.
	const auto said_all = [](const RenderLog& read) { return read.rendered_frames > 0 && read.pixels > 0; };
	const std::string nothing = fmt::format("{}=1,16,0.001,{}", tilt_lens::PilotVariable, folder.File("nothing"));
	const tiltcal::ProcessResult result = tiltcal::RunProcess({command, "", {nothing}, "", log}, [&](double) { return !said_all(said()); });
	const RenderLog read = said();
	// It may have come to what the scene does first, such as opening a file, before it was ended.
	if (read.rendered_frames == 0)
		CheckPilotRender(job, result, Contents(log));
	if (read.rendered_frames <= 1)
		throw tiltcal::Refused(fmt::format("{} is no animation of several frames, and --frames asks for one; give +KFI1 +KFF24, or leave it out", job.scene));
	if (read.frame_step > 1)
		throw tiltcal::Refused(fmt::format("{} has a Frame_Step of {}; --frames does not know which frames those are", job.scene, read.frame_step));
	const std::optional<FrameRange> range = RenderedFrames(read, job.options);
	if (!range)
		throw tiltcal::Refused(fmt::format("{} renders {} of {} frames; say on the command line which, +SFn +EFm, by their numbers", job.scene,
			read.rendered_frames, read.last_frame - read.first_frame + 1));
	return *range;
}

/// What is left of the time for the pilots, after scouts: the processors may be busy with other work, or fewer than threads.
double LeftOf(double seconds, const PilotRun& scout)
{
	return std::max(0.1 * seconds, seconds - (scout.wall - scout.machine.start_wall));
}

int Columns(const PilotRun& run)
{
	return (run.log.width + tilt_lens::PilotBlockSize - 1) / tilt_lens::PilotBlockSize;
}

/// Notes what each block stands for.
void NoteChances(const BlockChoice& choice, PilotRun& run)
{
	run.pictures = {{double(choice.Blocks()), choice.Worth()}};
	for (PilotBlock& block : run.blocks)
		block.sampled = {choice.ChanceOf(block.left, block.top, run.blocks.size()).value_or(1), choice.WorthOf(block.left, block.top)};
}

/// Both started the same way; the first wrote less, and the machine may have been busy in either.
void TakeLesserStart(PilotRun& run, const PilotRun& tiny)
{
	run.wall += tiny.wall;
	run.machine.start_cpu = std::min(run.machine.start_cpu, tiny.machine.start_cpu);
	run.machine.start_wall = std::min(run.machine.start_wall, tiny.machine.start_wall);
}

}

std::vector<int> PilotedFrames(const FrameRange& range, int count)
{
	std::vector<int> frames;
	const int all = range.Count();
	count = std::min(count, all);
	for (int i = 0; i < count; ++i)
		frames.push_back(range.first + int((2LL * i + 1) * all / (2LL * count)));
	return frames;
}

std::string FileWord(const std::string& file, bool first)
{
	return (first && !IsIniFile(file) ? "+I" : "") + Quoted(file);
}

std::vector<std::string> PilotCommand(const Job& job, const tiltcal::TemporaryFolder& folder, std::optional<int> frame)
{
	std::vector<std::string> command = {job.povray};
	command.insert(command.end(), job.options.begin(), job.options.end());
	for (const char* option : {"-D", "-P", "-C", "-A", "+SP1", "+EP1", "+V", "+GA", "-RFO"})
		command.emplace_back(option);
	if (frame)
		command.insert(command.end(), {fmt::format("+SF{}", *frame), fmt::format("+EF{}", *frame)});
	command.push_back("+O" + Quoted(folder.File("picture")));
	command.push_back("+GI" + Quoted(folder.File("options.ini")));   // in place of the user's Create_Ini
	return command;
}

void CheckPilotRender(const Job& job, const tiltcal::ProcessResult& result, const std::string& said)
{
	if (result.exit_code == 126 || result.exit_code == 127)
		throw tiltcal::FileError(fmt::format("{}: cannot be run; give the patched POV-Ray with --povray", job.povray));
	if (ReadRenderLog(said).writes)
		throw tiltcal::Refused(fmt::format("{} opens a file for writing, and tiltcost parses it before you render it. "
			"If that does no harm, let it with --scene-may-write:\n{}", job.scene, ErrorLines(said)));
	if (result.exit_code != 0 && !result.stopped)
		throw tiltcal::Refused(fmt::format("POV-Ray does not render {}:\n{}", job.scene, ErrorLines(said)));
}

std::string Contents(const std::string& file)
{
	std::ifstream in(file, std::ios::binary);
	return {std::istreambuf_iterator<char>(in), {}};
}

std::string WithoutSection(const std::string& scene)
{
	return !scene.empty() && scene.back() == ']' ? scene.substr(0, scene.rfind('[')) : scene;
}

bool IsIniFile(const std::string& scene)
{
	std::string suffix = std::filesystem::path(WithoutSection(scene)).extension().string();
	std::transform(suffix.begin(), suffix.end(), suffix.begin(), [](unsigned char c) { return char(std::tolower(c)); });
	return suffix == ".ini";
}

PilotPlan PlanPilot(double seconds_per_sample, int threads, double seconds, int most_blocks)
{
	const int pixels = tilt_lens::PilotBlockSize * tilt_lens::PilotBlockSize;
	// Samples, and the blocks below which it is better to halve them.
	const PilotPlan enough[] = {{60, 1024}, {48, 512}, {36, 256}, {28, 128}, {12, 64}};
	for (const PilotPlan& plan : enough)
	{
		const double affordable = seconds * threads / std::max(1e-12, seconds_per_sample * pixels * plan.samples);
		if (affordable >= std::min(plan.blocks, most_blocks))
			return {int(std::min<double>(affordable, most_blocks)), plan.samples};
	}
	return {std::min(12, most_blocks), 64};
}

PilotPlan PlanRowsPilot(double seconds_per_sample, int threads, double seconds, int most_blocks)
{
	// Enough to tell pixels that stop early from those that do not.
	const int samples = 32, least = 12;
	const double affordable = seconds * threads / std::max(1e-12, seconds_per_sample * tilt_lens::PilotBlockSize * tilt_lens::PilotBlockSize * samples);
	return {std::min(most_blocks, std::max(least, int(std::min(affordable, 1e6)))), samples};
}

PilotRun RunPilots(const Job& job, const tiltcal::TemporaryFolder& folder)
{
	PilotRenders renders(job, folder);
	const PilotRun scout = renders.Run(ScoutPilot, ScoutShare * job.pilot_seconds, "first pilot", "1");
	const double left = LeftOf(job.pilot_seconds, scout);
	const PilotPlan plan = (job.rows ? PlanRowsPilot : PlanPilot)(SecondsPerSample(scout.scouted), scout.machine.threads, left, job.most_blocks);
	// Where rows are asked for, each place is.
	const BlockChoice choice(job.rows ? std::vector<ScoutedBlock>() : scout.scouted);
	PilotRun run = renders.Run(plan, left, "pilot render", "2", {}, choice.Choose(size_t(plan.blocks), Columns(scout)));
	SortByPlace(run.blocks);
	NoteChances(choice, run);
	TakeLesserStart(run, scout);
	// Where rows are asked for, so is the scene's own setting alone.
	if (!job.rows || (run.blocks[0].own && run.blocks[0].own->denoise))
		run.machine.denoise_pixel = DenoiseSecondsPerPixel(job.povray, run.log.width, folder);
	return run;
}

FilmRun RunFilmPilots(const Job& job, const tiltcal::TemporaryFolder& folder)
{
	PilotRenders renders(job, folder);
	FilmRun film;
	film.range = renders.Frames();
	film.frames = PilotedFrames(film.range, job.frames);
	const size_t count = film.frames.size();
	const auto title = [&](const char* what, size_t i) { return fmt::format("{} of frame {} ({} of {})", what, film.frames[i], i + 1, count); };

	// One plan for all, by their mean, so that each frame counts as much as another.
	std::vector<PilotRun> scouts;
	double sample = 0, left = 0;
	for (size_t i = 0; i < count; ++i)
	{
		scouts.push_back(renders.Run(ScoutPilot, ScoutShare * job.pilot_seconds / double(count), title("first pilot", i), fmt::format("{}-1", i), film.frames[i]));
		sample += SecondsPerSample(scouts[i].scouted) / double(count);
		left += LeftOf(job.pilot_seconds / double(count), scouts[i]);
	}
	const PilotPlan plan = PlanPilot(sample, scouts[0].machine.threads, left / double(count), job.most_blocks);
	size_t least = size_t(plan.blocks);
	std::vector<BlockChoice> choices;
	for (size_t i = 0; i < count; ++i)
	{
		// By its own share of the time, and some: a frame that is dearer than others takes longer for as many blocks.
		const double share = 1.5 * left * SecondsPerSample(scouts[i].scouted) / std::max(1e-12, sample * double(count));
		choices.emplace_back(scouts[i].scouted);
		film.runs.push_back(renders.Run(plan, share, title("pilot", i), fmt::format("{}-2", i), film.frames[i],
			choices[i].Choose(size_t(plan.blocks), Columns(scouts[i]))));
		TakeLesserStart(film.runs[i], scouts[i]);
		least = std::min(least, film.runs[i].blocks.size());
	}
	const double denoise_pixel = DenoiseSecondsPerPixel(job.povray, scouts[0].log.width, folder);
	for (size_t i = 0; i < count; ++i)
	{
		film.runs[i].machine.denoise_pixel = denoise_pixel;
		ThinOut(least, film.runs[i].blocks);
		NoteChances(choices[i], film.runs[i]);
	}
	return film;
}

PilotRun Joined(const FilmRun& film)
{
	PilotRun joined;
	const double share = 1.0 / double(film.runs.size()), frames = film.range.Count();
	joined.log = film.runs[0].log;
	joined.machine.threads = film.runs[0].machine.threads;
	joined.machine.rows = film.runs[0].machine.rows;
	joined.machine.denoise_pixel = film.runs[0].machine.denoise_pixel;
	joined.machine.rays_per_sample = 0;
	for (const PilotRun& run : film.runs)
	{
		joined.blocks.insert(joined.blocks.end(), run.blocks.begin(), run.blocks.end());
		for (size_t b = joined.blocks.size() - run.blocks.size(); b < joined.blocks.size(); ++b)
			joined.blocks[b].picture = joined.pictures.size();
		joined.pictures.insert(joined.pictures.end(), run.pictures.begin(), run.pictures.end());
		joined.wall += run.wall;
		joined.machine.pixels += run.machine.pixels * share * frames;
		joined.machine.start_cpu += run.machine.start_cpu * share * frames;
		joined.machine.start_wall += run.machine.start_wall * share * frames;
		joined.machine.rays_per_sample += run.machine.rays_per_sample * share;
		joined.log.radiosity |= run.log.radiosity;
		joined.log.photons |= run.log.photons;
	}
	return joined;
}

}
