// SPDX-License-Identifier: AGPL-3.0-or-later
//
// What a calibration finds. Lengths mm, angles degrees, pictures
// pixels; frames of frames.h. Sigmas are one standard deviation, from the covariance of
// the fit rescaled by its residuals: they hold the noise, not what the model leaves out.

#ifndef TILTCAL_CALIBRATION_H
#define TILTCAL_CALIBRATION_H

#include <tiltcal/api.h>
#include <tiltcal/checks.h>
#include <tiltcal/estimate.h>
#include <tiltcal/frames.h>
#include <tiltcal/next_photographs.h>
#include <tiltcal/task.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tiltcal
{

/// Where one state's sensor stands, and its boards. Vectors by photograph.
struct StateGeometry
{
	Vec3<double> lens_normal{ 0, 0, 1 };           ///< the axis of the distortion, given
	/// Where the lens centre stands, seen from the untilted state's, camera frame, mm: a real lens turns about a pivot
	/// away from its pupil. Free where poses are shared, else 0. `poses` hold it already.
	Vec3<double> lens_centre{ 0, 0, 0 }, lens_centre_sigma{ 0, 0, 0 };
	bool principal_point_fixed = false;            ///< not determined, and held near the picture's centre: to 2 % of its width (the paper's model: there)
	Point principal_point{}, principal_point_sigma{};   ///< px
	std::vector<Pose> poses, pose_sigmas;          ///< camera_from_board
	std::vector<double> photo_rms;                 ///< reprojection, px: sqrt(mean(dx^2 + dy^2))
};

/// Where the boards and the sensor are.
struct Geometry
{
	double w_px = 0, w_px_sigma = 0;
	int distortion_terms = 0;      ///< 0 none, 1 k1, 2 k1 k2, 4 with p1 p2, 5 with k3
	bool shared_poses = false;     ///< photograph n of every state shows the board in one pose
	double pupil_magnification = 1, pupil_magnification_sigma = 0;   ///< exit over entrance pupil; 1 in all that is rendered
	Distortion distortion{}, distortion_sigma{};
	double rms = 0;                ///< reprojection, px
	std::vector<StateGeometry> states;
};

/// Of two estimates of a fit, by their names in calibration.json.
struct Correlation
{
	std::string first, second;
	double value = 0;
};

/// Of everything that a fit finds together, in the units of calibration.json.
struct NamedCovariance
{
	std::vector<std::string> names;
	std::vector<double> matrix;   ///< row by row
	std::vector<double> by_photographs;   ///< sigmas from what photographs say against each other; empty: too few to judge
};

/// What a fit without one photograph finds for that photograph's state, and how well it predicts it.
struct LeftOut
{
	size_t state = 0, photo = 0;
	double tilt_change = 0;   ///< length of the change of the tilt vector, degrees; of the untilted state's photographs the greatest of all states
	double aperture_change = 0;        ///< of d, mm
	double inverse_focus_change = 0;   ///< of the untilted state's 1/U, 1/mm
	double rms_blur = 0;      ///< of the photograph that was left out, px
};

/// What the lens is taken for.
enum class Model
{
	PAPER,    ///< Baba, Nakane, Hiura (3), (4), (1), as printed
	RIGID,    ///< exact; the lens only turns and keeps f and w
	PLANE,    ///< exact; a free plane of focus in every state
	CURVED,   ///< PLANE, and a field curvature common to all states
	LENS      ///< CURVED or PLANE, and one real lens for all states from there on: RealLens
};

/// "paper", "rigid", "plane", "curved", "lens".
TILTCAL_API const char* NameOf(Model model);

/// Which numbers give a state's surface of focus.
enum class LensModel
{
	PLANE,   ///< q itself, free in every tilted state
	BOWL,    ///< as PLANE, and the common field curvature C
	BOWLS,   ///< as PLANE, and a tangential and a sagittal field curvature
	RIGID    ///< the lens turns about its centre and keeps f and w: q = n/f - e_z/w
};

/// One model's answer.
struct Solution
{
	Model model = Model::PLANE;
	LensModel lens = LensModel::PLANE;    ///< of the exact models
	Estimate w_mm, aperture_diameter, focus_distance, focal_length, psf_floor_px;
	Estimate psf_floor_squared;           ///< px^2; negative where edges are steeper than their pixels make them: the photographs were sharpened
	std::vector<StateLens> states;
	double rms_blur = 0;                  ///< px; of blurs smaller than a pixel, of half the difference of their squares
	Estimate field_curvature;             ///< C, 1/mm; the mean of the two below
	Estimate tangential_curvature, sagittal_curvature;
	double seconds = 0;      ///< that the model took, by the clock; 0 where it was not timed
	double held_out_px = 0;  ///< of blur left out; 0 when it was not asked for or cannot be had
	std::vector<Correlation> correlations;   ///< of every pair of w, d, U and C, and of each with the tilts
	NamedCovariance covariance;
	std::vector<LeftOut> left_out;   ///< each photograph in turn
	std::string failure;     ///< why there is no answer; empty when there is one
	std::vector<Estimate> stop_ratios;   ///< diameters of Task::stops over the reference's, whose own is 1; empty: one opening for all

	/// Of the opening that a photograph was taken through: over the reference's; and its diameter, mm.
	double RatioOf(const Photo& photo) const { return photo.stop < stop_ratios.size() ? stop_ratios[photo.stop].value : 1; }
	double ApertureOf(const Photo& photo) const { return aperture_diameter.value * RatioOf(photo); }
};

/// The exact models on the same edges, with their held_out_px. rigid and curved may have no answer (failure).
struct ModelComparison
{
	Solution rigid, plane, curved;

	std::array<const Solution*, 3> All() const { return { &rigid, &plane, &curved }; }
};

/// What the places of edges say of the tilts; no states: nothing.
struct GeometryAlone
{
	std::vector<StateLens> states;
	Estimate pupil_magnification;
};

/// Of one patch: the angle between its direction and the lens axis, and the light that is left of it, exposure and gradient of the
/// lighting taken out.
struct FalloffPoint
{
	size_t state = 0;
	double angle_deg = 0, measured = 0, model = 0;
};

/// The exposure of a photograph, or of a flat field with `photo` its index in Task::flat_fields: the white's value on the lens axis.
struct FalloffGain
{
	size_t state = 0, photo = 0;
	double gain = 0;
};

/// One rim of optical vignetting; at a distance < 0 it is behind the lens.
struct RimEstimate
{
	Estimate radius_mm, distance_mm;
};

/// Whether there are two rims.
struct SecondRim
{
	bool used = false;
	std::string why;                     ///< empty: it was not asked
	double sigmas = 0;                   ///< of what its two numbers do to the fit
	double held_out_without = 0, held_out_with = 0;   ///< RMS of brightness and places of edges left out, in sigmas; 0: not known
};

/// What a fit with some of the two kinds of vignetting finds.
struct FalloffAnswer
{
	bool fitted = false;
	bool rim_seen = false;               ///< without it the rim cuts nothing, and its numbers are 0
	Estimate radius_mm, distance_mm;     ///< of the rim, the first of two
	std::vector<RimEstimate> rims;       ///< all of them, that one first
	SecondRim second;
	Estimate darkening;                  ///< what the rims take of the patch that they darken most, 0..1
	/// Of that darkening, and of what one rim's two numbers do to the fit, the smaller one.
	double rim_sigmas = 0;
	double rms = 0, held_out = 0;        ///< of the logarithm of the brightness; 0: there is nothing to leave out
	std::vector<FalloffGain> gains;
	std::vector<FalloffPoint> points;
};

/// Index of Vignetting::answers.
inline size_t FalloffKind(bool natural, bool optical) { return (natural ? 1u : 0u) + (optical ? 2u : 0u); }

struct Vignetting
{
	std::string failure;      ///< why nothing can be said; empty when something can
	bool flat_field = false;  ///< told by flat fields, not by the board
	std::array<FalloffAnswer, 4> answers;   ///< by FalloffKind
};

/// What the colours of edges tell of chromatic aberration: index 0 red, 1 blue, each against green.
struct Chromatic
{
	std::string failure;      ///< why nothing can be said; empty when something can
	int edges = 0;
	std::array<Estimate, 2> lateral;         ///< C_R, C_B of tilt_lens's `chromatic lateral`
	std::array<Estimate, 2> axial_per_mm;    ///< A_R, A_B
	double lateral_held_out_without = 0, lateral_held_out_with = 0;   ///< of an edge's shift, px; 0: there is nothing to leave out
	double axial_held_out_without = 0, axial_held_out_with = 0;       ///< of an edge's difference in blur width, px
};

/// The effects of tilt_lens that a calibration can write.
enum class EffectId
{
	DISTORTION,
	FIELD_CURVATURE,
	VIGNETTING_NATURAL,
	VIGNETTING_OPTICAL,
	CHROMATIC_LATERAL,
	CHROMATIC_AXIAL,
	BLADES
};

/// In the order in which they are chosen and reported.
const std::array<EffectId, 7> ALL_EFFECTS{ EffectId::DISTORTION, EffectId::FIELD_CURVATURE, EffectId::VIGNETTING_NATURAL, EffectId::VIGNETTING_OPTICAL,
	EffectId::CHROMATIC_LATERAL, EffectId::CHROMATIC_AXIAL, EffectId::BLADES };

/// "distortion", "field_curvature", ..: as in calibration.json.
TILTCAL_API const char* NameOf(EffectId effect);

/// An effect of tilt_lens, and whether the camera blocks name it.
struct Effect
{
	EffectId id = EffectId::DISTORTION;
	std::string failure;                     ///< why it was not estimated; empty when it was
	bool used = false;
	std::string why;                         ///< it is written or not
	std::vector<std::pair<std::string, Estimate>> values;   ///< what a person would ask for
	double sigmas = 0;                       ///< how many standard deviations it is from nothing; NaN: it has no number of its own
	double held_out_without = 0, held_out_with = 0;   ///< 0: not known
	std::string unit;                        ///< of the latter
	std::string note;                        ///< more to say; may be empty
};

/// How a real lens stands in a state. The image distance is from the exit pupil to the sensor, along the sensor's normal.
struct RealLensState
{
	StateLens lens;                   ///< of the thin lens that stands for it near its axis (povray-patch/lens/MODEL.md, Real lenses)
	StateLens as_it_scatters;         ///< the same with sigmas of scatter alone
	Estimate image_distance_mm;
	double best_focus_mm = 0;         ///< along the sensor's normal, where the whole opening's light from the principal point's pixel is sharpest; infinite or negative: at infinity, beyond
	Point principal_point{}, principal_point_sigma{};   ///< of the exit pupil, px
	std::vector<Pose> poses;          ///< camera_from_board; the camera's origin is the centre of the entrance pupil
	/// Where that lies seen from the untilted state's, camera frame; 0 unless poses are shared.
	Vec3<double> lens_centre_mm{ 0, 0, 0 };
};

/// One real lens in all states. Sigmas are the larger of those by edges and by photographs; but for aberrations they also hold how far
/// halves of the edges put it apart.
struct RealLens
{
	std::string failure;              ///< why there is none; empty when there is one
	Estimate focal_length_mm, pupil_magnification, aperture_diameter_mm, psf_floor_squared;
	Estimate opening_on_axis_mm;      ///< what the rims leave of the aperture on the axis, of the light from the point in focus; never more than it
	std::vector<Estimate> stop_ratios;   ///< as Solution's
	double radius_mm = 0;             ///< of the entrance pupil, at which the aberrations are stated
	/// Spherical, coma, astigmatism, curvature, distortion, pupil, and ten of the fifth order, in the order of lens/aberrations.h.
	std::array<Estimate, 16> aberrations_mm;
	bool fifth_order = false;         ///< the ten are there
	std::vector<RimEstimate> rims;    ///< found together with the lens; of six numbers those of the thin lens, larger as the aperture is
	std::vector<RealLensState> states;
	NamedCovariance covariance;       ///< of these numbers as the edges scatter, the six-number lens's as it stands about poses of each state's own
	double rms_place = 0, rms_blur = 0;       ///< robust, px
	/// The same of the shape of blurs, as parts of their light: asymmetry and hollowness (edge/disc_shape.h); where the lens was fitted to it.
	std::optional<std::array<double, 2>> rms_shape;
	std::vector<double> place_errors_px;      ///< of every edge, predicted minus measured, along its normal to the bright side; states, photographs and edges one after the other
	std::vector<double> blur_errors_px;       ///< the same of their blur
	double held_out = 0;              ///< RMS residual of photographs predicted by the others, in what is usual of all; 0: cannot be said
	double held_out_thin = 0;         ///< the same, in the same units, by the thin lens that it starts from
	bool used = false;                ///< it is the answer: Calibration::TiltOf
	double seconds = 0;               ///< that it took, by the clock

	/// Then nothing shows the border of the stop.
	bool RimHoldsBackTheAxis() const { return opening_on_axis_mm.value < aperture_diameter_mm.value; }

	/// An aberration in thousandths of the focal length, as the scene language has it.
	Estimate PerMille(size_t k) const
	{
		const double unit = 1000 / focal_length_mm.value;
		return { unit * aberrations_mm[k].value, unit * aberrations_mm[k].sigma };
	}
};

struct Calibration
{
	Task task;
	Geometry geometry;           ///< the best one: with distortion where it is significant
	Geometry pinhole;            ///< without distortion, for a renderer that has none
	Solution solution;           ///< of the model asked for, with `geometry`; where a real lens is the answer, the thin lens that it starts from
	Solution render;             ///< the same model with `pinhole`: the camera where distortion is switched off
	bool refined = true;         ///< false: the joint refinement was asked for and did not converge
	bool jointly = false;        ///< geometry and blur were refined together: it was asked for, and converged
	std::vector<PhotographCheck> photographs;   ///< of the exact models
	BoardCheck board_check;
	FocusCheck focus_check;
	UntiltedCheck untilted_check;
	std::vector<StateLens> blur_alone;      ///< the same before the joint refinement: blur, with the geometry held
	GeometryAlone geometry_alone;
	std::vector<StateLens> thin_as_it_scatters; ///< of `solution`, where its sigmas hold how far parts of the edges put it apart; else empty
	int fits_without_answer = 0;            ///< of parts of the edges, or of edges read otherwise, that had no answer: the sigmas do not hold how far those put the lens apart
	std::optional<RealLens> real_lens;      ///< where it was asked for, or the thin lens leaves aberrations over
	/// Sixteen numbers and the rims, from `real_lens` on: what scenes are seen through where it is `used`. Its `held_out_thin` is that of `real_lens`, in its units.
	std::optional<RealLens> scene_lens;
	std::optional<ModelComparison> compared;   ///< when the model was to be chosen
	Solution paper;              ///< the paper's model, always
	Geometry paper_geometry;     ///< poses of the paper's stage 1
	Vignetting vignetting;
	Chromatic chromatic;
	std::vector<Effect> effects;   ///< of all; empty before they are chosen
	LightCheck light;            ///< of the exact models
	Verdict verdict;             ///< of the exact models; the paper's is not judged
	NextPhotographs next;        ///< where it was asked for, of the exact models, where the joint refinement converged

	/// The lens that stands for state s: near its axis the real one's where that is the answer, else the thin one.
	bool RealLensIsUsed() const { return real_lens && real_lens->used; }
	bool SceneLensIsUsed() const { return RealLensIsUsed() && scene_lens && scene_lens->used; }
	/// What the real lens's cameras have.
	const RealLens& LensOfScenes() const { return SceneLensIsUsed() ? *scene_lens : *real_lens; }
	const StateLens& TiltOf(size_t s) const { return RealLensIsUsed() ? real_lens->states[s].lens : solution.states[s]; }
	/// The same with the sigmas that more photographs make smaller.
	const StateLens& TiltAsItScatters(size_t s) const { return RealLensIsUsed() ? real_lens->states[s].as_it_scatters : s < thin_as_it_scatters.size() ? thin_as_it_scatters[s] : solution.states[s]; }
	/// What of the sigma of TiltOf's lens tilt does not scatter, degrees: how far photographs left out, parts of the edges and lenses with more numbers put it apart.
	double TiltLeftOutByModel(size_t s) const
	{
		const double all = TiltOf(s).lens_tilt.sigma, scatter = TiltAsItScatters(s).lens_tilt.sigma;
		return std::sqrt(std::max(0., all * all - scatter * scatter));
	}
	/// The paper's method is solved for comparison only.
	bool IsJudged() const { return solution.model != Model::PAPER; }
	Model Answer() const { return RealLensIsUsed() ? Model::LENS : solution.model; }

	/// Of several stops: of what is known best. Six numbers put the focus of a stopped-down lens by their spherical aberration, which stands for the fifth order's too.
	const std::vector<Estimate>& StopRatios() const { return RealLensIsUsed() ? LensOfScenes().stop_ratios : solution.stop_ratios; }
	const Estimate& ApertureOfStops() const { return RealLensIsUsed() ? LensOfScenes().aperture_diameter_mm : solution.aperture_diameter; }

	/// Geometry that belongs to the calibration's own solution (the paper has its own).
	const Geometry& MainGeometry() const { return solution.model == Model::PAPER ? paper_geometry : geometry; }

	/// The geometry of `render`.
	const Geometry& RenderGeometry() const { return solution.model == Model::PAPER ? paper_geometry : pinhole; }
};

}

#endif
