// SPDX-License-Identifier: AGPL-3.0-or-later

#include "cli/calibrate_run.h"

#include "model/priors.h"
#include "model/state_names.h"
#include "model/told_state.h"
#include "program/program.h"
#include "program/spelling.h"
#include "calibrate/measure_all.h"
#include "model/names.h"
#include "picture/image_io.h"

#include <tiltcal/error.h>
#include "calibrate/exif_check.h"
#include "base/files.h"
#include "base/numbers.h"
#include "base/plain_text.h"
#include "effects/effects.h"
#include "effects/fixed_blades.h"
#include "report/write_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <ctime>
#include <utility>

namespace tiltcal
{

namespace
{

const int MOST_THREADS = 1024;

const char* const UNTILTED = "untilted";

/// --square VALUE or VALUE:SIGMA, mm.
Estimate ParseSquare(const std::string& text)
{
	const size_t colon = text.find(':');
	const std::optional<double> value = FiniteNumber(text.substr(0, colon)), sigma = colon == std::string::npos ? std::optional<double>(0) : FiniteNumber(text.substr(colon + 1));
	if (!value || !(*value > 0) || !sigma || *sigma < 0)
		throw UsageError(fmt::format("--square {}: give VALUE or VALUE:SIGMA in mm, above 0, such as 25 or 25:0.02", text));
	return { *value, *sigma };
}

/// Adds the photographs of --tilted and --state: beside those of the same name.
void AddPatterns(const std::string& option, const std::string& text, std::vector<StatePatterns>& states)
{
	const ToldPhotographs told = ParseToldPhotographs(text, option);
	const std::string& given = told.state.name;
	StatePatterns own{ WithUnderscores(given), fmt::format("{} {}", option, text.substr(0, text.size() - told.pattern.size() - 1)), { told.pattern }, told.state.f_number };
	if (own.name != given)
		spdlog::info("state {} is called {}, as POV-Ray's identifiers must be", OneLine(given), own.name);
	auto after = states.end();
	for (auto at = states.begin(); at != states.end(); ++at)
		if (at->name == own.name)
		{
			if (at->f_number && own.f_number && IsSameFNumber(*at->f_number, *own.f_number))
			{
				at->patterns.push_back(told.pattern);
				return;
			}
			if (!at->f_number && !own.f_number)
				throw UsageError(fmt::format("{} {}: the state's NAME '{}' is already taken; give every state its own", option, text, own.name));
			after = at + 1;
		}
	// The untilted state stands first wherever it is told.
	states.insert(after == states.end() && own.name == UNTILTED ? states.begin() : after, own);
	try
	{
		CheckStateNames(NamesOf(states));
	}
	catch (const Error& e)
	{
		throw UsageError(fmt::format("{} {}: {}", option, text, e.what()));
	}
}

std::vector<StatePatterns> Patterns(const CalibrateWords& o)
{
	std::vector<StatePatterns> states;
	if (!o.untilted.empty())
		states.push_back({ UNTILTED, "--untilted", o.untilted });
	for (const std::string& text : o.tilted)
		AddPatterns("--tilted", text, states);
	for (const std::string& text : o.state)
		AddPatterns("--state", text, states);
	if (states.empty() || states[0].name != UNTILTED)
		throw UsageError("--untilted is required (or --state untilted:f_number=N='GLOB')");
	return states;
}

/// --flat-field NAME=FILE, FILE a name or a pattern.
std::vector<FieldPattern> FlatFields(const CalibrateWords& o, const std::vector<StatePatterns>& states)
{
	std::vector<FieldPattern> fields;
	const std::vector<std::string> all = NamesOf(states);
	for (const std::string& option : o.flat_field)
	{
		const size_t equals = option.find('=');
		const std::string name = WithUnderscores(option.substr(0, equals));
		std::string names;
		size_t state = all.size();
		for (size_t s = 0; s < all.size(); ++s)
		{
			names += (s ? ", " : "") + all[s];
			state = all[s] == name ? s : state;
		}
		if (equals == std::string::npos || state == all.size())
			throw UsageError(fmt::format("--flat-field {}: give NAME=FILE, NAME one of the states {}", option, names));
		fields.push_back({ state, "--flat-field " + name, option.substr(equals + 1) });
	}
	return fields;
}

std::vector<std::string> AllFiles(const std::vector<StateFiles>& states)
{
	std::vector<std::string> files;
	for (const StateFiles& s : states)
		files.insert(files.end(), s.files.begin(), s.files.end());
	return files;
}

/// None: to be chosen.
std::optional<Model> ParseModel(const std::string& text)
{
	const std::optional<Model> model = ModelNamed(text);
	std::string all;
	for (const ModelWords& words : MODELS)
		all += fmt::format("{}{} ({})", &words == &MODELS.back() ? " and " : ", ", words.name, words.meaning);
	if (!model && text != "auto")
		throw UsageError(fmt::format("--model {}: there is auto{}", text, all));
	return model;
}

Poses ParsePoses(const std::string& text)
{
	if (text == "auto")
		return Poses::AUTO;
	if (text == "shared")
		return Poses::SHARED;
	if (text == "own")
		return Poses::OWN;
	throw UsageError(fmt::format("--poses {}: give auto, shared or own", text));
}

Refinement ParseRefinement(const std::string& text)
{
	if (text == "none")
		return Refinement::NONE;
	if (text == "edges")
		return Refinement::EDGES;
	if (text == "photometric")
		return Refinement::PHOTOMETRIC;
	throw UsageError(fmt::format("--refine {}: give none, edges or photometric", text));
}

/// A wrong --fix makes the photographs contradict themselves, which reads like a lack of photographs.
Calibration CalibrateWithPriors(const Task& task, bool priors_from_exif_alone, const CalibrateOptions& options)
{
	try
	{
		return Calibrate(task, options);
	}
	catch (const Error& e)
	{
		if (e.Code() != EXIT_REFUSED || task.priors.empty())
			throw;
		// Before the lines of what the photographs lack.
		const std::string text = e.what();
		const size_t end = std::min(text.find('\n'), text.size());
		throw Refused(fmt::format("{}; or what {} is wrong: {}{}", text.substr(0, end), priors_from_exif_alone ? "the photographs' EXIF, or the f_number told with them, says of the lens" : "--fix or --prior says",
			priors_from_exif_alone ? "give --prior focal_length=.. and --prior f_number=.. yourself" : "try without", text.substr(end)));
	}
}

Known WhatIsKnown(const CalibrateWords& o)
{
	Known known;
	for (const std::string& text : o.fix)
		if (!TakeBlades(text, known.blades))
			known.priors.push_back(ParseFix(text));
	CheckBlades(known.blades);
	for (const std::string& text : o.prior)
		known.priors.push_back(ParsePrior(text));
	// Two would be averaged, without a word.
	for (size_t i = 0; i < known.priors.size(); ++i)
		for (size_t j = 0; j < i; ++j)
			if (known.priors[i].quantity == known.priors[j].quantity)
				throw UsageError(fmt::format("--fix and --prior: {0} is given as {1:g} and as {2:g}; give it once", known.priors[i].Name(), known.priors[j].value, known.priors[i].value));
	return known;
}

/// What the texts of a calibration call inputs, people know as options.
void SpellAsOptions(Calibration& c)
{
	const auto spell = [](std::string& text) { text = SpelledAsOptions(text); };
	for (Solution* s : { &c.solution, &c.render, &c.paper })
		spell(s->failure);
	if (c.compared)
		for (Solution* s : { &c.compared->rigid, &c.compared->plane, &c.compared->curved })
			spell(s->failure);
	spell(c.vignetting.failure);
	for (FalloffAnswer& answer : c.vignetting.answers)
		spell(answer.second.why);
	spell(c.chromatic.failure);
	for (Effect& e : c.effects)
		for (std::string* text : { &e.failure, &e.why, &e.note })
			spell(*text);
	for (Remark& remark : c.verdict.remarks)
		spell(remark.text);
}

}

std::vector<std::string> NamesOf(const std::vector<StatePatterns>& states)
{
	std::vector<std::string> names;
	for (const StatePatterns& state : states)
		if (names.empty() || names.back() != state.name)
			names.push_back(state.name);
	return names;
}

PackedPicture Pack(const cv::Mat& grey)
{
	PackedPicture packed;
	cv::imencode(".png", ToDisplay(grey), packed, { cv::IMWRITE_PNG_COMPRESSION, 1 });
	return packed;
}

std::string TimeOfDay() { return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::time(nullptr))); }

