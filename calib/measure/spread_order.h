// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_SPREAD_ORDER_H
#define TILTCAL_SPREAD_ORDER_H

#include <tiltcal/board.h>

#include <vector>

namespace tiltcal
{

/// An edge between neighbouring inner corners: (column, row) to its right or lower neighbour.
struct EdgePlace
{
	int column, row;
	bool along_columns;
};

/// All edges of the board, in an order whose every beginning is spread evenly over the board
/// and takes both directions in turn. Deterministic. `phase` in [0, 1) begins it elsewhere:
/// other phases give other subsets of the same evenness, 0 is what tiltcal uses.
std::vector<EdgePlace> SpreadOrder(const Board& board, double phase);

/// A part of the outline of circle `index` of a row.
struct ArcPlace
{
	int index, row, arc;
};

/// The same for circles of `arcs` arcs (4 or 8): all circles once, each with another arc than those before it, then all again.
std::vector<ArcPlace> SpreadArcs(const Board& board, int arcs, double phase);

}

#endif
