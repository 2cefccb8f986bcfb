// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The tilt_lens part of POV-Ray's Camera: what the scene said, and the lens that
// the parser resolved from it. Copied with the camera.

#ifndef TILT_LENS_CAMERA_LENS_H
#define TILT_LENS_CAMERA_LENS_H

#include <memory>
#include <vector>

#include <boost/shared_ptr.hpp>

#include "lens/adaptive.h"
#include "lens/lens_spec.h"
#include "lens/pilot.h"

namespace tilt_lens
{

class DenoisedPicture;
class LensChannels;
class PilotQueue;
struct ShownLabels;
class TileBorders;

struct CameraLens
{
	LensSpec spec;
	TiltLens lens;
	CameraVectors vectors;              ///< of which it was resolved
	bool finished = false;              ///< its camera has ended: what follows is another's
	std::vector<SampleLevel> levels;    ///< increasing; the last one always stops
	boost::shared_ptr<TileBorders> borders; ///< between the tiles of one picture, whichever thread traces them

	boost::shared_ptr<DenoisedPicture> denoised; ///< where the scene asks for it, else null
	std::shared_ptr<LensChannels> channels; ///< where the scene asks for them, else null
	double bokeh_gain[3] = {};          ///< for red, green, blue: 1 over the mean of the bokeh pigment over the opening
	bool bokeh_parts_colours = false;   ///< whether it lets one through where it stops another
	boost::shared_ptr<ShownLabels> labels; ///< of `show focus`, else null
	PilotRequest pilot;                 ///< what tiltcost asks for, instead of the picture
	boost::shared_ptr<PilotQueue> pilot_queue; ///< its blocks

	/// Which of the equally good sets of samples.
	uint32_t Seed() const { return uint32_t(int64_t(spec.seed.value)); }
	/// Rays leave from many points of the lens (and cover the pixel's area), not from one.
	bool Samples_Lens() const { return spec.enabled && !Shows() && !lens.IsPinhole(); }
	/// A ray asks one point of an area light, not all.
	bool Samples_Lights() const { return Samples_Lens() && !spec.area_light_grid; }
	/// The picture is traced in a first pass and shown in a second.
	bool Denoises() const { return denoised && Samples_Lens() && !pilot; }
	/// More than colours is kept of every pixel.
	bool Records() const { return channels && Samples_Lens() && !pilot; }
	/// An interrupted render can go on after the pixels it has: nothing but them is kept, and they are final.
	bool Keeps_Pixels() const;
	/// A view of width x height pixels begins, of which left..right, top..bottom (inclusive) are rendered.
	void Begin_Picture(int width, int height, int left, int top, int right, int bottom);
	/// The preview of focus is asked for instead of the picture.
	bool Shows() const { return spec.show_focus || spec.show_plane; }
};

}

#endif
