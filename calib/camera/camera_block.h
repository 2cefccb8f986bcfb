// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The one writer of camera blocks.

#ifndef TILTCAL_CAMERA_BLOCK_H
#define TILTCAL_CAMERA_BLOCK_H

#include <tiltcal/camera.h>

#include <string>

namespace tiltcal
{

/// How the numbers of a block are written: as themselves, or by the names under which a file declares them.
class BlockNumbers
{
public:
	enum class Unit { NONE, LENGTH, PER_LENGTH };

	virtual ~BlockNumbers() = default;
	/// Such as ("Image_Distance", 48.3, LENGTH); lengths mm.
	virtual std::string Text(const std::string& name, double value, Unit unit) const = 0;
};

/// Numbers themselves, in scene units of unit_mm millimetres.
class PlainNumbers : public BlockNumbers
{
public:
	explicit PlainNumbers(double mm_per_unit) : unit_mm(mm_per_unit) {}
	std::string Text(const std::string& name, double value, Unit unit) const override;

private:
	double unit_mm;
};

/// PREFIX_Image_Distance, ..
class DeclaredNumbers : public BlockNumbers
{
public:
	explicit DeclaredNumbers(const std::string& prefix) : prefix_(prefix) {}
	std::string Text(const std::string& name, double value, Unit unit) const override;

private:
	std::string prefix_;
};

/// What a block says beyond the camera's numbers.
struct BlockLayout
{
	enum class Tilt
	{
		OF_LENS,          ///< which states a focus at infinity too
		OF_FOCAL_PLANE
	} tilt = Tilt::OF_LENS;
	/// Conditions for `#if` around the words; empty: always.
	std::string distortion_only_if, rims_only_if;
	std::string lens_words;   ///< further words of the tilt_lens block, each line indented by two tabs and ended
	std::string place;    ///< lines: location, direction, right, up, .., each indented by one tab and ended
};

/// A `camera { tilt_lens { .. } .. }` block. Sets blur_samples by TiltCal_Blur_Samples, which BlurSamplesDefault declares, and `denoise` where the
/// scene declares TiltCal_Denoise to be 1. Ends with a line end.
std::string CameraBlockText(const StateCamera& camera, const BlockNumbers& numbers, const BlockLayout& layout);

/// Only the lines of the effects, each indented by two tabs and ended.
std::string EffectLines(const StateCamera& camera, const BlockNumbers& numbers, const BlockLayout& layout);

/// K1, K2, P1, P2, K3: in the names of the distortion's numbers.
std::string DeclaredDistortion(size_t k);

/// Rim, Rim2: in the names of the rims' numbers.
std::string RimName(size_t k);

/// `#ifndef`, to be put before the first block of a file.
std::string BlurSamplesDefault();

}

#endif
