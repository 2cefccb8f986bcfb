// SPDX-License-Identifier: AGPL-3.0-or-later

#include "base/unfinished.h"

#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <mutex>

namespace tiltcal
{

namespace
{

/// A list that only grows, so that a handler may walk it while it does; places are used again.
struct Place
{
	std::string file;
	std::atomic<bool> taken{ false };
	Place* next = nullptr;
};

std::atomic<Place*> first{ nullptr };
std::mutex writers;
std::atomic<int> changing{ 0 }, late{ 0 };

}

void NoteUnfinished(const std::string& file)
{
	const std::lock_guard<std::mutex> lock(writers);
	Place* place = first;
	while (place && place->taken)
		place = place->next;
	if (!place)
	{
		place = new Place;
		place->next = first;
		first = place;
	}
	place->file = file;
	place->taken = true;
}

void ForgetUnfinished(const std::string& file)
{
	const std::lock_guard<std::mutex> lock(writers);
	for (Place* place = first; place; place = place->next)
		if (place->taken && place->file == file)
		{
			place->taken = false;
			return;
		}
}

bool RemoveUnfinished(int signal)
{
	if (changing > 0)
	{
		late = signal;
		return false;
	}
	for (Place* place = first; place; place = place->next)
		if (place->taken)
			unlink(place->file.c_str());
	return true;
}

Uninterrupted::Uninterrupted()
{
	++changing;
	sigset_t all;
	sigemptyset(&all);
	for (const int signal : { SIGINT, SIGTERM, SIGHUP })
		sigaddset(&all, signal);
	pthread_sigmask(SIG_BLOCK, &all, &before);
}

Uninterrupted::~Uninterrupted()
{
	--changing;
	if (const int signal = late.exchange(0))
		raise(signal);   // when it is let through again
	pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}
