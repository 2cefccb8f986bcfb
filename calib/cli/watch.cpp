// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/watch.h"

#include "base/files.h"
#include "base/stopwatch.h"
#include "calibrate/exif_check.h"
#include "calibrate/measure_all.h"
#include "calibrate/next_photographs.h"
#include "calibrate/coverage.h"
#include "calibrate/quiet.h"
#include "calibrate/stops_of_photographs.h"
#include "calibrate/use_threads.h"
#include "cli/watched_files.h"
#include "program/process.h"
#include "program/spelling.h"
#include "report/write_report.h"

#include <tiltcal/error.h>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <thread>
#include <tuple>
#include <utility>

namespace tiltcal
{

namespace
{

const auto PAUSE = std::chrono::milliseconds(200);
/// A file that cannot be read may not be whole yet, however still it stands.
const auto ONCE_MORE = std::chrono::seconds(3);

/// What became of a file.
struct Measured
{
	FileStamp stamp;
	std::optional<MeasuredPhotograph> photograph;   ///< none: `why`
	PackedPicture picture;
	std::string why;
	std::string unfit;   ///< why it was left out beside the others that are there; when these go it may fit
	std::optional<std::chrono::steady_clock::time_point> again;   ///< look once more then
};

/// One pass over what was there.
struct Assembled
{
	Task task;
	std::vector<std::vector<const PackedPicture*>> packed;
	size_t photographs = 0;
};

class Watcher
{
public:
	explicit Watcher(const CalibrateRun& what) : run(what), fields(what.fields), files(what.words.watch, what.states), field_files(what.words.watch, PatternsOf(what.fields)) {}

	void UntilInterrupted()
	{
		notes.on = true;
		Tell(fmt::format("watching {}; Ctrl-C ends", run.words.watch));
		WriteWaiting({});
		while (!WasInterrupted())
		{
			files.Look();
			field_files.Look();
			LookAtFields();
			LookOnceMore();
			if (MeasureNew() && !files.Pending() && !field_files.Pending() && !WasInterrupted())
				CalibrateAgain();
			for (int k = 0; k < 5 && !WasInterrupted(); ++k)
				std::this_thread::sleep_for(PAUSE);
		}
		Finish();
	}

private:
	/// A line on the terminal, and on the page.
	void Tell(const std::string& event)
	{
		const std::string text = SpelledAsOptions(event);
		notes.events.push_back(fmt::format("{:%H:%M:%S} {}", fmt::localtime(std::time(nullptr)), text));
		run.options.log.Info(notes.events.back());
	}

	/// Warnings as events, each once.
	Log Warnings()
	{
		return Log([this](Severity severity, const std::string& text)
		{
			if (severity == Severity::WARNING && warned.insert(text).second)
				Tell(text);
		});
	}

	static std::vector<StatePatterns> PatternsOf(const std::vector<FieldPattern>& fields)
	{
		std::vector<StatePatterns> patterns;
		for (const FieldPattern& field : fields)
			patterns.push_back({ field.option, field.option, { field.pattern }, {} });
		return patterns;
	}

	/// Flat fields that have come, changed or gone make the calibration another.
	void LookAtFields()
	{
		std::map<std::string, FileStamp> there;
		for (const StateFiles& field : field_files.Settled())
			for (const std::string& file : field.files)
			{
				there[file] = field_files.StampOf(file);
				if (const auto old = fields_seen.find(file); old == fields_seen.end() || !(old->second == there[file]))
					Tell(fmt::format("{}: a flat field ({})", file, field.name));
			}
		for (const auto& [file, stamp] : fields_seen)
			if (!field_files.IsThere(file))
				Tell(file + ": is gone");
		changed = changed || there != fields_seen;
		fields_seen = std::move(there);
	}

	/// At flat fields that could not be read: once, if nothing else has come.
	void LookOnceMore()
	{
		if (changed || photographs_changed)
			again = Again::NOT;
		if (again != Again::LATER || std::chrono::steady_clock::now() < look_again)
			return;
		again = Again::DONE;
		changed = true;
	}

	/// Measures what has arrived or changed and forgets what is gone. True: the photographs, or flat fields, are others than those calibrated last.
	bool MeasureNew()
	{
		for (const StateFiles& state : files.Settled())
			for (const std::string& file : state.files)
				if (!WasInterrupted())
					MeasureIfNew(state.name, file);
		for (auto at = measured.begin(); at != measured.end();)
			if (files.IsThere(at->first))   // what is being written again is not gone
				++at;
			else
			{
				Tell(at->first + ": is gone");
				photographs_changed = photographs_changed || (at->second.photograph && at->second.unfit.empty());
				at = measured.erase(at);
			}
		changed = changed || photographs_changed;
		return changed;
	}

