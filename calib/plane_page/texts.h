// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The page's files as strings, made by texts.cmake.

#ifndef TILTCAL_PLANE_PAGE_TEXTS_H
#define TILTCAL_PLANE_PAGE_TEXTS_H

namespace tiltcal
{

extern const char* const PlaneStyleText;       ///< style.css
extern const char* const PlanePageStyleText;   ///< page.css
extern const char* const PlaneScriptText;      ///< the .js files, page.js last

}

#endif
