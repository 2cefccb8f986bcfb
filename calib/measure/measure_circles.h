// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Centres and blur widths of a grid of circles.

#ifndef TILTCAL_MEASURE_CIRCLES_H
#define TILTCAL_MEASURE_CIRCLES_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>
#include "measure/detect.h"
#include "measure/measure.h"

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Blur radius over a circle's smaller radius in the picture above which arcs are not measured.
const double MOST_CIRCLE_RATIO = 0.6;

/// Finds the circles in `grey` (linear light, find_circles.h) and fits the blurred outline of each in 8 arcs, 4 where it is small
/// (edge_fit.h with circle_edge.h); fills photo.corners with the images of the circles' centres, photo.edges with the arcs and
/// what else board.h says. An arc's pixels are those that no other circle's blur reaches. The outline's shape is that of a circle
/// of the board under the map that the centres give (grid_map.h), so the centre is not the middle of the ellipse but where perspective puts it;
/// the place is fitted to the arcs of the circle, the circles' diameter to all arcs of the photograph, and that three times.
/// Circles without enough arcs (`choice`) keep what FindCircles says.
/// Throws Refused: FindCircles', circles too small, blur above MOST_CIRCLE_RATIO, another diameter than the board's.
void MeasureCircles(const cv::Mat& grey, const Board& board, const DetectOptions& options, Photo& photo, const EdgeChoice& choice = {});

}

#endif