CalibrateRun::CalibrateRun(const CalibrateWords& o, const std::string& line) : words(o), command_line(line)
{
	const Estimate square = ParseSquare(o.square);
	board = MakeBoard(ParseTargetKind(o.target, "--target"), o.board, square.value, o.circle_diameter, "--target");
	board.square_sigma_mm = square.sigma;
	measure.transfer = ParseTransfer(o.transfer);
	measure.any_orientation = o.any_orientation;
	measure.edges_per_photo = o.edges_per_photo;
	measure.threads = options.threads = o.threads;
	options.model = ParseModel(o.model);
	options.scene_lens = o.edges_per_photo == 0;
	options.next_photographs = true;
	options.poses = ParsePoses(o.poses);
	options.refinement = ParseRefinement(o.refine);
	options.effects = ParseEffects(o.effects);
	measure.log = options.log = ProgramLog();
	if (o.pitch)
		CheckPitch(*o.pitch);
	if (o.threads < 0 || o.threads > MOST_THREADS)
		throw UsageError(fmt::format("--threads {}: give 0 for all processors, or 1 to {}", o.threads, MOST_THREADS));
	CheckEdgesPerPhoto(o.edges_per_photo);
	states = Patterns(o);
	known = WhatIsKnown(o);
	fields = FlatFields(o, states);
}

