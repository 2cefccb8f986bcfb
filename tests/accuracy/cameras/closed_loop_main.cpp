// SPDX-License-Identifier: AGPL-3.0-or-later
//
// closed_loop: cameras that nobody tuned for, light as cameras give it, and the calibrator's answers in their own sigmas.

#include "closed_loop_page.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <stdexcept>

namespace
{

using namespace cameras;

struct Options
{
	std::vector<std::string> only, lights{ "snr200" };
	std::vector<std::string> refused;
	int seeds = 1, poses = 1, random = 0, first = 0;
	std::string work = "closed-loop", out, glass;
	double focal_length = 0, f_number = 0, stopped_to = 0, fill = 0;
	bool table = false;
	double hold = 0, most = HUGE_VAL, megapixels = 0;
	int least = 1;
	std::vector<double> within, rims;

	std::string Command() const
	{
		std::string words = "closed_loop";
		if (table)
			words += " --table";
		for (const std::string& name : only)
			words += " --only '" + name + "'";
		if (random > 0)
			words += fmt::format(" --random {} --first {}", random, first);
		if (!glass.empty())
			words += " --glass " + glass;
		if (focal_length > 0)
			words += fmt::format(" --focal-length {:g}", focal_length);
		if (f_number > 0)
			words += fmt::format(" --f-number {:g}", f_number);
		if (stopped_to > 0)
			words += fmt::format(" --stopped-to {:g}", stopped_to);
		if (fill > 0)
			words += fmt::format(" --fill {:g}", fill);
		for (size_t k = 0; k < rims.size(); k += 2)
			words += fmt::format(" --rim {:g} {:g}", rims[k], rims[k + 1]);
		if (megapixels > 0)
			words += fmt::format(" --megapixels {:g}", megapixels);
		if (poses > 1)
			words += fmt::format(" --poses {}", poses);
		for (const std::string& light : lights)
			words += " --light " + light;
		for (const std::string& name : refused)
			words += " --refused '" + name + "'";
		return seeds == 1 ? words : words + fmt::format(" --seeds {}", seeds);
	}
};

void Print(const Camera& camera, const std::string& light, const Answer& a)
{
	std::printf("%-32s %-12s ", camera.name.c_str(), light.c_str());
	if (!a.refusal.empty())
	{
		std::printf("%s: %s\n", a.photographed ? "refused" : "not photographed", a.refusal.c_str());
		return;
	}
	const auto& c = a.calibration;
	std::printf("%s, %s, tilt error %.4f, reprojection %.3f px, blur %.3f px, %d terms%s\n", tiltcal::NameOf(c.verdict.grade), tiltcal::NameOf(c.Answer()), a.tilt_error, c.geometry.rms, c.solution.rms_blur,
		c.geometry.distortion_terms, c.geometry.shared_poses ? ", shared" : "");
	for (const Deviation& d : a.deviations)
		std::printf("    %-20s %12.5f  %12.5f +- %9.5f  %+6.2f\n", d.name.c_str(), d.truth, d.found, d.sigma, d.InSigmas());
	for (const std::string& name : a.not_told)
		std::printf("    not told: %s\n", name.c_str());
	for (const auto& remark : c.verdict.remarks)
		std::printf("    %s: %s\n", tiltcal::NameOf(remark.grade), remark.text.c_str());
}

void Keep(const Options& o, Result result, std::vector<Result>& results)
{
	Print(result.camera, result.light, result.answer);
	std::fflush(stdout);
	result.answer.calibration.task = {};   // all its edges: too many for hundreds of sets
	results.push_back(std::move(result));
	if (!o.out.empty())
		WritePage(o.out, o.Command(), results, o.refused); // whole after every camera: this takes long
}

/// `noise_seed`: of the first draw.
void Run(const Options& o, Camera camera, unsigned pose_seed, unsigned noise_seed, std::vector<Result>& results)
{
	camera.glass = o.glass;
	if (o.focal_length > 0)
		camera.focal_length = o.focal_length;
	if (o.f_number > 0)
		camera.f_number = o.f_number;
	camera.stopped_to = o.stopped_to;
	if (o.fill > 0)
		camera.fill = o.fill;
	for (size_t k = 0; k < o.rims.size(); k += 2)
		camera.rims.push_back({ o.rims[k], o.rims[k + 1] });
	Negatives negatives;
	try
	{
		negatives = Photograph(camera, pose_seed);
	}
	catch (const std::exception& e)
	{
		Answer none;
		none.refusal = e.what();
		none.photographed = false;
		for (const std::string& name : o.lights)
			Keep(o, { camera, name, none }, results);
		return;
	}
	for (const std::string& name : o.lights)
		for (int k = 0; k < o.seeds; ++k)
		{
			const Light light = LightOf(name);
			Answer a = CloseTheLoop(negatives, light, noise_seed + unsigned(k), o.work);
			Keep(o, { negatives.camera, name, std::move(a) }, results);
		}
}

}

