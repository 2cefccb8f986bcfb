// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Photographs on several threads: what is measured, and what is said, is what one thread measures and says.

#include "calibrate/in_order.h"
#include "calibrate/quiet.h"
#include "calibrate/use_threads.h"
#include <tiltcal/calibrate.h>
#include <tiltcal/error.h>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include <atomic>
#include <memory>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace
{

using namespace tiltcal;

/// Every number of the edges and corners, bit by bit.
std::vector<double> Numbers(const Task& task)
{
	std::vector<double> all;
	for (const State& state : task.states)
		for (const Photo& photo : state.photos)
		{
			for (const Corner& c : photo.corners)
				all.insert(all.end(), { c.x, c.y });
			for (const Edge& e : photo.edges)
			{
				all.insert(all.end(), { double(e.column), double(e.row), e.x, e.y, e.nx, e.ny, e.slope, e.blur, e.blur_sigma, e.offset_sigma, e.slope_sigma, e.low, e.high, e.noise, e.reach, e.span });
				for (const ProfileBin& bin : e.profile)
					all.insert(all.end(), { double(bin.x), double(bin.value), double(bin.count) });
			}
			for (const BrightPatch& p : photo.white)
				all.insert(all.end(), { p.u, p.v, p.value, p.sigma });
			all.insert(all.end(), { double(photo.edges_dropped), photo.saturated_share });
		}
	return all;
}

struct Measured
{
	std::vector<double> numbers;
	std::vector<std::string> said;
};

Measured MeasuredOn(int threads)
{
	Measured m;
	MeasureOptions options;
	options.threads = threads;
	options.edges_per_photo = 24;
	const std::thread::id caller = std::this_thread::get_id();
	options.log = Log([&](Severity, const std::string& text) { EXPECT_EQ(std::this_thread::get_id(), caller); m.said.push_back(text); });
	const std::string folder = BOXES_PHOTOS "/";
	m.numbers = Numbers(MeasureAll({ { "untilted", { folder + "untilted-1.jpg", folder + "untilted-2.jpg", folder + "untilted-3.jpg" } },
		{ "plus5", { folder + "plus5-1.jpg", folder + "plus5-2.jpg" } } }, ParseBoard("12x9", 25), 0.02, options));
	return m;
}

TEST(Threads, PhotographsAreMeasuredTheSameOnAnyNumber)
{
	const int before = cv::getNumThreads();
	const Measured one = MeasuredOn(1);
	// 5: all photographs together; 2 and 3: some of them after the others, on all threads.
	for (const int threads : { 2, 3, 5 })
	{
		const Measured more = MeasuredOn(threads);
		ASSERT_EQ(more.numbers.size(), one.numbers.size()) << threads;
		EXPECT_EQ(std::memcmp(more.numbers.data(), one.numbers.data(), one.numbers.size() * sizeof(double)), 0) << threads;
		EXPECT_EQ(more.said, one.said) << threads;
	}
	EXPECT_GT(one.numbers.size(), 2000u);
	EXPECT_EQ(cv::getNumThreads(), before);
}

TEST(Threads, TheFirstFailureIsTheOneThatIsTold)
{
	const std::string folder = BOXES_PHOTOS "/";
	for (const int threads : { 1, 4 })
	{
		MeasureOptions options;
		options.threads = threads;
		options.edges_per_photo = 12;
		std::vector<std::string> said;
		options.log = Log([&](Severity severity, const std::string& text) { if (severity == Severity::INFO) said.push_back(text); });
		try
		{
			MeasureAll({ { "untilted", { folder + "untilted-1.jpg", "nowhere-1.jpg", folder + "untilted-1.jpg", "nowhere-2.jpg" } } }, ParseBoard("12x9", 25), 0.02, options);
			FAIL() << "read what is not there";
		}
		catch (const Error& e)
		{
			EXPECT_NE(std::string(e.what()).find("nowhere-1.jpg"), std::string::npos) << e.what();
		}
		EXPECT_EQ(said.size(), 1u) << threads;
	}
	MeasureOptions options;
	options.threads = -1;
	EXPECT_THROW(MeasureAll({ { "untilted", { "a" } } }, ParseBoard("12x9", 25), 0.02, options), Error);
}

TEST(Threads, WorkIsToldInOrderByTheCaller)
{
	cv::setNumThreads(4);
	const std::thread::id caller = std::this_thread::get_id();
	for (const size_t count : { 0, 1, 3, 4, 103 })
	{
		std::vector<std::atomic<int>> worked(count);
		std::vector<size_t> told;
		InOrder(count, 4, [&](size_t k) { ++worked[k]; }, [&](size_t k)
		{
			EXPECT_EQ(std::this_thread::get_id(), caller);
			EXPECT_EQ(worked[k], 1);
			told.push_back(k);
		});
		std::vector<size_t> all(count);
		std::iota(all.begin(), all.end(), size_t(0));
		EXPECT_EQ(told, all);
	}
	// What is told may throw too; nothing after it is told.
	size_t last = 0;
	EXPECT_THROW(InOrder(100, 4, [](size_t k) { if (k == 60) throw std::logic_error("work"); },
		[&](size_t k) { last = k; if (k == 41) throw std::runtime_error("tell"); }), std::runtime_error);
	EXPECT_EQ(last, 41u);
	cv::setNumThreads(-1);
}

/// Two calls of a program's, the first of which ends first: the switches are as the program had them, and silent until the last ends.
TEST(Threads, CallsThatOverlapLeaveTheProgramsSwitches)
{
	namespace logging = cv::utils::logging;
	const logging::LogLevel level = logging::getLogLevel();
	logging::setLogLevel(logging::LOG_LEVEL_INFO);
	const int before = cv::getNumThreads();
	cv::setNumThreads(3);
	auto quiet = std::make_unique<QuietLibraries>();
	auto one = std::make_unique<UseThreads>(1);
	auto also_quiet = std::make_unique<QuietLibraries>();
	auto two = std::make_unique<UseThreads>(2);
	quiet.reset();
	one.reset();
	EXPECT_EQ(logging::getLogLevel(), logging::LOG_LEVEL_SILENT);
	EXPECT_EQ(cv::getNumThreads(), 2);
	also_quiet.reset();
	two.reset();
	EXPECT_EQ(logging::getLogLevel(), logging::LOG_LEVEL_INFO);
	EXPECT_EQ(cv::getNumThreads(), 3);
	EXPECT_THROW(UseThreads(-1), Error);
	logging::setLogLevel(level);
	cv::setNumThreads(before);
}

}
