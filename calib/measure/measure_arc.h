// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_MEASURE_ARC_H
#define TILTCAL_MEASURE_ARC_H

#include <tiltcal/photo.h>
#include "measure/circle_outline.h"
#include "edge/edge_fit.h"
#include "measure/light_field.h"
#include "measure/measure_edge.h"

#include <opencv2/core.hpp>

#include <vector>

namespace tiltcal
{

/// One circle of the grid as the picture should show it, and the pixels around it.
class CircleView
{
public:
	/// `feature`: its centre; `radius` of the grid's circles in units of the spacing.
	CircleView(const cv::Mat& grey, const Board& board, const GridMap& map, const LightField& light, const Corner& feature, double radius, bool bright);

	/// Fits arc `arc` of `arcs` (edge_fit.h), from `start_blur` px (radius; 0: unknown). `edge` receives everything of board.h but its profile.
	/// `rough`: fewer pixels. TOO_BLURRED: edge.blur and edge.square_px are filled in.
	EdgeOutcome Measure(int arc, int arcs, double start_blur, bool rough, Edge& edge) const;

	/// How far the outline at board angle t moves along `normal` when the radius grows by 1 (unit of the spacing), px.
	double Growth(double t, const Vec2& normal) const;

	/// How far the edge lies from the outline at its place, along its normal, px.
	double Offset(const Edge& edge) const;

	double SmallerRadius() const { return smaller_radius; }

private:
	/// A pixel near the outline.
	struct Pixel
	{
		double t;          // of the outline's nearest point, 0..2 pi
		double distance;   // to it, positive outside
		double clearance;  // to the outlines of other circles
		double value;
	};

	struct Arc;
	std::vector<EdgeSample> Collect(const Arc& arc, double blur, double reach) const;

	Vec2 place;
	double radius;
	bool bright;
	int column, row;
	Eigen::Matrix2d jacobian;
	CircleOutline outline;
	Vec2 light_change;   // LightField::Change
	double smaller_radius;
	std::vector<Pixel> pixels;
};

}

#endif