int main(int argc, char** argv)
try
{
	Options o;
	CLI::App app{ "Simulated cameras, calibrated and held against the truth" };
	app.add_flag("--table", o.table, "All cameras of the table; taken where nothing else is asked for");
	app.add_option("--only", o.only, "Cameras of the table whose names begin so");
	app.add_option("--light", o.lights, "Kinds of light");
	app.add_option("--seeds", o.seeds, "Draws of the noise");
	app.add_option("--poses", o.poses, "So many sets of poses of every camera of the table, each with a noise of its own");
	app.add_option("--megapixels", o.megapixels, "Of all cameras, at most, and fewer points of the lens: the same sensors in larger pixels, so that many can be tried");
	app.add_option("--random", o.random, "So many random cameras too");
	app.add_option("--first", o.first, "The first of them");
	app.add_option("--glass", o.glass, "FILE of a lens prescription: the photographs are traced through it");
	app.add_option("--focal-length", o.focal_length, "Of all cameras, mm, in place of their own");
	app.add_option("--f-number", o.f_number, "Of all cameras, in place of their own");
	app.add_option("--stopped-to", o.stopped_to, "Every board is photographed at this f-number too, and both sets are calibrated together");
	app.add_option("--fill", o.fill, "How much of the picture a board fills at the plane of focus (0.85: most are in the picture only beyond it; 0.5: boards reach through it)")->check(CLI::Range(0.1, 1.0));
	app.add_option("--rim", o.rims, "RADIUS DISTANCE: a rim of the thin lenses, in radii of the opening and focal lengths before the lens (behind it: negative)")->type_size(2)->excludes("--glass");
	app.add_option("--work", o.work, "Folder for the photographs");
	app.add_option("--out", o.out, "Page with the results, Markdown");
	app.add_option("--hold", o.hold, "Exit code 1 when fewer numbers are inside 2 sigma than a true share of so much leaves once in a thousand by chance")->check(CLI::Range(0.0, 1.0));
	app.add_option("--most", o.most, "Exit code 1 when a number is further off, in sigmas");
	app.add_option("--least", o.least, "Exit code 1 when fewer numbers than this are held against the truth")->capture_default_str();
	app.add_option("--refused", o.refused, "A set that is expected to be refused, or not to be photographed: what its camera and light begin with ('45 mm at infinity', 'random 3, snr20'). Any other without an answer: exit code 1");
	app.add_option("--within", o.within, "LEAST MOST: exit code 1 when the true share of all numbers inside 2 sigma, with 95 %, lies wholly outside of these, or that of one kind wholly below LEAST")->expected(2)->check(CLI::Range(0.0, 1.0));
	CLI11_PARSE(app, argc, argv);
	if (const auto folder = std::filesystem::path(o.out).parent_path(); !folder.empty())
		std::filesystem::create_directories(folder);
	std::vector<Result> results;
	const bool nothing_asked = o.only.empty() && o.random == 0;
	const auto quick = [&](const Camera& camera) { return o.megapixels > 0 ? Quick(camera, o.megapixels) : camera; };
	// One copy: each call makes a table of its own.
	const std::vector<Camera> table = AllCameras();
	for (const std::string& name : o.only)
		if (std::none_of(table.begin(), table.end(), [&](const Camera& camera) { return camera.name.rfind(name, 0) == 0; }))
			throw std::runtime_error("--only " + name + ": no camera's name begins so");
	// Poses outside, so that what is done of a run that was stopped is of all cameras.
	for (int k = 0; k < o.poses; ++k)
		for (const Camera& camera : table)
			if (o.table || nothing_asked || std::any_of(o.only.begin(), o.only.end(), [&](const std::string& n) { return camera.name.rfind(n, 0) == 0; }))
				Run(o, quick(camera), unsigned(k + 1), unsigned(k + 1), results);
	for (int k = 0; k < o.random; ++k)
		Run(o, quick(RandomCamera(unsigned(o.first + k))), unsigned(o.first + k), 1, results);
	for (const auto& [name, t] : CoverageByKind(results))
		std::printf("%-16s inside 2 sigma %4d of %4d, %.1f to %.1f %%, rms %.2f, mean %+.2f\n", name.c_str(), t.inside, t.all, 100 * t.Where().low, 100 * t.Where().high, t.rms, t.mean);
	const Coverage all = CoverageOfAll(results);
	std::printf("%-16s inside 2 sigma %4d of %4d, %.1f %%, %.1f to %.1f %%, the worst %.1f sigma\n", "all", all.inside, all.all, 100 * all.Share(), 100 * all.Where().low, 100 * all.Where().high, all.worst);
	if (all.all < o.least)
		std::printf("%-16s at least %d numbers are wanted\n", "", o.least);
	const int least = LeastInside(all.all, o.hold);
	if (o.hold > 0)
		std::printf("%-16s at least %d: of a true share of %g, fewer once in a thousand\n", "", least, o.hold);
	const Refusals refusals = RefusalsOf(results, o.refused);
	for (const Result* r : refusals.unexpected)
		std::printf("without an answer, which was not expected: %s\n", NameOf(*r).c_str());
	const MadeUpRims rims = CountMadeUpRims(results);
	std::printf("rims were given to %d of %d cameras that have none%s\n", rims.with, rims.sets, rims.AreTooMany() ? ": too many" : "");
	bool off = !o.within.empty() && all.Where().IsOutside(o.within[0], o.within[1]);
	// One kind must not hide behind the others. Too many inside is no fault of a kind: f's sigma holds pupils that these cameras do not have.
	for (const auto& [name, t] : CoverageByKind(results))
		if (!o.within.empty() && t.Where().high < o.within[0])
		{
			std::printf("%-16s fewer than %g are inside, surely\n", name.c_str(), o.within[0]);
			off = true;
		}
	return all.all >= std::max(1, o.least) && all.inside >= least && all.worst <= o.most && !off && !rims.AreTooMany() && refusals.unexpected.empty() ? 0 : 1;
}
catch (const std::exception& e)
{
	std::fprintf(stderr, "closed_loop: %s\n", e.what());
	return 2;
}
