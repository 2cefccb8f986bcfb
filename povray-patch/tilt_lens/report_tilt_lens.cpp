// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The Tilt lens block of the render statistics: gathers from the threads and the
// view, and puts the text into the statistics message for the front end.

#include <boost/thread.hpp>
#include <boost/bind.hpp>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "base/povms.h"
#include "base/povmscpp.h"
#include "base/povmsgid.h"
#include "backend/math/vector.h"
#include "backend/scene/view.h"
#include "lens/statistics.h"
#include "backend/tilt_lens/camera_vectors.h"
#include "backend/tilt_lens/denoised_picture.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

void View::GetTiltLensStatistics(POVMS_Object& renderStats)
{
	const Camera& camera = viewData.camera;
	tilt_lens::RenderCounts counts;

	if(!camera.Tilt_Lens.spec.enabled)
		return;

	for(vector<ViewThreadData *>::iterator i(viewThreadData.begin()); i != viewThreadData.end(); i++)
		counts += (*i)->tiltLensCounts;

	const POVRect& area = viewData.renderArea;
	const tilt_lens::FocusCounts focus = tilt_lens::CountFocus(camera.Tilt_Lens.lens, Vectors_Of(camera),
	                                                           viewData.width, viewData.height,
	                                                           area.left, area.top, area.right, area.bottom);

	const double denoised = camera.Tilt_Lens.Denoises() ? camera.Tilt_Lens.denoised->RmsError() : -1.0;

	renderStats.SetString(kPOVAttrib_TiltLensReport, tilt_lens::StatisticsText(camera.Tilt_Lens.lens, focus, counts, denoised).c_str());
}

}
