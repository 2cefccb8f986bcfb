// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Parts of the edges that a fit is made again of.

#include "solve/each_edge.h"
#include "solve/half_of_edges.h"

#include <gtest/gtest.h>

using namespace tiltcal;

namespace
{

/// Two photographs whose edges lie farther and farther from the middle, the nearer ones more blurred; and one without edges.
Task ThreePhotographs()
{
	Task task;
	task.width = 101;
	task.height = 81;
	task.states.resize(1);
	task.states[0].photos.resize(3);
	for (const size_t photo : { 0u, 2u })
		for (int k = 0; k < 7; ++k)
		{
			Edge e;
			e.x = 50 + 5 * k + double(photo);
			e.y = 40;
			e.blur = (k % 2 ? -1 : 1) * (10 - k);
			task.states[0].photos[photo].edges.push_back(e);
		}
	return task;
}

}

TEST(HalvesOfEdges, PartEachPhotographInTwoAndTwo)
{
	const Task task = ThreePhotographs();
	std::vector<double> blurs;
	ForEachEdge(task, [&](size_t, size_t, const Edge& e) { blurs.push_back(e.blur); });
	const std::vector<EdgeSubset> halves = FourHalvesOfEdges(task, blurs);
	ASSERT_EQ(halves.size(), 4u);
	for (const size_t two : { 0u, 2u })
		for (size_t k = 0; k < 14; ++k)
			EXPECT_NE(halves[two][k], halves[two + 1][k]) << "an edge is in one of the two";
	// The one in the middle is among the nearer and among the sharper ones. Nearer ones are the more blurred ones here, whatever the sign of the blur.
	const size_t sizes[] = { 4, 3, 4, 3 };
	for (size_t h = 0; h < 4; ++h)
	{
		const Task part = WithEdges(task, halves[h]);
		EXPECT_EQ(part.states[0].photos[0].edges.size(), sizes[h]);
		EXPECT_TRUE(part.states[0].photos[1].edges.empty());
		EXPECT_EQ(part.states[0].photos[2].edges.size(), sizes[h]);
	}
	for (size_t k = 0; k < 14; ++k)
		EXPECT_LE(halves[3][k], halves[0][k]) << "blurred edges are near ones";
	const Task middle = WithEdges(task, halves[0]);
	for (const Edge& e : middle.states[0].photos[2].edges)
		EXPECT_LE(e.x, 67);
}