	void MeasureIfNew(const std::string& state, const std::string& file)
	{
		const FileStamp stamp = files.StampOf(file);
		const auto old = measured.find(file);
		const auto now = std::chrono::steady_clock::now();
		const bool second_look = old != measured.end() && old->second.stamp == stamp && old->second.again && now >= *old->second.again;
		if (old != measured.end() && old->second.stamp == stamp && !second_look)
			return;
		Measured one;
		one.stamp = stamp;
		try
		{
			const QuietLibraries quiet;
			const UseThreads threads(run.measure.threads);
			cv::Mat grey;
			one.photograph = MeasureOne(file, run.board, run.measure, grey);
			one.picture = Pack(grey);
			const Stance s = StanceOf(one.photograph->photo);
			Tell(fmt::format("{}, state {}: {}; the board: {}, {:.0f} % of the picture's width, blur {:.1f} to {:.1f} px", file, state, CountText(one.photograph->photo), StanceWords(s), 100 * s.share_of_width, s.least_blur, s.most_blur));
			WarnOfEdges(one.photograph->photo, Warnings());
			photographs_changed = true;
		}
		catch (const Error& e)
		{
			one.why = e.what();
			if (!second_look && e.Code() == EXIT_FILE)
				one.again = now + ONCE_MORE;
			if (!second_look || one.why != old->second.why)
				Tell(fmt::format("skipped: {}", one.why));
			photographs_changed = photographs_changed || (old != measured.end() && old->second.photograph);
		}
		measured[file] = std::move(one);
	}

	Assembled Assemble()
	{
		Assembled out;
		TaskOfPhotographs task(files.Settled(), run.board, run.Pitch(PhotographsAlone()));
		out.packed.resize(task.Get().states.size());
		for (size_t s = 0; s < files.Settled().size(); ++s)
			for (const std::string& file : files.Settled()[s].files)
			{
				const auto at = measured.find(file);
				if (at == measured.end() || !at->second.photograph)
					continue;
				try
				{
					task.Add(s, *at->second.photograph);
					at->second.unfit.clear();
					out.packed[task.StateOf(s)].push_back(&at->second.picture);
					++out.photographs;
				}
				catch (const Error& e)
				{
					if (at->second.unfit != e.what())
						Tell(fmt::format("skipped: {}", e.what()));
					at->second.unfit = e.what();
				}
			}
		out.task = task.Get();
		SetStops(out.task, run.options.log);
		LogFacts(out.task, Warnings());
		return out;
	}

	/// How many there are of the board.
	size_t Photographs() const
	{
		size_t count = 0;
		for (const StateFiles& state : PhotographsAlone())
			count += state.files.size();
		return count;
	}

	/// For EXIF.
	std::vector<StateFiles> PhotographsAlone() const
	{
		std::vector<StateFiles> out;
		for (const StateFiles& state : files.Settled())
		{
			out.push_back({ state.name, {}, state.f_number });
			for (const std::string& file : state.files)
				if (const auto at = measured.find(file); at != measured.end() && at->second.photograph)
					out.back().files.push_back(file);
		}
		return out;
	}

	void CalibrateAgain()
	{
		changed = photographs_changed = usable = false;
		why_not.clear();
		why_code = EXIT_REFUSED;
		Assembled now;
		bool is_writing = false;
		try
		{
			if (Photographs() == 0)
				return WriteWaiting({});
			now = Assemble();
			if (now.photographs == 0)
				return WriteWaiting(now.task);
			// A state to come is no state yet.
			Task task = now.task;
			std::vector<std::vector<const PackedPicture*>> packed = now.packed;
			DropEmptyStates(task, packed);
			const Stopwatch time;
			run.fields = FieldsThatAreThere(task);
			const Calibration c = run.Solve(task, last_seconds);
			last_seconds = time.Seconds();
			Remember(now.photographs, c);
			Say(now.photographs, c);
			is_writing = true;
			run.Write(c, packed, notes);
			last.emplace(c);
			last_packed.clear();
			for (const auto& state : packed)
			{
				last_packed.emplace_back();
				for (const PackedPicture* picture : state)
					last_packed.back().push_back(*picture);
			}
			usable = true;
		}
		catch (const Error& e)
		{
			// What cannot be read may be whole, or gone, when it is looked at next.
			if (is_writing && e.Code() == EXIT_FILE)
				throw;
			if (e.Code() == EXIT_FILE && again != Again::DONE)
			{
				again = Again::LATER;
				look_again = std::chrono::steady_clock::now() + ONCE_MORE;
			}
			why_not = e.what();
			why_code = e.Code();
			const size_t count = Photographs();
			Tell(fmt::format("no calibration of {} photograph{} yet: {}", count, count == 1 ? "" : "s", why_not.substr(0, why_not.find('\n'))));
			WriteWaiting(now.task);
		}
	}

