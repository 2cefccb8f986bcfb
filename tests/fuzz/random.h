// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Random choices that are the same on every machine, which the distributions of <random> are not.
#pragma once
#include <cstddef>
#include <cstdint>

// splitmix64 (Steele, Lea, Flood 2014)
class Random
{
	public:
		Random(std::uint64_t seed, std::uint64_t index) : state(seed) { state = Bits() + index; }

		std::uint64_t Bits()
		{
			std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
			z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
			z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
			return z ^ (z >> 31);
		}
		int Below(int n) { return int(Bits() % std::uint64_t(n)); }
		double Uniform(double low, double high) { return low + (high - low) * double(Bits() >> 11) * 0x1p-53; }
		bool Chance(double p) { return Uniform(0.0, 1.0) < p; }
		template<std::size_t N> const char* Pick(const char* const (&words)[N]) { return words[Below(int(N))]; }

	private:
		std::uint64_t state;
};
