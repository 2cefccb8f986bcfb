// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_MEASURE_H
#define TILTCAL_MEASURE_H

#include <tiltcal/board.h>
#include <tiltcal/photo.h>
#include "measure/detect.h"
#include <tiltcal/transfer.h>

#include <opencv2/core.hpp>

#include <string>
#include <vector>

namespace tiltcal
{

/// Which edges of a photograph are measured.
struct EdgeChoice
{
	int most = 0;       ///< 0: all; otherwise the first that can be measured of SpreadOrder
	double phase = 0;   ///< of SpreadOrder
};

/// Reads a photograph, finds its corners and measures the blur of its edges, or circles (measure_circles.h).
/// Throws FileError, Refused. `grey`, when given, receives the linear picture.
Photo MeasurePhoto(const std::string& file, const Board& board, const Transfer& transfer,
	const DetectOptions& options, const EdgeChoice& choice = {}, cv::Mat* grey = nullptr);

/// Blur width of the edges between neighbouring inner corners, in linear light.
/// Only pixels nearer to their edge than to anything that the blur of another edge
/// reaches are used; edges that have none are left out and counted in edges_dropped.
/// Refines photo.corners to the intersections of the fitted edges, where both directions
/// were measured; the time is proportional to the edges chosen.
void MeasureEdges(const cv::Mat& grey, const Board& board, Photo& photo, const EdgeChoice& choice = {});

}

#endif
