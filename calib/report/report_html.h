// SPDX-License-Identifier: AGPL-3.0-or-later
//
// report.html: a calibration on one page that needs no other file and no network.

#ifndef TILTCAL_REPORT_HTML_H
#define TILTCAL_REPORT_HTML_H

#include <tiltcal/calibration.h>

#include "report/report_next.h"

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

/// What the page says of the run itself.
struct RunNotes
{
	std::string refinement;     ///< its name
	std::string command_line;   ///< empty: not shown
	std::string date;
	WatchNotes watch = {};      ///< of photographs that arrived one after the other
};

/// The overlays of a page, kept small as they come. Not safe for threads.
class ReportPictures
{
public:
	/// Shares some 14 MB among all photographs of the task.
	explicit ReportPictures(const Task& task);

	/// DrawOverlay's picture of the next photograph, in the order of states and photographs; its legend is cut off.
	void Add(const cv::Mat& overlay);

	/// data: URI of the n-th, or empty when that was not added.
	std::string Uri(size_t n) const { return n < uris.size() ? uris[n] : ""; }

private:
	int height;
	size_t bytes_each;
	std::vector<std::string> uris;
};

/// The whole page: well-formed as XML too. No scripts; every src is a data: URI.
std::string ReportHtml(const Calibration& calibration, const RunNotes& notes, const ReportPictures& pictures);

}

#endif
