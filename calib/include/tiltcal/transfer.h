// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Transfer curves: coded picture values 0..1 to linear light and back.

#ifndef TILTCAL_TRANSFER_H
#define TILTCAL_TRANSFER_H

#include <tiltcal/api.h>

#include <string>

namespace tiltcal
{

struct Transfer
{
	enum Kind { SRGB, LINEAR, GAMMA } kind = SRGB;
	double gamma = 1;   ///< linear = coded^gamma, for GAMMA
};

/// "srgb", "linear" or a gamma between 0.1 and 10. Throws UsageError.
TILTCAL_API Transfer ParseTransfer(const std::string& text);

/// "srgb", "linear" or the gamma: what ParseTransfer reads.
TILTCAL_API std::string TransferName(const Transfer& transfer);

/// Linear light of a coded value (0..1, not clipped).
TILTCAL_API double ToLinear(const Transfer& transfer, double coded);

/// sRGB code 0..1 (IEC 61966-2-1) of linear light; clips to [0, 1].
TILTCAL_API double EncodeSrgb(double linear);

}

#endif
