// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Transfer curves: coded picture values 0..1 to linear light and back.

#ifndef TILTCAL_TRANSFER_H
#define TILTCAL_TRANSFER_H

#include <string>

namespace tiltcal
{

struct Transfer
{
	enum Kind { SRGB, LINEAR, GAMMA } kind = SRGB;
	double gamma = 1;   ///< linear = coded^gamma, for GAMMA
};

/// "srgb", "linear" or a gamma between 0.1 and 10. Throws UsageError.
Transfer ParseTransfer(const std::string& text);

/// The name as it is given on the command line.
std::string TransferName(const Transfer& transfer);

/// Linear light of a coded value (0..1, not clipped).
double ToLinear(const Transfer& transfer, double coded);

/// sRGB code 0..1 (IEC 61966-2-1) of linear light; clips to [0, 1].
double EncodeSrgb(double linear);

}

#endif
