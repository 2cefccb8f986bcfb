// SPDX-License-Identifier: AGPL-3.0-or-later

#include "calibrate/in_order.h"

#include <opencv2/core.hpp>

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tiltcal
{

namespace
{

class Run
{
public:
	Run(size_t count, const std::function<void(size_t)>& work_, const std::function<void(size_t)>& tell_)
		: work(work_), tell(tell_), done(count, 0), errors(count), end(count), caller(std::this_thread::get_id()) {}

	void One(size_t k)
	{
		if (!IsNeeded(k))
			return;
		try
		{
			work(k);
		}
		catch (...)
		{
			Fail(k, std::current_exception());
		}
		{
			const std::lock_guard<std::mutex> lock(mutex);
			done[k] = 1;
		}
		if (std::this_thread::get_id() == caller)
			TellWhatIsReady();
	}

	void TellWhatIsReady()
	{
		for (; IsReady(told); ++told)
			try
			{
				tell(told);
			}
			catch (...)
			{
				Fail(told, std::current_exception());
			}
	}

	/// After all is done and told.
	void Throw() const
	{
		if (end < errors.size())
			std::rethrow_exception(errors[end]);
	}

private:
	bool IsNeeded(size_t k)
	{
		const std::lock_guard<std::mutex> lock(mutex);
		return k < end;
	}

	bool IsReady(size_t k)
	{
		const std::lock_guard<std::mutex> lock(mutex);
		return k < end && done[k];
	}

	void Fail(size_t k, std::exception_ptr error)
	{
		const std::lock_guard<std::mutex> lock(mutex);
		errors[k] = error;
		end = std::min(end, k);
	}

	const std::function<void(size_t)> &work, &tell;
	std::mutex mutex;
	std::vector<char> done;
	std::vector<std::exception_ptr> errors;
	size_t end;         // the first that failed
	size_t told = 0;
	const std::thread::id caller;
};

}

void InOrder(size_t count, int threads, const std::function<void(size_t)>& work, const std::function<void(size_t)>& tell)
{
	Run run(count, work, tell);
	// A round that would leave threads idle is worked on one by one, each by all threads.
	const size_t together = threads > 1 ? count / size_t(threads) * size_t(threads) : 0;
	if (together > 0)
		cv::parallel_for_(cv::Range(0, int(together)), [&](const cv::Range& range)
		{
			for (int k = range.start; k < range.end; ++k)
				run.One(size_t(k));
		}, double(together));
	run.TellWhatIsReady();
	for (size_t k = together; k < count; ++k)
		run.One(k);
	run.Throw();
}

}