	void DropEmptyStates(Task& task, std::vector<std::vector<const PackedPicture*>>& packed) const
	{
		if (task.states[0].photos.empty())
			throw Refused(fmt::format("no untilted photograph of the board yet: take those first ({})", run.states[0].patterns[0]));
		for (size_t s = task.states.size(); s-- > 1;)
			if (task.states[s].photos.empty())
			{
				task.states.erase(task.states.begin() + std::ptrdiff_t(s));
				packed.erase(packed.begin() + std::ptrdiff_t(s));
			}
	}

	/// Flat fields whose files have come, whole, by the states that are there.
	std::vector<FieldPattern> FieldsThatAreThere(const Task& task) const
	{
		const std::vector<std::string> names = NamesOf(run.states);
		std::vector<FieldPattern> out;
		for (size_t f = 0; f < fields.size(); ++f)
			for (size_t s = 0; s < task.states.size(); ++s)
				if (task.states[s].name == names[fields[f].state])
					for (const std::string& file : field_files.Settled()[f].files)
						out.push_back({ s, fields[f].option, AsPattern(file) });
		return out;
	}

	void Remember(size_t photographs, const Calibration& c)
	{
		if (!c.next.known)
			return;
		if (!notes.history.empty() && notes.history.back().photographs >= photographs)
			while (!notes.history.empty() && notes.history.back().photographs >= photographs)
				notes.history.pop_back();
		notes.history.push_back({ photographs, c.next.sigmas });
	}

	void Say(size_t photographs, const Calibration& c)
	{
		std::string tilts;
		for (size_t s = 1; s < c.task.states.size(); ++s)
			tilts += fmt::format(", {} {:.3f} +- {:.3f} degrees", c.task.states[s].name, c.TiltOf(s).lens_tilt.value, c.TiltOf(s).lens_tilt.sigma);
		Tell(fmt::format("calibrated from {} photographs: {}, w {:.3f} +- {:.3f} mm{}; {}", photographs, c.IsJudged() ? NameOf(c.verdict.grade) : "not judged", c.solution.w_mm.value, c.solution.w_mm.sigma, tilts,
			c.next.known && c.next.missing.empty() ? "nothing is missing" : !c.next.photographs.empty() ? "next: " + c.next.photographs[0].text : "see report.html"));
	}

	void WriteWaiting(const Task& task)
	{
		notes.waiting = SpelledAsOptions(why_not.substr(0, why_not.find('\n')));
		notes.lacking.clear();
		for (const std::string& line : WhatPhotographsLack(task.states.empty() ? EmptyTask() : task))
			notes.lacking.push_back(SpelledAsOptions(line));
		std::error_code none;
		notes.beside_earlier = std::filesystem::exists(Join(run.words.out, "calibration.json"), none);
		WriteText(Join(run.words.out, "report.html"), WaitingPage(task, notes, TimeOfDay()));
	}

	Task EmptyTask() const
	{
		Task task;
		task.board = run.board;
		for (const std::string& name : NamesOf(run.states))
			task.states.push_back({ name, !task.states.empty(), {} });
		return task;
	}

	/// The page loads itself no more.
	void Finish()
	{
		notes.on = false;
		if (changed && usable && !photographs_changed && field_files.Pending())
			Tell("a flat field is being written still: the last calibration stands");
		else if (changed)
			CalibrateAgain();
		if (!usable)
		{
			if (!changed && why_not.empty())
				WriteWaiting({});
			if (why_code == EXIT_USAGE)
				throw UsageError(why_not);
			throw Refused(why_not.empty() ? "--watch: no photograph of the board has come" : why_not);
		}
		std::vector<std::vector<const PackedPicture*>> packed;
		for (const auto& state : last_packed)
		{
			packed.emplace_back();
			for (const PackedPicture& picture : state)
				packed.back().push_back(&picture);
		}
		Tell("ended");
		run.Write(*last, packed, notes);
		fmt::print("{}written to {}\n", SummaryTable(*last), run.words.out);
		RefuseUnlessConverged(*last);
	}

	CalibrateRun run;
	std::vector<FieldPattern> fields;
	WatchedFiles files, field_files;
	std::map<std::string, Measured> measured;
	std::map<std::string, FileStamp> fields_seen;
	std::set<std::string> warned;
	WatchNotes notes;
	bool changed = false, photographs_changed = false, usable = false;
	enum class Again { NOT, LATER, DONE } again = Again::NOT;
	std::chrono::steady_clock::time_point look_again;
	std::string why_not;
	int why_code = EXIT_REFUSED;
	double last_seconds = 0;
	std::optional<Calibration> last;
	std::vector<std::vector<PackedPicture>> last_packed;
};

}

void Watch(const CalibrateRun& run)
{
	std::error_code unreachable;
	if (!std::filesystem::is_directory(run.words.watch, unreachable))
		throw FileError(fmt::format("--watch {}: no such folder; give the one that the camera's photographs arrive in", run.words.watch));
	PrepareFolder(run.words.out);
	CatchInterrupts(Second::ENDS);
	Watcher(run).UntilInterrupted();
}

}
