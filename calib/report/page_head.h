// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_PAGE_HEAD_H
#define TILTCAL_PAGE_HEAD_H

#include <string>

namespace tiltcal
{

/// Up to and with <body>: title and styles, `more_styles` (CSS) among them. `loads_itself`: every few seconds again.
std::string PageHead(bool loads_itself, const std::string& more_styles = {});

}

#endif
