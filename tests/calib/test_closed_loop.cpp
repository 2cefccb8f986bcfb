// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What the closed loops count: nothing that is off passes as good, and what is not told does not count.

#include "closed_loop_page.h"
#include "base/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace cameras;

Result Of(const std::string& name, std::vector<Deviation> deviations)
{
	Result r;
	r.camera.name = name;
	r.light = "snr200";
	r.answer.deviations = std::move(deviations);
	return r;
}

Result RefusedOf(const std::string& name)
{
	Result r = Of(name, {});
	r.answer.refusal = "no board";
	return r;
}

TEST(ClosedLoop, AnErrorWithoutASigmaIsOutside)
{
	EXPECT_EQ(Deviation({ "k1", 0.00169, 0, 0 }).InSigmas(), -HUGE_VAL);
	EXPECT_EQ(Deviation({ "w", 48, 48.1, 0 }).InSigmas(), HUGE_VAL);
	EXPECT_EQ(Deviation({ "w", 48, 48, 0 }).InSigmas(), 0);
	EXPECT_EQ(Deviation({ "w", 48, 48.1, 0.1 }).InSigmas(), (48.1 - 48) / 0.1);
	// What is no number promises nothing that could be kept; an infinite sigma would hold everything.
	for (const Deviation& d : { Deviation{ "w", 48, NAN, 1 }, Deviation{ "w", 48, 48, NAN }, Deviation{ "w", 48, 48, HUGE_VAL }, Deviation{ "w", 48, HUGE_VAL, HUGE_VAL } })
		EXPECT_TRUE(std::isinf(d.InSigmas()));
	const Coverage c = CoverageOfAll({ Of("a", { { "w", 48, 48.1, 0 }, { "f", 45, 45, 1 } }) });
	EXPECT_EQ(c.inside, 1);
	EXPECT_EQ(c.all, 2);
	EXPECT_TRUE(std::isinf(c.worst));
	EXPECT_EQ(c.mean, 5) << "10 and 0";
}

TEST(ClosedLoop, WhatIsNotToldDoesNotCount)
{
	Result r = Of("a", { { "f", 45, 45, 1 } });
	r.answer.not_told = { "k1: not significant" };
	const Coverage c = CoverageOfAll({ r });
	EXPECT_EQ(c.inside, 1);
	EXPECT_EQ(c.all, 1);
	EXPECT_EQ(c.not_told, 1);
}

TEST(ClosedLoop, ARefusalIsExpectedByNameOrFailsTheRun)
{
	const std::vector<Result> results = { Of("random 1", { { "f", 45, 45, 1 } }), RefusedOf("random 3"), RefusedOf("random 30") };
	EXPECT_EQ(RefusalsOf(results, {}).unexpected.size(), 2u);
	const Refusals one = RefusalsOf(results, { "random 3," });
	EXPECT_EQ(one.all.size(), 2u);
	ASSERT_EQ(one.unexpected.size(), 1u);
	EXPECT_EQ(one.unexpected[0]->camera.name, "random 30");
	EXPECT_TRUE(RefusalsOf(results, { "random 3, snr200", "random 30" }).unexpected.empty());
	const std::string page = testing::TempDir() + "closed-loop.md";
	WritePage(page, "closed_loop", results, { "random 3," });
	EXPECT_THAT(tiltcal::ReadText(page, "page"), testing::HasSubstr("Without an answer: 2 of 3 sets, 1 of them unexpected, which fails the run. **random 30, snr200**."));
}

TEST(ClosedLoop, FewerThanTheLeastAreOnceInAThousand)
{
	// Tables of the binomial distribution: P(X <= 12 | 20, 0.9) = 0.0004, P(X <= 13) = 0.0024; P(X <= 1 | 3, 0.5) = 0.5, P(X = 0) = 0.125.
	EXPECT_EQ(LeastInside(20, 0.9), 13);
	EXPECT_EQ(LeastInside(3, 0.5), 0);
	EXPECT_EQ(LeastInside(20, 1), 20);
	EXPECT_EQ(LeastInside(20, 0), 0);
}

}
