// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Of a photograph, the picture without its distortion, and where each one's pixels are in the other.

#ifndef TILTCAL_FLAT_VIEW_H
#define TILTCAL_FLAT_VIEW_H

#include <tiltcal/camera.h>

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Pixels added to the picture on the left and right, and on top and bottom.
struct Margins
{
	int x = 0, y = 0;
};

/// The same camera, place and focus without distortion, its picture larger by the margins. Straight lines are straight in it: a tilted
/// lens, too, puts points where lines through its centre meet the sensor.
StateCamera FlatView(const StateCamera& camera, const Margins& margins);

/// The least margins with which the flat view shows all of the photograph. Throws Refused where that is more than three pictures wide:
/// the distortion is not to be undone at its edge.
Margins MarginsOfAll(const StateCamera& camera);

/// `percent` of the picture's width and height on each side, or "auto": MarginsOfAll. Throws UsageError (0 to 100 percent).
Margins ParseOverscan(const std::string& text, const StateCamera& camera);

/// Share of the photograph's pixels that the flat view shows, 0..1.
double SharePictured(const StateCamera& camera, const Margins& margins);
/// The same from PixelMap(camera, flat), where that is there already.
double SharePictured(const cv::Mat& map, const StateCamera& flat);

/// CV_32FC2, as large as the picture of `to`: where in `from` each of its pixels is, px. NaN: nowhere, because the lens never bends light
/// there. One of the two may have a distortion.
cv::Mat PixelMap(const StateCamera& to, const StateCamera& from);

}

#endif
