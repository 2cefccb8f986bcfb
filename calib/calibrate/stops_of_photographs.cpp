// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/stops_of_photographs.h"

#include "model/told_state.h"
#include <tiltcal/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace tiltcal
{

namespace
{

template<typename Each>
void ForEachPhoto(Task& task, Each each)
{
	for (State& state : task.states)
		for (Photo& photo : state.photos)
			each(state, photo);
}

bool AnyTold(Task& task)
{
	bool any = false;
	ForEachPhoto(task, [&](const State&, const Photo& photo) { any |= photo.f_number.has_value(); });
	return any;
}

/// Of every photograph in turn; empty where EXIF alone was to say them and does not of all.
std::vector<double> FNumbers(Task& task)
{
	const bool told = AnyTold(task);
	bool all = true;
	std::vector<double> numbers;
	ForEachPhoto(task, [&](const State& state, const Photo& photo)
	{
		const std::optional<double> number = photo.f_number ? photo.f_number : photo.facts.f_number;
		const bool known = number && *number > 0;
		if (!known && told)
			throw UsageError(fmt::format("{}: is of state {} at an f-number that was not told, and EXIF (FNumber) says none, while other photographs were told theirs: give `state` {}:f_number=N='{}'",
				photo.file, state.name, state.name, photo.file));
		all &= known;
		numbers.push_back(known ? *number : 0);
	});
	return all ? numbers : std::vector<double>();
}

/// Of numbers that are one opening the least.
std::vector<Stop> StopsOf(std::vector<double> numbers)
{
	std::sort(numbers.begin(), numbers.end());
	std::vector<Stop> stops;
	for (const double number : numbers)
		if (stops.empty() || !IsSameFNumber(stops.back().f_number, number))
			stops.push_back({ number });
	return stops;
}

void Tell(Task& task, const Log& log)
{
	std::vector<size_t> count(task.stops.size(), 0);
	ForEachPhoto(task, [&](const State&, const Photo& photo) { ++count[photo.stop]; });
	std::string list;
	for (size_t k = 0; k < count.size(); ++k)
		list += fmt::format("{}{} at f/{:g}{}", k ? ", " : "", count[k], task.stops[k].f_number, k ? "" : " (the reference)");
	log.Info(fmt::format("photographs at {} stops: {}; how wide each opens is found, its f-number is taken as known to {:.0f} %", count.size(), list, 100 * STOP_SIGMA));
}

}

void SetStops(Task& task, const Log& log)
{
	const std::vector<double> numbers = FNumbers(task);
	const std::vector<Stop> stops = StopsOf(numbers);
	if (stops.size() < 2)
	{
		if (AnyTold(task))
			log.Info(fmt::format("all photographs are of f/{:g}: there are no stops to tell apart, and the aperture is found from the blur alone; `prior` f_number={:g}:0.1 says what is known of it", stops[0].f_number, stops[0].f_number));
		return;
	}
	task.stops = stops;
	size_t n = 0;
	ForEachPhoto(task, [&](const State&, Photo& photo)
	{
		const double number = numbers[n++];
		photo.stop = size_t(std::find_if(stops.begin(), stops.end(), [&](const Stop& s) { return IsSameFNumber(s.f_number, number); }) - stops.begin());
	});
	Tell(task, log);
}

void CheckStops(const Task& task)
{
	for (const Stop& stop : task.stops)
		if (!(stop.f_number > 0) || !(stop.log_sigma > 0) || stop.f_number < task.stops[0].f_number)
			throw UsageError(fmt::format("the task's stop f/{:g}: f-numbers and sigmas are above 0, the least f-number stands first", stop.f_number));
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
			if (photo.stop >= std::max<size_t>(task.stops.size(), 1))
				throw UsageError(fmt::format("{}: is of stop {}, the task has {}, counted from 0", photo.file, photo.stop, task.stops.size()));
}

}