double CalibrateRun::Pitch(const std::vector<StateFiles>& files) const { return words.pitch ? *words.pitch : PitchFromExif(AllFiles(files), options.log); }

Calibration CalibrateRun::Solve(Task task, double expected_seconds) const
{
	task.priors = known.priors;
	task.blades = known.blades;
	task.untilted_free = words.untilted_free;
	for (const FieldPattern& field : fields)
		for (const std::string& file : ExpandGlobs({ field.pattern }, field.option))
			AddFlatField(task, field.state, file, measure);
	task.pitch_from_exif = !words.pitch;
	const std::optional<NominalFNumber> nominal = FNumberOfReference(task);
	for (const Prior& prior : PriorsFromExif(task, known.priors))
	{
		const bool told = prior.quantity == Quantity::F_NUMBER && nominal && nominal->told;
		spdlog::info("{} {:g}, {}: taken as known to 10 %", prior.Name(), prior.value, told ? "as told" : "as EXIF says");
		task.priors.push_back(prior);
	}
	Progress progress("solving", 0, expected_seconds);
	CalibrateOptions telling = options;
	telling.log = Log([&](Severity severity, const std::string& message)
	{
		if (severity == Severity::WARNING)
			return options.log.Warn(message);
		options.log.Info(message);
		progress.Say(message);
	});
	Calibration c = CalibrateWithPriors(task, known.priors.empty(), telling);
	SpellAsOptions(c);
	if (!c.IsJudged())   // else the verdict says it
		for (const std::string& text : CompareWithExif(c))
			options.log.Warn(text);
	return c;
}

void CalibrateRun::Write(const Calibration& c, const std::vector<std::vector<const PackedPicture*>>& packed, const WatchNotes& watch) const
{
	const RunNotes notes{ words.refine, command_line, TimeOfDay(), watch };
	WriteEverything(c, notes, [&](size_t s, size_t p) { return cv::imdecode(*packed[s][p], cv::IMREAD_GRAYSCALE); }, words.out);
}

void RefuseUnlessConverged(const Calibration& calibration)
{
	if (!calibration.refined)
		throw Refused("the joint refinement did not converge: what is written are geometry and blur as solved one after the other");
}

}
