// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the library has to say while it works: to whoever listens, else to nobody.

#ifndef TILTCAL_LOG_H
#define TILTCAL_LOG_H

#include <functional>
#include <string>

namespace tiltcal
{

enum class Severity
{
	INFO,
	WARNING
};

/// May be empty. Called from the thread that called the library.
using Listener = std::function<void(Severity severity, const std::string& message)>;

/// Inputs stand in backquotes in messages, by their names in the headers or, where those differ, on tiltcal's command line without
/// the dashes: `pitch`, `board`.
class Log
{
public:
	Log() = default;
	Log(Listener to_whom) : listener(std::move(to_whom)) {}

	void Info(const std::string& message) const { Say(Severity::INFO, message); }
	void Warn(const std::string& message) const { Say(Severity::WARNING, message); }

private:
	void Say(Severity severity, const std::string& message) const
	{
		if (listener)
			listener(severity, message);
	}

	Listener listener;
};

}

#endif
