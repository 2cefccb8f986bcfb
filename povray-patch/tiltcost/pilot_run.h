// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The pilot renders of a scene: a first look at all blocks, to learn what a sample costs and which blocks are worth
// many, and one that fills the time that was given.

#ifndef TILTCOST_PILOT_RUN_H
#define TILTCOST_PILOT_RUN_H

#include "program/process.h"
#include "program/temporary_folder.h"
#include "tiltcost/pilot_file.h"
#include "tiltcost/search.h"

#include <optional>
#include <string>
#include <vector>

namespace tiltcost
{

/// How to render the scene.
struct Job
{
	std::string povray;                 ///< the patched program
	std::string scene;                  ///< .pov or .ini, as the user names it
	std::vector<std::string> options;   ///< POV-Ray's words, the scene's among them, in the user's order
	double pilot_seconds = 10;          ///< wall time for which both pilots together may begin blocks
	int most_blocks = 240;
	bool rows = false;                  ///< only where the time goes is asked: many blocks of few samples
	bool may_write = false;             ///< the scene's own #fopen .. write and append
	int frames = 0;                     ///< of a film, so many have pilots; 0: the scene is one picture
};

/// The frames of a film that are to be rendered, first..last (inclusive).
struct FrameRange
{
	int first = 0, last = 0;

	int Count() const { return last - first + 1; }
};

/// `count` of them or all: the middle one of each of as many parts of the same length, so that their mean is the film's.
std::vector<int> PilotedFrames(const FrameRange& range, int count);

struct PilotPlan
{
	int blocks, samples;
};

/// What to trace in `seconds` on `threads`, if a sample costs `seconds_per_sample`: the most
/// samples per pixel (64 to 1024) that leave blocks enough to stand for the picture.
PilotPlan PlanPilot(double seconds_per_sample, int threads, double seconds, int most_blocks);

/// The same where only the cost of places is asked: as many blocks as there is time for.
PilotPlan PlanRowsPilot(double seconds_per_sample, int threads, double seconds, int most_blocks);

/// What POV-Ray said about a render.
struct RenderLog
{
	int width = 0, height = 0;          ///< of the picture
	double pixels = 0;                  ///< of the rows and columns that are rendered
	int rows = 0;
	int threads = 1;
	bool radiosity = false, photons = false;
	bool pinhole = false;               ///< a tilt_lens with aperture 0
	double camera_rays = 0;             ///< of the lens, all together
	int first_frame = 0, last_frame = 0, frame_step = 1;    ///< of an animation
	int rendered_frames = 0;            ///< how many of them were asked for
	bool writes = false;                ///< it was refused because its scene writes files
};

/// FILE of FILE.ini[SECTION].
std::string WithoutSection(const std::string& scene);

/// Whether POV-Ray is to be given `scene` as an ini file, FILE.ini or FILE.ini[SECTION], not as a scene.
bool IsIniFile(const std::string& scene);

/// A file of the command line as POV-Ray takes it; the first is the scene.
std::string FileWord(const std::string& file, bool first);

/// The user's options, and after them those that keep the user's picture and screen as they are. `frame`: of an
/// animation, else none.
std::vector<std::string> PilotCommand(const Job& job, const tiltcal::TemporaryFolder& folder, std::optional<int> frame = {});

/// All of a file; nothing where there is none.
std::string Contents(const std::string& file);

/// Throws tiltcal::Error where POV-Ray, which said `said`, could not be run or did not render the scene.
void CheckPilotRender(const Job& job, const tiltcal::ProcessResult& result, const std::string& said);

RenderLog ReadRenderLog(const std::string& log);

/// Which frames POV-Ray renders that said so and was given these options; none where only a part of an animation is, and no option says by number which.
std::optional<FrameRange> RenderedFrames(const RenderLog& log, const std::vector<std::string>& options);

/// POV-Ray's own error lines, or its last ones where it names no error.
std::string ErrorLines(const std::string& log);

struct PilotRun
{
	std::vector<ScoutedBlock> scouted;  ///< of a first look; else
	std::vector<PilotBlock> blocks;
	std::vector<Population> pictures;   ///< that the blocks are of
	Machine machine;
	RenderLog log;
	double wall = 0;                    ///< seconds that both pilots took
};

/// A film: pilots of some of its frames.
struct FilmRun
{
	FrameRange range;
	std::vector<int> frames;
	std::vector<PilotRun> runs;         ///< of each of them, as many samples a pixel and as many blocks each
};

/// Renders with progress on stderr. Throws tiltcal::Error where the scene does not render or has no
/// tilt_lens with an aperture, and Interrupted.
PilotRun RunPilots(const Job& job, const tiltcal::TemporaryFolder& folder);

/// The same for job.frames frames of a film. Throws tiltcal::Error also where the scene is no animation.
FilmRun RunFilmPilots(const Job& job, const tiltcal::TemporaryFolder& folder);

/// The film as one long picture: the blocks of all pilots, and the pixels and starts of all frames.
PilotRun Joined(const FilmRun& film);

}

#endif
