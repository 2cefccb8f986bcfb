// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_MEASURE_EDGE_H
#define TILTCAL_MEASURE_EDGE_H

#include <tiltcal/photo.h>
#include "measure/corner_grid.h"
#include "measure/light_field.h"
#include "measure/spread_order.h"

#include <opencv2/core.hpp>

namespace tiltcal
{

/// Blur radius over the side of a square above which an edge is fitted together with its neighbours.
const double LONE_RATIO = 0.2;
/// Above this the plateaus are nowhere seen, and brightness, contrast and blur are told apart badly. From 0.4 on the sigmas
/// are too small by up to three times (0.45, frontal, squares of 40 px: 2.7 for corners, 3.3 for widths): the edges are
/// fitted in turns, each with the others held, which leaves out how neighbours err together.
const double MOST_RATIO = 0.5;

/// Where edges run into each other, a blur beyond MOST_RATIO can look like a smaller one of a grey board: (high - low) / (high
/// + low) below this is not believed there. Prints have 0.8 and more; 0.7 squares of blur look like 0.4 squares at 0.3.
const double LEAST_CONTRAST = 0.65;

/// A square narrower than this, px, holds too few pixels beside its edges' blur to measure any.
const double LEAST_SQUARE_PX = 8;

enum class EdgeOutcome
{
	MEASURED,
	FAILED,        ///< too small, too noisy, or not an edge
	TOO_BLURRED,   ///< above MOST_RATIO; edge.blur and edge.square_px are filled in
	LOW_CONTRAST   ///< below LEAST_CONTRAST; edge.low and edge.high are filled in
};

/// Fits one edge alone (edge_fit.h), with pixels that no other edge's blur reaches. `light`: of the same picture.
/// `edge` receives everything of board.h. TOO_BLURRED: above LONE_RATIO, try MeasureBlurredEdge.
EdgeOutcome MeasureLoneEdge(const cv::Mat& grey, const CornerGrid& grid, const LightField& light, const EdgePlace& place, Edge& edge);

/// The same with the edges around it in the model (blurred_checker.h), where `grid` says. Good for `start_radius` above
/// some 2.5 px. `growth`: gradient of the blur radius in the picture, from its neighbours; 0 where unknown. Only when
/// `last` are all pixels used, and do the sigmas contain what the neighbours' own uncertainty adds.
EdgeOutcome MeasureBlurredEdge(const cv::Mat& grey, const CornerGrid& grid, const LightField& light, const EdgePlace& place, double start_radius,
	const Vec2& growth, bool last, Edge& edge);

}

#endif
