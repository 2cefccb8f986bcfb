// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_MEASURE_ALL_H
#define TILTCAL_MEASURE_ALL_H

#include <tiltcal/calibrate.h>

#include <opencv2/core.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace tiltcal
{

/// Photograph `number` of all, counted from 0: its brightness in linear light (CV_32F), as it was measured. Called from any thread and
/// in any order.
using SeePicture = std::function<void(size_t number, const cv::Mat& grey)>;

/// A photograph as MeasureAll measures it.
struct MeasuredPhotograph
{
	Photo photo;
	size_t hash = 0;   ///< of its pixels
};

/// Throws UsageError for fewer edges than tell anything of a board; 0 is all.
void CheckEdgesPerPhoto(int edges_per_photo);

/// Warns of edges that were left out, and of clipped ones.
void WarnOfEdges(const Photo& photo, const Log& log);

/// `grey` receives its brightness in linear light. Throws Error.
MeasuredPhotograph MeasureOne(const std::string& file, const Board& board, const MeasureOptions& options, cv::Mat& grey);

/// A task, photograph by photograph, without stops (stops_of_photographs.h). Throws as MeasureAll.
class TaskOfPhotographs
{
public:
	TaskOfPhotographs(const std::vector<StateFiles>& states, const Board& board, double pitch_mm);

	/// To the `set`-th of the states that were given. Throws Refused, and adds nothing: of another size, or the pixels of another.
	void Add(size_t set, MeasuredPhotograph photograph);

	/// The state of the task that a set is of.
	size_t StateOf(size_t set) const { return sets[set].state; }

	const Task& Get() const { return task; }

private:
	/// Photographs of one state at one f-number.
	struct Set
	{
		size_t state;
		std::optional<double> f_number;
	};

	Task task;
	std::vector<Set> sets;
	std::map<size_t, std::string> seen;   ///< by hash
};

/// MeasureAll, which shows every photograph when it is measured, so that nobody reads it again. `see` may be empty.
Task MeasureAll(const std::vector<StateFiles>& states, const Board& board, double pitch_mm, const MeasureOptions& options, const SeePicture& see);

}

#endif
