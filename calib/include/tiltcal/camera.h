// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The camera of one state: what a picture needs, from a calibration or a file. Frames of frames.h; mm, degrees, px.

#ifndef TILTCAL_CAMERA_H
#define TILTCAL_CAMERA_H

#include <tiltcal/api.h>
#include <tiltcal/calibration.h>
#include <tiltcal/frames.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// Radius and distance of a rim, or the numbers of red and of blue.
using TwoNumbers = std::array<double, 2>;

/// One standard deviation of the members of StateCamera of the same names; 0 where none is known, as of a camera read from a file.
struct StateCameraSigma
{
	double image_distance_mm = 0, focal_length_mm = 0, aperture_diameter_mm = 0, focus_distance_mm = 0;
	double lens_tilt_deg = 0, tilt_direction_deg = 0, focal_plane_tilt_deg = 0;
	double field_curvature_per_mm = 0, psf_floor_px = 0;
	Point principal_point{};
	Distortion distortion{};
	Vec3<double> lens_centre_mm{ 0, 0, 0 };
};

/// What makes a real lens of the thin one that stands for it near its axis (povray-patch/lens/MODEL.md, Real lenses).
struct CameraAberrations
{
	double pupil_magnification = 1, focal_length_mm = 0, radius_mm = 0;   ///< radius: of the entrance pupil at which `mm` is stated
	std::array<double, 16> mm{};   ///< spherical, coma, astigmatism, curvature, distortion, pupil, and ten of the fifth order: lens/aberrations.h
	bool etendue = false;              ///< conserved: lens/oblique_pupil.h
};

struct StateCamera
{
	std::string state;                 ///< the state's name
	std::string model;                 ///< "plane", .., "opencv" when imported
	int width = 0, height = 0;
	double pitch_mm = 0, image_distance_mm = 0;
	Point principal_point{};
	Distortion distortion{};           ///< about the lens axis
	/// As reported: folded into (-90, 90], the tilt carries the sign.
	double lens_tilt_deg = 0, tilt_direction_deg = 0;
	double focus_distance_mm = 0;      ///< U on the axis; infinite where it is that; < 0: beyond infinity; means nothing unless KnowsFocus
	double aperture_diameter_mm = 0;   ///< d; 0 where it is unknown
	double field_curvature_per_mm = 0;
	// Effects that the calibration writes; empty or false: not.
	bool natural_vignetting = false;
	std::vector<TwoNumbers> rims_mm;   ///< R, Z of each
	std::optional<TwoNumbers> lateral, axial_per_mm;   ///< red, blue
	/// Then distortion and field_curvature_per_mm are 0. Project, Unproject and BlurWidth are of the thin lens without them.
	std::optional<CameraAberrations> aberrations;
	FixedBlades blades;                ///< the aperture's diameter is that of the circle through their corners
	// What follows from these, or is not rendered. 0 in a camera that was read from a file.
	double focal_length_mm = 0, focal_plane_tilt_deg = 0, psf_floor_px = 0;
	Vec3<double> lens_centre_mm{ 0, 0, 0 };   ///< seen from the untilted state's, camera frame
	StateCameraSigma sigma;

	double ImageDistancePx() const { return image_distance_mm / pitch_mm; }
	TILTCAL_API Vec3<double> LensNormal() const;
	/// q, 1/mm: the plane of focus is { P : q.P = 1 }; of a bowl, the plane that touches it on the lens axis.
	TILTCAL_API Vec3<double> PlaneOfFocus() const;
	/// False of an imported camera: OpenCV's model has neither an aperture nor a plane of focus.
	bool KnowsFocus() const { return aperture_diameter_mm > 0; }
	bool IsTilted() const { return lens_tilt_deg != 0; }
	bool HasDistortion() const { return distortion != Distortion{}; }
};

/// Which of a calibration's two cameras: as the lens is, or the best one without distortion.
enum class Distorted { YES, NO };

/// The camera of a state, with the effects that the calibration chose. Throws UsageError where there is no such state.
TILTCAL_API StateCamera CameraOfState(const Calibration& calibration, size_t state, Distorted distorted = Distorted::YES);

/// The camera of one state of calibration.json; `state` empty: the first, which is the untilted one. Throws FileError:
/// unreadable, not JSON, a key missing or of the wrong kind (file and key are named); UsageError: no such state (those there are
/// listed).
TILTCAL_API StateCamera ReadStateCamera(const std::string& file, const std::string& state);

/// Pixel where the camera sees P (camera frame, mm). None: P is not in front of the lens plane, its z is not above 0, or it is beyond the angle
/// where the distortion turns back.
TILTCAL_API std::optional<Point> Project(const StateCamera& camera, const Vec3<double>& P);

/// Direction of what the pixel sees through the lens centre, camera frame. Its length means nothing: (u, v, 1) of the pixel with the
/// distortion taken off. None where the distortion turns back before it leads there: nothing is known of such pixels.
TILTCAL_API std::optional<Vec3<double>> Unproject(const StateCamera& camera, const Point& pixel);

/// Diameter of the blur disc of a point on the sensor, px, to first order: w d |1/z - kappa|, kappa the inverse focus distance
/// on the bowl (the paper's (2) with its plane of focus taken along the ray). Without the lens's own blur; with blades, that of the circle
/// through their corners. z > 0. NaN unless KnowsFocus.
TILTCAL_API double BlurWidth(const StateCamera& camera, const Vec3<double>& P);

/// The outline of the blur disc of a point P on the sensor, px: the pixels that see P through `count` lens points on the rim of the
/// circular opening, in equal steps of angle from the lens's own x axis towards its y axis. Exact for a thin lens, on the bowl where there is
/// one, with the distortion. z > 0; none where P is not in front of the lens, or unless KnowsFocus.
TILTCAL_API std::optional<std::vector<Point>> Footprint(const StateCamera& camera, const Vec3<double>& P, size_t count = 64);

/// Where a camera stands in a scene: scene units, unit vectors at right angles, left-handed.
struct Place
{
	Vec3<double> location{ 0, 0, 0 }, right{ 1, 0, 0 }, up{ 0, 1, 0 }, forward{ 0, 0, 1 };
};

/// The camera as a `camera { tilt_lens { .. } .. }` block for the patched POV-Ray. `unit_mm`: millimetres to a scene unit. Expects
/// TiltCal_Blur_Samples to be declared (the lens samples of a pixel); TiltCal_Denoise may be (1: `denoise`).
TILTCAL_API std::string CameraBlockOf(const StateCamera& camera, const Place& place, double unit_mm = 1);

}

#endif
