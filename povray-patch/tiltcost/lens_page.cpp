// SPDX-License-Identifier: AGPL-3.0-or-later

#include "tiltcost/lens_page.h"

#include <tiltcal/error.h>
#include "base/files.h"
#include "lens/lens_text.h"
#include "lens/pilot.h"
#include "plane_page/plane_page.h"
#include "tiltcost/progress.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace tiltcost
{

namespace
{

/// The line that POV-Ray writes when the picture begins; nothing before.
std::string WholeLine(const std::string& file)
{
	const std::string text = Contents(file);
	return !text.empty() && text.back() == '\n' ? text : "";
}

/// The scene is parsed as for a pilot, which writes nothing of the user's, and ended when its picture begins.
std::string ParsedLens(const Job& job, const tiltcal::TemporaryFolder& folder)
{
	const std::string file = folder.File("lens"), log = folder.File("log");
	std::vector<std::string> environment = {fmt::format("{}=1,2,1,{}", tilt_lens::PilotVariable, folder.File("pilot")), fmt::format("{}={}", tilt_lens::WriteLensVariable, file)};
	if (job.may_write)
		environment.push_back(fmt::format("{}=1", tilt_lens::PilotWritesVariable));
	Progress progress;
	progress.Begin("lens");
	const tiltcal::ProcessResult result = tiltcal::RunProcess({PilotCommand(job, folder), "", environment, "", log}, [&](double seconds)
	{
		progress.Show(fmt::format("parsing, {:.0f} s", seconds));
		// A picture that is being rendered has begun: without that line there is no tilt_lens.
		return WholeLine(file).empty() && Contents(log).find("Rendered ") == std::string::npos;
	});
	progress.End();
	const std::string lens = WholeLine(file);
	if (lens.empty())
	{
		CheckPilotRender(job, result, Contents(log));
		throw tiltcal::Refused("the camera is no tilt_lens. Write it as\n  camera { tilt_lens { } location .. look_at .. }\n(povray-patch/REFERENCE.md has all words)");
	}
	return lens;
}

std::vector<std::string> Lines(const std::string& text)
{
	std::vector<std::string> lines;
	std::istringstream in(text);
	for (std::string line; std::getline(in, line);)
		lines.push_back(line);
	return lines;
}

}

std::string LensPage(const Job& job, const tiltcal::TemporaryFolder& folder)
{
	nlohmann::json lens = nlohmann::json::parse(ParsedLens(job, folder), nullptr, false);
	if (lens.is_discarded())
		throw tiltcal::Refused("the lens that povray wrote cannot be read; do tiltcost and povray belong together?");
	lens["other_words"] = Lines(lens["other_words"].get<std::string>());
	lens["remarks"] = nlohmann::json::array();
	if (lens["focal_point_outside"] || lens["aperture_outside"])
		lens["remarks"].push_back(fmt::format("take {} out of the camera: this block says it", lens["focal_point_outside"] && lens["aperture_outside"] ? "focal_point and aperture" :
			lens["aperture_outside"] ? "aperture" : "focal_point"));
	lens["unit"] = "";
	lens["far"] = 0;
	lens["boards"] = nlohmann::json::array();
	return tiltcal::PlanePage(tiltcal::BaseName(job.scene), "The lens of this scene, in its unit of length. Tilt it until the plane of focus lies where it should, and copy the block into the "
		"<code>camera</code> in place of the one there. The camera itself is not changed here.", lens.dump());
}

}
