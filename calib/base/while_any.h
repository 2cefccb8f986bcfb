// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Switches of libraries that are the whole process's.

#ifndef TILTCAL_WHILE_ANY_H
#define TILTCAL_WHILE_ANY_H

#include <mutex>
#include <optional>

namespace tiltcal
{

/// While any of them lives, in whichever thread, a Setting does: its constructor sets what its destructor sets back. Calls that overlap would
/// else take each other's setting for what was there before.
template<typename Setting>
class WhileAny
{
public:
	WhileAny()
	{
		const std::lock_guard<std::mutex> lock(mutex);
		if (living++ == 0)
			setting.emplace();
	}
	~WhileAny()
	{
		const std::lock_guard<std::mutex> lock(mutex);
		if (--living == 0)
			setting.reset();
	}
	WhileAny(const WhileAny&) = delete;
	WhileAny& operator=(const WhileAny&) = delete;

private:
	static inline std::mutex mutex;
	static inline int living = 0;
	static inline std::optional<Setting> setting;
};

}

#endif
