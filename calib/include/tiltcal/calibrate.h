// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The whole way: photographs, what is measured in them, the calibration.

#ifndef TILTCAL_CALIBRATE_H
#define TILTCAL_CALIBRATE_H

#include <tiltcal/api.h>
#include <tiltcal/calibration.h>
#include <tiltcal/log.h>
#include <tiltcal/transfer.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tiltcal
{

/// Throws UsageError for a pitch (mm) that no sensor has.
TILTCAL_API void CheckPitch(double pitch_mm);

struct StateFiles
{
	std::string name;
	std::vector<std::string> files;
	std::optional<double> f_number{};   ///< at which they were taken, as engraved; none: EXIF's, where others have one
};

struct MeasureOptions
{
	Transfer transfer{};
	/// Accept a board that appears turned by more than 90 degrees from its upright position. Off by default: a
	/// checkerboard's colours cannot tell a mirrored picture from a board upside down.
	bool any_orientation = false;
	/// 0: all edges; otherwise so many of every photograph, spread over the board: faster, less accurate.
	int edges_per_photo = 0;
	double edge_phase = 0;   ///< 0 to 1: which ones
	Log log{};
	/// 0: all processors. What is measured does not depend on it. Each takes memory for a photograph, some 40 bytes a pixel.
	int threads = 0;
};

/// Measures every photograph, several at once; the log hears of them in their order, by the caller's thread. States come out in the order given; the first is the untilted one. Several of
/// one name are one state, photographed at several f-numbers; their photographs follow each other. Where f-numbers differ the task has stops. `pitch_mm`: distance of the sensor's pixel centres. Throws Error: unreadable, no board, sizes differ, f-numbers told of some photographs and neither told nor in EXIF of others.
TILTCAL_API Task MeasureAll(const std::vector<StateFiles>& states, const Board& board, double pitch_mm, const MeasureOptions& options = {});

/// Measures a photograph of an evenly lit plain surface taken in state `state`. Throws Error: unreadable, of another size, clipped, dark.
TILTCAL_API void AddFlatField(Task& task, size_t state, const std::string& file, const MeasureOptions& options = {});

/// Whether photograph n shows the board in the same pose in every state.
enum class Poses
{
	AUTO,     ///< shared when the counts agree and the corners do too
	SHARED,
	OWN
};

/// What the last step compares.
enum class Refinement
{
	NONE,         ///< nothing: geometry first, then blur with the geometry held
	EDGES,        ///< place and blur width of every edge
	PHOTOMETRIC   ///< the brightness across every edge
};

/// Which effects the camera blocks name.
struct EffectChoice
{
	enum Kind
	{
		AUTO,    ///< significant at 2 sigma, rims at 4, and photographs left out are predicted better
		ALL,     ///< all that can be estimated
		LIST     ///< exactly `listed`, which may be none
	} kind = AUTO;
	std::set<EffectId> listed{};

	/// Named, or one of all.
	bool Wants(EffectId effect) const { return kind == ALL || (kind == LIST && listed.count(effect) > 0); }
	/// Not to be written whatever the photographs say.
	bool Excludes(EffectId effect) const { return kind == LIST && listed.count(effect) == 0; }
};

struct CalibrateOptions
{
	/// None: curved where it predicts photographs left out better, else plane; from there on lens, where aberrations are left over and it predicts them better.
	std::optional<Model> model;
	Poses poses = Poses::AUTO;
	Refinement refinement = Refinement::EDGES;
	EffectChoice effects{};
	/// Where a real lens is the answer: find the one of sixteen numbers for scenes too, which takes as long again as all the rest.
	bool scene_lens = true;
	bool next_photographs = false;   ///< fill Calibration::next, what to photograph next: a second or two
	Log log{};
	/// 0: all processors. Sums come out in another order with another number, and results differ in their last digits.
	int threads = 0;
};

/// Solves everything. The paper's model is always solved too, and only refused when it was the one asked for. Then vignetting
/// and chromatic aberration are estimated, the effects chosen and the result judged. Throws Refused, naming what to photograph (further lines: what the photographs lack);
/// UsageError where the options contradict each other.
TILTCAL_API Calibration Calibrate(const Task& task, const CalibrateOptions& options = {});

}

#endif
