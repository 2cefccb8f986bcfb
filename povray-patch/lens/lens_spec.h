// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a scene says about its tilt_lens camera (LensSpec), and the lens that
// follows from it (TiltLens). Free of POV-Ray, so that it can be tested alone.

#ifndef TILT_LENS_LENS_SPEC_H
#define TILT_LENS_LENS_SPEC_H

#include <string>

#include "lens/aberrations.h"
#include "lens/blades.h"
#include "lens/distortion.h"
#include "lens/lens_ray.h"
#include "lens/optical_vignetting.h"
#include "lens/pupil_magnification.h"
#include "lens/vec3.h"

namespace tilt_lens
{

typedef Vec3<double> Vec3d;

enum class Word;        // words.h

/// A value that a scene may leave out.
template<typename T>
struct Given
{
	bool given = false;
	T value = T();

	Given& operator=(const T& v) { given = true; value = v; return *this; }
	explicit operator bool() const { return given; }
};

/// The words of the tilt_lens block and the words around it that matter to the
/// lens, as the scene gave them. Angles in degrees, lengths in world units.
struct LensSpec
{
	bool enabled = false;

	// The plane of focus: at most one of the first four.
	Given<double> focal_plane_tilt;
	Given<double> lens_tilt;
	Given<Vec3d> focal_plane_point;     ///< focal_plane P, N
	Vec3d focal_plane_normal = { 0.0, 0.0, 1.0 };
	Given<Vec3d> focal_points[3];
	Given<double> tilt_direction;
	Given<double> focal_distance;

	// The sensor side.
	Given<double> image_distance;
	Given<double> focal_length;
	Given<Vec3d> shift;                 ///< x, y used

	// The aperture.
	Given<double> aperture_diameter;
	Given<double> f_stop;

	// Effects, off unless named.
	bool distortion_given = false;
	double distortion[DistortionTerms] = {};
	Given<double> field_curvature;
	Given<double> blades;               ///< how many
	Given<double> blade_rotation, blade_curvature;
	bool natural_vignetting = false;
	Rim rims[MostRims] = {};            ///< vignetting optical R, Z, R, Z ..
	int rim_count = 0;
	bool lateral_given = false, axial_given = false;
	double lateral[Wavelengths] = {}, axial[Wavelengths] = {};
	Given<double> pupil_magnification;
	bool aberrations_given = false;
	double aberrations[AberrationTerms] = {};   ///< in thousandths of the focal length
	Given<double> aberrations_focal_length, aberrations_f_stop; ///< for which they hold
	bool aberrations_etendue = false;           ///< etendue is conserved
	bool bokeh = false;                 ///< POV-Ray's word outside the block: the opening is the pigment's square

	/// Let pixels learn from their neighbours.
	bool denoise = false;

	/// Ask the whole grid of every area light at every hit, as stock does.
	bool area_light_grid = false;

	/// Keep more than colours of every pixel, for files that can hold it.
	bool channels = false;

	/// Which of the equally good sets of samples to take.
	Given<double> seed;

	// The preview of focus.
	bool show_focus = false;
	bool show_plane = false;
	Given<double> show_width;           ///< of the picture whose pixels `show focus` counts; else this one's

	// Words outside the block. The points move with the camera's transformations.
	bool angle_given = false;
	bool right_given = false;
	Given<Vec3d> focal_point;
	Given<Vec3d> look_at;
	double aperture = 0.0;              ///< POV-Ray's word: a lens of diameter A/2

	/// The words outside the block are those of the camera whose lens was `before` and is this one now. What
	/// the block says is later: words that it contradicts are dropped.
	void Take_Words_Around(const LensSpec& before);

	/// The window right x up is the sensor itself, at the image distance; otherwise it
	/// only says the field of view.
	bool Sensor_Is_Window() const { return (image_distance.given || focal_length.given) && !angle_given; }
};

/// The camera's vectors after all its transformations, in the world.
struct CameraVectors
{
	Vec3d location, direction, right, up;
};

/// The resolved lens. World vectors unless a name says camera (frame of
/// MODEL.md: x right, y up, z along the axis).
struct TiltLens
{
	Vec3d direction;                    ///< centre of the viewing window, shift included
	Vec3d axis;                         ///< e_z, unit
	Vec3d inverse_focus;                ///< q
	Vec3d normal;                       ///< n
	Vec3d lens_x, lens_y;               ///< radius times an orthonormal basis of the lens plane
	Vec3d basis_x, basis_y;             ///< that basis itself
	double aperture_diameter = 0.0;
	bool distorts = false;
	double distortion[DistortionTerms] = {};
	double field_curvature = 0.0;       ///< C
	Blades blades = {};                 ///< none: the opening is round, or square
	bool shifted = false, bokeh = false;
	bool square = false;                ///< the opening of a bokeh pigment without blades, as wide as the aperture
	bool natural_vignetting = false;
	Rim rims[MostRims] = {};            ///< beside the aperture
	int rim_count = 0;
	double lateral[Wavelengths] = {}, axial[Wavelengths] = {};
	double pupil_magnification = 1.0;
	Aberrations<double> aberrations = {};   ///< in world units
	double etendue_power = 0.0;             ///< of the glass, where etendue is conserved; else 0
	bool aberrates = false, aberrates_fifth = false;
	double reach = 1.0;                 ///< rays leave from points up to so many radii of the opening from its centre
	double reach_of_pinhole = 0.0;      ///< and so far from the centre of a lens without an opening

	// What follows from the effects (effects.cpp).
	LensStep steps[MostLensSteps + 1] = {};     ///< of every ray, ended by NULL
	bool has_effects = false;
	bool moves_pinhole_rays = false;    ///< without an opening it still is not `perspective`
	bool weighs = false;                ///< rays may arrive darkened, or not at all
	bool splits = false;                ///< three wavelengths are traced

	/// Focused on a bowl, not on a plane.
	bool Curves() const { return field_curvature != 0.0; }
	/// Inverse focus distance of the direction v, for reports; the tracer has its own
	/// copy without the question. Without aberrations.
	double Kappa(const Vec3d& v) const;
	/// How far the pinhole direction v goes along the lens's normal, seen through both pupils: it has rays where this is above 0. Linear in v.
	double Depth(const Vec3d& v) const { return Dot(DirectionFromExitPupil(axis, pupil_magnification, v), normal); }

	// For reports.
	Vec3d inverse_focus_camera;         ///< q in the camera frame
	Vec3d normal_camera;                ///< n in the camera frame
	double image_distance = 0.0;        ///< w
	double power = 0.0;                 ///< 1/f

	/// No opening: the pinhole picture, traced as by `perspective`.
	bool IsPinhole() const { return aperture_diameter == 0.0; }
};

/// The lens for the words and vectors. False where no lens does what the words
/// ask, or where they contradict each other; `error` then says which inequality
/// is violated and by how much, and what to change. Never leaves a NaN behind.
bool ResolveTiltLens(const LensSpec& spec, const CameraVectors& camera, TiltLens& lens, std::string& error);

}

#endif
