// SPDX-License-Identifier: AGPL-3.0-or-later
//
// tiltcal: the command line.

#include "calibrate/quiet.h"
#include "cli/commands.h"
#include "program/program.h"

#include <tiltcal/error.h>

#include <new>

int main(int argc, char** argv)
{
	// What Ceres and OpenCV have to say is said in our own errors.
	const tiltcal::QuietLibraries quiet;
	return tiltcal::RunProgram("tiltcal", [&]
	{
		CLI::App app("tiltcal: calibrates a tilted lens from photographs of a checkerboard or a grid of circles, for tilt_lens in POV-Ray.", "tiltcal");
		app.set_version_flag("--version", "tiltcal " TILTCAL_VERSION);
		app.require_subcommand(1);
		app.footer("Exit codes: 0 done, 1 refused or not converged, 2 wrong usage, 3 unreadable or unwritable file.\n"
			"'tiltcal SUBCOMMAND --help' shows options, units, defaults and an example.");
		tiltcal::AddTarget(app);
		tiltcal::AddDetect(app);
		tiltcal::AddCalibrate(app, tiltcal::CommandLine(argc, argv));
		tiltcal::AddPose(app);
		tiltcal::AddProfile(app);
		tiltcal::AddLens(app);
		tiltcal::AddExport(app);
		tiltcal::AddImport(app);
		tiltcal::AddUndistort(app);
		tiltcal::AddProject(app);
		tiltcal::AddUnproject(app);
		try
		{
			app.parse(argc, argv);
		}
		catch (const CLI::ParseError& e)
		{
			return app.exit(e) == 0 ? tiltcal::EXIT_DONE : tiltcal::EXIT_USAGE;
		}
		catch (const std::bad_alloc&)
		{
			throw tiltcal::Refused("out of memory: the pictures are too large");
		}
		return tiltcal::EXIT_DONE;
	});
}
