// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Solvers whose refusal is one answer among others.

#ifndef TILTCAL_IF_ANSWERED_H
#define TILTCAL_IF_ANSWERED_H

#include <tiltcal/error.h>

#include <optional>
#include <string>

namespace tiltcal
{

/// What `solve` returns; none where it throws Refused, whose words go to `why`. What else it throws goes on.
template<typename Solve>
auto IfAnswered(const Solve& solve, std::string* why = nullptr) -> std::optional<decltype(solve())>
{
	try
	{
		return solve();
	}
	catch (const Error& e)
	{
		if (e.Code() != EXIT_REFUSED)
			throw;
		if (why)
			*why = e.what();
		return std::nullopt;
	}
}

}

#endif
