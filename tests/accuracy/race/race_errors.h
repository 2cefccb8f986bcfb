// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Distances of pictures from a truth.
#pragma once
#include "support/picture.h"

// mean((x - t)^2 / (t^2 + 0.01))
double RelativeMse(const Picture& picture, const Picture& truth);

// The picture moved by dx, dy pixels (to the right, down), to first order; good for a small part of a pixel.
Picture Moved(const Picture& picture, double dx, double dy);

struct Offset
{
	double dx = 0, dy = 0;
};

// Where the truth must be moved to so that the picture is nearest to it.
Offset FindOffset(const Picture& picture, const Picture& truth);

// The share of 8 x 8 blocks whose RMS error is more than 10 % above the other picture's.
double ShareOfWorseBlocks(const Picture& picture, const Picture& other, const Picture& truth);

// The RMS distance without what the truth's own error adds to it.
double WithoutOwnError(double rms, double own_error);

// The mean of pictures, and the error it has if they are independent.
Picture Mean(const std::vector<Picture>& pictures, double& own_error);
