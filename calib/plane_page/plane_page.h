// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The page on which a lens can be tilted: a sketch to turn, sliders, and the tilt_lens block to copy. Offline, without
// anything from elsewhere.

#ifndef TILTCAL_PLANE_PAGE_H
#define TILTCAL_PLANE_PAGE_H

#include <string>

namespace tiltcal
{

/// For the head of a page that holds parts: the contents of a <style>.
std::string PlaneStyle();

/// For its end, after all parts: the contents of a <script>. Reads as XML only where scripts are not looked into.
std::string PlaneScript();

/// One live sketch. `lens` is JSON; its keys: README.md. What stands right behind it in an element of class "plane-still" is
/// shown instead where scripts do not run, and on paper.
std::string PlanePart(const std::string& lens);

/// A page of one. `title`: a name, such as the scene's; it is escaped here. `about`: HTML.
std::string PlanePage(const std::string& title, const std::string& about, const std::string& lens);

}

#endif
