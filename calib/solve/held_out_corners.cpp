// SPDX-License-Identifier: AGPL-3.0-or-later

#include "solve/held_out_corners.h"

#include "model/predict.h"
#include <tiltcal/photo.h>
#include <tiltcal/error.h>

#include <cmath>

namespace tiltcal
{

namespace
{

/// Every other one of a row; in an asymmetric grid every other column of a row holds a circle.
bool IsOfHalf(const Board& board, const Corner& c, int half)
{
	const int number = board.kind == TargetKind::ASYMMETRIC_CIRCLES ? c.column / 2 : c.column;
	return (number + c.row) % 2 == half;
}

/// The task with one half of the corners, and nothing else that was measured.
Task HalfOf(const Task& task, int half)
{
	Task result;
	result.board = task.board;
	result.pitch_mm = task.pitch_mm;
	result.width = task.width;
	result.height = task.height;
	result.priors = task.priors;
	for (const State& state : task.states)
	{
		result.states.push_back({ state.name, state.tilted, {} });
		for (const Photo& photo : state.photos)
		{
			Photo own;
			own.file = photo.file;
			own.width = photo.width;
			own.height = photo.height;
			for (const Corner& c : photo.corners)
				if (IsOfHalf(task.board, c, half))
					own.corners.push_back(c);
			result.states.back().photos.push_back(own);
		}
	}
	return result;
}

}

double CornersLeftOut(const Task& task, const GeometryOptions& options)
{
	double squares = 0;
	size_t count = 0;
	for (const int half : { 0, 1 })
	{
		Geometry g;
		try
		{
			g = SolveGeometry(HalfOf(task, half), options);
		}
		catch (const Error&)
		{
			return 0;
		}
		for (size_t s = 0; s < task.states.size(); ++s)
			for (size_t p = 0; p < task.states[s].photos.size(); ++p)
				for (const Corner& c : task.states[s].photos[p].corners)
					if (!IsOfHalf(task.board, c, half))
					{
						const Point at = Reproject(task, g, s, p, c.column, c.row);
						squares += std::pow(at[0] - c.x, 2) + std::pow(at[1] - c.y, 2);
						++count;
					}
	}
	return std::sqrt(squares / double(count));
}

}
