// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What tiltcost says: table, CSV, plot, answers.

#ifndef TILTCOST_REPORT_H
#define TILTCOST_REPORT_H

#include "tiltcost/pilot_run.h"
#include "tiltcost/search.h"

#include <string>
#include <vector>

namespace tiltcost
{

/// A frame of a film by itself.
struct FrameRow
{
	int frame = 0;
	Row row;
};

struct Report
{
	std::string scene;
	PilotRun pilot;             ///< its blocks may be gone by now
	int blocks = 0, samples = 0;
	FrameRange range;           ///< of a film; else 0..0
	std::vector<FrameRow> frames;   ///< its pilots' frames, for the row where it stops paying or the answer
	std::vector<Row> best;      ///< as of BestRows
	std::vector<Row> rows;      ///< of the table, the coarsest first
	std::vector<Row> own;       ///< settings that were asked for
	double denoise_seconds = 0; ///< what denoise takes for the picture
	double stop_levels = 0;     ///< where it stops paying
};

/// "42.1 s", "12 min 05 s", "3 h 20 min".
std::string DurationText(double seconds);

/// "1.24 M".
std::string CountText(double count);

/// Picture, pilot and how sure the predictions are.
std::string HeaderText(const Report& report);

/// The table and the rule that marks a row.
std::string TableText(const Report& report);

/// What each of the film's frames that had a pilot costs and gives. Empty for one picture.
std::string FramesText(const Report& report);

/// That the blocks are too few to say how sure the predictions are; empty where they are enough, or all of the picture.
std::string FewBlocksText(const Report& report);

/// One setting, what it costs and how surely (where its spread is known), for --time and the like.
std::string AnswerText(const Row& row);

std::string CsvText(const Report& report);

/// Time against error, both logarithmic. SVG or PNG by the file's suffix. Throws tiltcal::Error.
void WritePlot(const Report& report, const std::string& file);

}

#endif
