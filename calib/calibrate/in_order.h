// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Work on all threads, told of as if it were done one after the other.

#ifndef TILTCAL_IN_ORDER_H
#define TILTCAL_IN_ORDER_H

#include <cstddef>
#include <functional>

namespace tiltcal
{

/// Calls `work(k)` for k < count on `threads` of OpenCV's threads, and `tell(k)` on the caller's own, in the order of k and as soon
/// as may be. The first k whose work or tell throws ends it: that is thrown, later ones are not told, and what has not begun
/// does not begin. Where threads are left over, they are `work`'s: its own parallel loops run on one thread while others work.
void InOrder(size_t count, int threads, const std::function<void(size_t)>& work, const std::function<void(size_t)>& tell);

}

#endif
