// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The methods that tilt_lens adds to POV-Ray's Camera.

#include <cstdlib>
#include <fstream>

// frame.h must always be the first POV file included (pulls in platform config)
#include "backend/frame.h"
#include "backend/math/vector.h"
#include "backend/math/matrices.h"
#include "backend/scene/camera.h"
#include "lens/lens_text.h"
#include "backend/tilt_lens/camera_vectors.h"
#include "backend/tilt_lens/denoised_picture.h"
#include "backend/tilt_lens/pilot_queue.h"
#include "lens/lens_channels.h"

// this must be the last file included
#include "base/povdebug.h"

namespace pov
{

/// Records the words around the tilt_lens block that matter to the lens. Called
/// while the parser still marks words that were not given with HUGE_VAL.
void Camera::Note_Words_For_Tilt_Lens()
{
	if (!Tilt_Lens.spec.enabled)
		return;

	Tilt_Lens.spec.angle_given = (Angle != HUGE_VAL) && (Angle > 0.0);
	Tilt_Lens.spec.right_given = (Right[X] != HUGE_VAL);
	Tilt_Lens.spec.aperture = Aperture;
	if (Look_At[X] != HUGE_VAL)
		Tilt_Lens.spec.look_at = From_Vector(Look_At);
	if (Focal_Point[X] != HUGE_VAL)
		Tilt_Lens.spec.focal_point = From_Vector(Focal_Point);
}

/// Points given outside the block are camera words: they move with the camera.
/// Points inside the block are world points: they do not.
void Camera::Transform_Tilt_Lens(const TRANSFORM *Trans)
{
	tilt_lens::Given<tilt_lens::Vec3d> *points[2] = { &Tilt_Lens.spec.look_at, &Tilt_Lens.spec.focal_point };

	for (int i = 0; i < 2; i++)
	{
		if (points[i]->given)
		{
			VECTOR v;
			Make_Vector(v, points[i]->value.x, points[i]->value.y, points[i]->value.z);
			MTransPoint(v, v, Trans);
			points[i]->value = From_Vector(v);
		}
	}
}

}

namespace tilt_lens
{

bool CameraLens::Keeps_Pixels() const
{
	// A render that goes on does so in its first pass: the second's pixels would be missing there.
	return !Records() && !Denoises();
}

void CameraLens::Begin_Picture(int width, int height, int left, int top, int right, int bottom)
{
	if(Denoises())
		denoised->Begin(width, height, left, top, right, bottom, Records());
	if(Records())
		channels->Begin(width, height);
	LensChannels::SetCurrent(Records() ? channels : nullptr);
	if(pilot_queue)
		pilot_queue->Begin(width, height, left, top, right, bottom);
	// Before radiosity's pretrace, which may take its time: there is a lens to sample.
	if(pilot && Samples_Lens())
		std::ofstream(pilot.file.c_str(), std::ios::app);
	const char *file = std::getenv(WriteLensVariable);
	if(spec.enabled && (file != NULL))
		std::ofstream(file) << LensText(spec, vectors, lens, width, height);
}

}
