// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Axial chromatic aberration from how much wider edges are in red and blue.

#include <tiltcal/calibrate.h>
#include "edge/soft_radius.h"
#include "effects/chromatic_fit.h"
#include "effects/effects.h"
#include "effects/vignetting.h"
#include "support/synthetic_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace
{

using namespace tiltcal;
using synthetic::Lens;

double Off(const Estimate& e, double truth) { return std::abs(e.value - truth) / e.sigma; }

// The other colours' lenses have other focal lengths, 1/f larger by so much: what each blurs an edge to is traced without our code (support/synthetic_lens).
TEST(Chromatic, AxialIsWhatOtherFocalLengthsWiden)
{
	const double axial[] = { 2e-6, -1.5e-6 }, noise = 0.003;   // of 0.08 px at most, by which even nearly sharp edges change about evenly
	const auto of_colour = [](double by)
	{
		std::vector<State> states;
		for (const double tilt : { 0.0, 5.0 })
		{
			Lens lens = synthetic::Tilted(tilt, 30);
			lens.f = 1 / (1 / lens.f + by);
			states.push_back(synthetic::Photograph(tilt ? "tilted" : "untilted", lens, {}, 4));
		}
		return synthetic::MakeTask(states);
	};
	const Calibration exact = Calibrate(of_colour(0), { Model::PLANE, Poses::SHARED });
	const Task others[] = { of_colour(axial[0]), of_colour(axial[1]) };
	double squares = 0;
	for (unsigned seed = 1; seed <= 5; ++seed)
	{
		Calibration c = exact;
		std::mt19937 random(seed);
		std::normal_distribution<double> normal(0, noise);
		for (size_t s = 0; s < c.task.states.size(); ++s)
			for (size_t p = 0; p < c.task.states[s].photos.size(); ++p)
			{
				Photo& photo = c.task.states[s].photos[p];
				photo.coloured = true;
				for (size_t k = 0; k < photo.edges.size(); k += 3)
				{
					ColourEdge e;
					e.green = photo.edges[k];
					for (size_t i = 0; i < 2; ++i)
					{
						e.shift[i] = normal(random);
						e.widening[i] = SoftDiameter(others[i].states[s].photos[p].edges[k].blur) - SoftDiameter(e.green.blur) + normal(random);
						e.shift_sigma[i] = e.widening_sigma[i] = noise;
					}
					photo.colours.push_back(e);
				}
			}
		const Chromatic found = EstimateChromatic(c);
		for (size_t i = 0; i < 2; ++i)
		{
			EXPECT_LT(Off(found.axial_per_mm[i], axial[i]), 3.9) << seed << ": " << found.axial_per_mm[i].value << " +- " << found.axial_per_mm[i].sigma;
			squares += std::pow(Off(found.axial_per_mm[i], axial[i]), 2);
		}
		EXPECT_LT(found.axial_per_mm[0].sigma, 0.1 * axial[0]);
		c.chromatic = found;
		c.vignetting = EstimateVignetting(c);
		ChooseEffects(ParseEffects("auto"), c);
		EXPECT_TRUE(Uses(c, EffectId::CHROMATIC_AXIAL)) << EffectsText(c);
	}
	// Of ten numbers in their sigmas, chi-squared: beyond each of these once in a thousand.
	EXPECT_LT(squares, 29.6);
	EXPECT_GT(squares, 1.48);
}

}
