// SPDX-License-Identifier: AGPL-3.0-or-later

#ifndef TILTCAL_CODE_OF_H
#define TILTCAL_CODE_OF_H

#include <tiltcal/error.h>

/// The exit code that a function ends with.
template<typename Function>
int CodeOf(const Function& function)
{
	try
	{
		function();
	}
	catch (const tiltcal::Error& e)
	{
		return e.Code();
	}
	return tiltcal::EXIT_DONE;
}

#endif
