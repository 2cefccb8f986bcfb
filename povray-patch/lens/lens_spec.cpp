// SPDX-License-Identifier: AGPL-3.0-or-later

#include <algorithm>
#include <cmath>

#include "lens/angles.h"
#include "lens/check_words.h"
#include "lens/effects.h"
#include "lens/field_curvature.h"
#include "lens/lens_spec.h"
#include "lens/optics.h"
#include "lens/ray_range.h"
#include "lens/refusal.h"

namespace tilt_lens
{

namespace
{

/// The camera frame of MODEL.md as world vectors.
struct Frame
{
	Vec3d location, x, y, z;
	double window_distance;     ///< of POV-Ray's viewing window, along z

	Vec3d CameraVector(const Vec3d& world) const { return { Dot(x, world), Dot(y, world), Dot(z, world) }; }
	Vec3d CameraPoint(const Vec3d& world) const { return CameraVector(world - location); }
	Vec3d WorldVector(const Vec3d& v) const { return v.x * x + (v.y * y + v.z * z); }
};

Frame FrameOf(const CameraVectors& camera)
{
	Frame f;
	if(!IsFinite(camera.location) || !IsFinite(camera.direction) || !IsFinite(camera.right) || !IsFinite(camera.up))
		Refuse("tilt_lens: the camera's location, direction, right or up is not finite.");
	if(!(MaxAbs(camera.right) > 0.0) || !(MaxAbs(camera.up) > 0.0) || !(MaxAbs(camera.direction) > 0.0))
		Refuse("tilt_lens: the camera's direction, right and up must not be <0, 0, 0>.");

	f.location = camera.location;
	f.x = Normalized(camera.right);
	const Vec3d up = Normalized(camera.up);
	const Vec3d z = Cross(f.x, up);
	const double sine = ScaledLength(z);
	if(!(sine > 1e-12))
		Refuse("tilt_lens: the camera's right and up are parallel.");
	f.z = Normalized(z);
	f.y = Cross(f.z, f.x);
	f.window_distance = Dot(f.z, camera.direction);
	if(f.window_distance < 0.0)
	{
		f.z = -1.0 * f.z;
		f.window_distance = -f.window_distance;
	}
	if(!(f.window_distance > 1e-12 * ScaledLength(camera.direction)))
		Refuse("tilt_lens: the camera's direction lies in the plane of right and up.");
	return f;
}

/// Where the plane of focus lies along the axis, before its tilt is known.
struct Depth
{
	bool through_point;
	Vec3d point;                ///< camera frame
	double inverse_distance;    ///< 1/U
};

Depth DepthOf(const LensSpec& spec, const Frame& frame)
{
	if(spec.focal_distance)
		return { false, {}, 1.0 / spec.focal_distance.value };
	if(spec.focal_point)
		return { true, frame.CameraPoint(spec.focal_point.value), 0.0 };
	// Neither given: what the camera looks at, else the viewing window, as in stock.
	double z = frame.window_distance;
	if(spec.look_at)
		z = frame.CameraPoint(spec.look_at.value).z;
	return { false, {}, 1.0 / z };
}

[[noreturn]] void RefusePlaneThroughLens(const char* words)
{
	Refuse("tilt_lens: the plane of focus of %s passes through the lens centre; no lens can focus there. "
	       "Move the plane or the camera.", words);
}

Vec3d PlaneFromWorld(const Frame& frame, const Vec3d& point, const Vec3d& normal, const char* words)
{
	const Vec3d m = frame.CameraVector(Normalized(normal));
	const Vec3d P = frame.CameraPoint(point);
	// Relative to the point's distance: nearer than this the distance is rounding.
	if(!(std::fabs(Dot(m, P)) > 1e-14 * ScaledLength(P)))
		RefusePlaneThroughLens(words);
	return PlaneThroughPoint(m, P);
}

Vec3d PlaneFromPoints(const Frame& frame, const Given<Vec3d> points[3])
{
	const Vec3d a = points[1].value - points[0].value;
	const Vec3d b = points[2].value - points[0].value;
	if(!(MaxAbs(a) > 0.0) || !(MaxAbs(b) > 0.0))
		Refuse("tilt_lens: two of the focal_points are the same.");
	const Vec3d normal = Cross(Normalized(a), Normalized(b));
	if(!(ScaledLength(normal) > 1e-12))
		Refuse("tilt_lens: the three focal_points lie on one line (sine of their angle %g).", ScaledLength(normal));
	return PlaneFromWorld(frame, points[0].value, normal, "focal_points");
}

/// q for the words that state the plane itself, whatever the sensor is.
Vec3d PlaneWithoutSensor(const LensSpec& spec, const Frame& frame)
{
	if(spec.focal_plane_point)
		return PlaneFromWorld(frame, spec.focal_plane_point.value, spec.focal_plane_normal, "focal_plane");
	if(spec.focal_points[0])
		return PlaneFromPoints(frame, spec.focal_points);

	const Vec3d m = FocalPlaneDirection(spec.focal_plane_tilt.value * RadiansPerDegree,
	                                    spec.tilt_direction.value * RadiansPerDegree);
	const Depth depth = DepthOf(spec, frame);
	if(!depth.through_point)
		return PlaneAtDistance(m, depth.inverse_distance);
	if(!(std::fabs(Dot(m, depth.point)) > 1e-14 * ScaledLength(m) * ScaledLength(depth.point)))
		RefusePlaneThroughLens("focal_plane_tilt through focal_point");
	return PlaneThroughPoint(m, depth.point);
}

/// 1/w from focal_length; both bounds of the vector lens equation are named.
double ImageDistanceFromFocalLength(const Vec3d& q, double focal_length)
{
	const double power = 1.0 / focal_length;
	const double qxy = ScaledLength(Vec3d{ q.x, q.y, 0.0 });
	if(qxy > power)
		Refuse("tilt_lens: the hinge lies %g from the lens, nearer than focal_length %g; "
		       "tilt the plane of focus less, move it away, or use a focal_length below %g.",
		       1.0 / qxy, focal_length, 1.0 / qxy);
	const double inverse = InverseImageDistance(q, power);
	if(!(inverse > 0.0))
		Refuse("tilt_lens: the plane of focus passes %g from the lens centre, no farther than focal_length %g: "
		       "1/image_distance would be %g, which must be greater than 0; move it away, or use a focal_length below %g.",
		       1.0 / ScaledLength(q), focal_length, inverse, 1.0 / ScaledLength(q));
	return inverse;
}

struct SensorAndPlane
{
	Vec3d q;
	double inverse_image_distance;
};

SensorAndPlane FromLensTilt(const LensSpec& spec, const Frame& frame)
{
	const Vec3d n = LensNormalFromTilt(spec.lens_tilt.value * RadiansPerDegree,
	                                   spec.tilt_direction.value * RadiansPerDegree);
	const double w = spec.image_distance ? spec.image_distance.value : frame.window_distance;
	const bool power_given = spec.focal_length.given;

	if(power_given && spec.image_distance)
		return { PlaneFromLens(n, 1.0 / spec.focal_length.value, 1.0 / w), 1.0 / w };

	const Depth depth = DepthOf(spec, frame);
	const double n_P = Dot(n, depth.point);
	if(depth.through_point && !(std::fabs(n_P) > 1e-14 * ScaledLength(depth.point)))
		Refuse("tilt_lens: focal_point lies in the plane of the tilted lens, which cannot focus there.");

	if(power_given)
	{
		// n/f = q + e_z/w, dotted with the point (q.P = 1) or taken along the axis.
		const double power = 1.0 / spec.focal_length.value;
		if(depth.through_point && depth.point.z == 0.0)
			Refuse("tilt_lens: focal_point lies beside the lens centre (depth 0).");
		const double inverse = depth.through_point ? (n_P * power - 1.0) / depth.point.z
		                                           : n.z * power - depth.inverse_distance;
		if(!(inverse > 0.0))
			Refuse("tilt_lens: a lens of focal_length %g tilted by %g degrees cannot focus that near: "
			       "1/image_distance would be %g, which must be greater than 0. Move the focus away (along the axis "
			       "beyond %g), tilt the lens less, or use a shorter focal_length.",
			       spec.focal_length.value, spec.lens_tilt.value, inverse, spec.focal_length.value / n.z);
		return { PlaneFromLens(n, power, inverse), inverse };
	}

	const double inverse_U = depth.through_point ? InverseDistanceThroughPoint(n, 1.0 / w, depth.point)
	                                             : depth.inverse_distance;
	return { PlaneFromLensTilt(n, 1.0 / w, inverse_U), 1.0 / w };
}

SensorAndPlane SensorAndPlaneOf(const LensSpec& spec, const Frame& frame)
{
	if(spec.lens_tilt)
		return FromLensTilt(spec, frame);
	const Vec3d q = PlaneWithoutSensor(spec, frame);
	if(spec.focal_length)
		return { q, ImageDistanceFromFocalLength(q, spec.focal_length.value) };
	return { q, 1.0 / (spec.image_distance ? spec.image_distance.value : frame.window_distance) };
}

double ApertureDiameterOf(const LensSpec& spec, double power)
{
	if(spec.aperture_diameter)
		return spec.aperture_diameter.value;
	if(spec.f_stop)
		return (1.0 / std::fabs(power)) / spec.f_stop.value;
	// Stock's aperture samples fill a disc of diameter A/2: keep its pictures.
	return std::fabs(spec.aperture) * 0.5;
}

/// The centre of the viewing window. Without `angle` the sensor is the window
/// right x up at the image distance; with it the field of view stays, and the
/// sensor is as large as that field at the image distance.
Vec3d WindowCentre(const LensSpec& spec, const CameraVectors& camera, const Frame& frame, double image_distance)
{
	const double scale = image_distance / frame.window_distance;
	const bool sensor_is_window = spec.Sensor_Is_Window();
	const Vec3d direction = sensor_is_window ? scale * camera.direction : camera.direction;
	if(!spec.shift)
		return direction;
	const double unit = sensor_is_window ? 1.0 : 1.0 / scale;
	return direction + (unit * spec.shift.value.x) * frame.x + (unit * spec.shift.value.y) * frame.y;
}

void Resolve(const LensSpec& spec, const CameraVectors& camera, TiltLens& lens)
{
	CheckWords(spec);
	const Frame frame = FrameOf(camera);
	const SensorAndPlane sp = SensorAndPlaneOf(spec, frame);

	if(!IsFinite(sp.q) || !IsFinite(sp.inverse_image_distance))
		Refuse("tilt_lens: the plane of focus is nearer to the lens centre than numbers can say.");
	const Vec3d power = LensPower(sp.q, sp.inverse_image_distance);
	if(!(ScaledLength(power) > 1e-14 * sp.inverse_image_distance))
		Refuse("tilt_lens: the plane of focus lies on the sensor (%g behind the lens); no lens normal exists.",
		       1.0 / sp.inverse_image_distance);

	const Lens<double> l = LensFromPlane(sp.q, sp.inverse_image_distance);
	lens.inverse_focus_camera = sp.q;
	lens.inverse_focus = frame.WorldVector(sp.q);
	lens.normal_camera = l.normal;
	lens.normal = frame.WorldVector(l.normal);
	lens.power = l.power;
	lens.image_distance = 1.0 / sp.inverse_image_distance;
	lens.axis = frame.z;
	lens.direction = WindowCentre(spec, camera, frame, lens.image_distance);
	lens.aperture_diameter = ApertureDiameterOf(spec, l.power);

	const LensBasis<double> basis = BasisOfLensPlane(l.normal);
	lens.basis_x = frame.WorldVector(basis.a);
	lens.basis_y = frame.WorldVector(basis.b);
	lens.lens_x = (0.5 * lens.aperture_diameter) * lens.basis_x;
	lens.lens_y = (0.5 * lens.aperture_diameter) * lens.basis_y;

	if(!IsFinite(lens.direction) || !IsFinite(lens.lens_x) || !IsFinite(lens.lens_y) ||
	   !IsFinite(lens.power) || !IsFinite(lens.image_distance))
		Refuse("tilt_lens: these numbers are too large or too small to make a lens of.");
	if(!(ShortestDirection(lens) > ShortestRay) || !(LongestDirection(lens, camera) < LongestRay))
		Refuse("tilt_lens: the directions of rays would be from %g to %g long, which must be within %g to %g; "
		       "the camera, its shift or its aperture is too large or too small.",
		       ShortestDirection(lens), LongestDirection(lens, camera), ShortestRay, LongestRay);

	ResolveEffects(spec, camera, lens);
}

}

void LensSpec::Take_Words_Around(const LensSpec& before)
{
	const bool states_distance = focal_plane_point || focal_points[0] || focal_distance || (lens_tilt && focal_length && image_distance);

	angle_given = before.angle_given;
	right_given = before.right_given;
	look_at = before.look_at;
	if(!states_distance)
		focal_point = before.focal_point;
	if(!aperture_diameter && !f_stop)
		aperture = before.aperture;
}

double TiltLens::Kappa(const Vec3d& v) const
{
	return Curves() ? InverseFocusDistanceOnBowl(inverse_focus, field_curvature, normal, v)
	                : InverseFocusDistance(inverse_focus, v);
}

bool ResolveTiltLens(const LensSpec& spec, const CameraVectors& camera, TiltLens& lens, std::string& error)
{
	try
	{
		lens = TiltLens();
		Resolve(spec, camera, lens);
		return true;
	}
	catch(const Refusal& refusal)
	{
		lens = TiltLens();
		error = refusal.text;
		return false;
	}
}

}
