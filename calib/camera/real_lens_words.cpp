// SPDX-License-Identifier: AGPL-3.0-or-later

#include "camera/real_lens_words.h"

#include "lens/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace tiltcal
{

namespace
{

using tilt_lens::AberrationTerms;
using tilt_lens::ThirdOrderTerms;

const double PER_MILLE = 1000;

}

tilt_lens::RealLens<double> RealLensOf(const CameraAberrations& a, double unit_mm)
{
	tilt_lens::RealLens<double> lens{ a.pupil_magnification, unit_mm / a.focal_length_mm, { {}, a.radius_mm / unit_mm }, a.etendue };
	for (size_t k = 0; k < a.mm.size(); ++k)
		lens.aberrations.c[k] = a.mm[k] / unit_mm;
	return lens;
}

int TermsOf(const tilt_lens::RealLens<double>& lens)
{
	const double* const c = lens.aberrations.c;
	return std::any_of(c + ThirdOrderTerms, c + AberrationTerms, [](double fifth) { return fifth != 0; }) ? AberrationTerms : ThirdOrderTerms;
}

std::string RealLensWords(const tilt_lens::RealLens<double>& lens, int terms)
{
	const double f = 1 / lens.power;
	std::string out = fmt::format("\t\tpupil_magnification {:.10g}\n\t\taberrations {{\n\t\t\tfocal_length {:.10g}  f_stop {:.10g}{}\n", lens.pupil_magnification, f,
		f / (2 * lens.aberrations.radius), lens.etendue ? fmt::format("  {}", tilt_lens::EtendueWord) : "");
	const auto per_mille = [&](int k) { return PER_MILLE * lens.aberrations.c[k] / f + 0.; };
	for (int k = 0; k < ThirdOrderTerms; ++k)
		out += fmt::format("\t\t\t{} {:.10g}\n", tilt_lens::AberrationWords[k], per_mille(k));
	if (terms > ThirdOrderTerms)
	{
		out += fmt::format("\t\t\t{} {{", tilt_lens::AberrationWords[ThirdOrderTerms]);
		for (int k = ThirdOrderTerms; k < AberrationTerms; ++k)
			out += fmt::format("{} {:.10g}", k > ThirdOrderTerms ? "," : "", per_mille(k));
		out += " }\n";
	}
	return out + "\t\t}\n";
}

}
