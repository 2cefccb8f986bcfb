// SPDX-License-Identifier: AGPL-3.0-or-later
//
// A run of `tiltcal calibrate`: what its options say, and the way from photographs that are measured to the files.

#ifndef TILTCAL_CALIBRATE_RUN_H
#define TILTCAL_CALIBRATE_RUN_H

#include "program/progress.h"
#include "report/report_html.h"

#include <tiltcal/calibrate.h>

#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// The options as they were given.
struct CalibrateWords
{
	std::string board, target = "checkerboard", transfer = "srgb", model = "auto", poses = "auto", refine = "edges", effects = "auto", square, out, watch;
	double circle_diameter = 0;
	std::optional<double> pitch;
	std::vector<std::string> untilted, tilted, state, fix, prior, flat_field;
	bool any_orientation = false, untilted_free = false;
	int edges_per_photo = 0, threads = 0;
};

/// Where the photographs of a state at one f-number are, and the option that says it.
struct StatePatterns
{
	std::string name, option;
	std::vector<std::string> patterns;
	std::optional<double> f_number{};
};

/// Of the states, each once, in their order.
std::vector<std::string> NamesOf(const std::vector<StatePatterns>& states);

struct FieldPattern
{
	size_t state;   ///< of NamesOf
	std::string option, pattern;
};

/// What is known beforehand, by --fix, --prior and EXIF.
struct Known
{
	std::vector<Prior> priors;
	FixedBlades blades;
};

/// A photograph as it was measured, 8 bit, packed as PNG: for its overlay.
using PackedPicture = std::vector<unsigned char>;
PackedPicture Pack(const cv::Mat& grey);

class CalibrateRun
{
public:
	/// Throws UsageError for what the options say wrongly. No file is looked for.
	CalibrateRun(const CalibrateWords& words, const std::string& command_line);

	const CalibrateWords words;
	std::string command_line;
	Board board;
	MeasureOptions measure;
	CalibrateOptions options;
	std::vector<StatePatterns> states;   ///< those of one name follow each other; the untilted one first
	std::vector<FieldPattern> fields;
	Known known;

	/// --pitch, or what the photographs' EXIF says. Throws UsageError.
	double Pitch(const std::vector<StateFiles>& files) const;

	/// The calibration of photographs that were measured. `expected_seconds`: 0, or as long as it took the last time.
	Calibration Solve(Task task, double expected_seconds) const;

	/// All files of --out. `packed`: by state of the task and photograph.
	void Write(const Calibration& calibration, const std::vector<std::vector<const PackedPicture*>>& packed, const WatchNotes& watch) const;
};

/// Throws Refused where the joint refinement did not converge: a script that looks at nothing but the exit code is told too. To be called when all is written.
void RefuseUnlessConverged(const Calibration& calibration);

/// For the page.
std::string TimeOfDay();

}

#endif
