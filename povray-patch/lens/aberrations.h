// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The effect `aberrations`: the map of rays that a real, rotationally symmetric lens makes, as one
// polynomial of three invariants (MODEL.md, Real lenses). It stays the same when the lens tilts,
// refocuses or looks at nearer things.
//
// Lens frame: Z the lens's axis n towards the scene. Object side: S, the ray's point in the plane of
// the entrance pupil, b its slopes, X = S + Z b. Image side: S' in the plane of the exit pupil, slopes
// b'; a distance t behind it the ray is at S' - t b'. The opening is the disc |S'| <= m r of the exit
// pupil. The map is stated in the direction that renders, from the image side to the object side, so
// that a ray costs no iteration:
//   linear part     S0 = S'/m,  b0 = m b' - S'/f       (m = 1: the thin lens, R = v - kappa S)
//   invariants      q = S0/r,  P = b0.b0,  R = b0.q,  Q = q.q
//   the rest        g = sum of c_ijk P^i R^j Q^k, of degree 2 (six c) and 3 (ten more)
//                   S = S0 - (2 b0 g_P + q g_R),  b = b0 + (b0 g_R + 2 q g_Q)/r
//   etendue         S as lens/oblique_pupil.h has it of that, where the numbers are of glass
// The c are lengths, r is the radius of the pupil at which they are stated: one that is stopped down
// keeps both, and its rays have |q| < 1. Because the shift is a gradient, the map is symplectic in
// (q, b) but for terms of the order of g squared.
// Sources: Buchdahl, "Optical Aberration Coefficients" (1954); Welford, "Aberrations of Optical
// Systems" (1986); Dragt, "Lie algebraic theory of geometrical optics" (1982).

#ifndef TILT_LENS_ABERRATIONS_H
#define TILT_LENS_ABERRATIONS_H

#include <cmath>
#include <utility>

#include "lens/oblique_pupil.h"

namespace tilt_lens
{

/// The order of the numbers c everywhere, by falling power of the aperture within a degree.
enum AberrationTerm
{
	Spherical,          ///< Q^2    > 0: over-corrected, the rim of the lens focuses farther
	Coma,               ///< R Q    > 0: what the rim draws lies nearer to the axis than what the centre draws, a tail inwards
	Astigmatism,        ///< R^2    > 0: edges across the radius are in focus farther than those along it
	Curvature,          ///< P Q    > 0: the bowl of focus bends away from the lens
	Distortion,         ///< P R    > 0: barrel
	PupilAberration,    ///< P^2    > 0: the entrance pupil moves away from a source beside the axis
	Fifth_QQQ, Fifth_RQQ, Fifth_RRQ, Fifth_PQQ, Fifth_RRR, Fifth_PRQ, Fifth_PRR, Fifth_PPQ, Fifth_PPR, Fifth_PPP
};
const int ThirdOrderTerms = 6;
const int AberrationTerms = 16;
const int FifthOrderTerms = AberrationTerms - ThirdOrderTerms;

/// Powers of P, R and Q, in the order of AberrationTerm.
const int AberrationPowers[AberrationTerms][3] =
{
	{ 0, 0, 2 }, { 0, 1, 1 }, { 0, 2, 0 }, { 1, 0, 1 }, { 1, 1, 0 }, { 2, 0, 0 },
	{ 0, 0, 3 }, { 0, 1, 2 }, { 0, 2, 1 }, { 1, 0, 2 }, { 0, 3, 0 }, { 1, 1, 1 }, { 1, 2, 0 }, { 2, 0, 1 }, { 2, 1, 0 }, { 3, 0, 0 }
};

template<typename T>
struct Aberrations
{
	T c[AberrationTerms];       ///< lengths, zero for a lens without
	T radius;                   ///< r > 0
};

/// A real lens: its linear part and the rest.
template<typename T>
struct RealLens
{
	T pupil_magnification;      ///< m > 0, exit pupil over entrance pupil
	T power;                    ///< 1/f of the glass
	Aberrations<T> aberrations;
	bool etendue = false;       ///< conserved, as glass does (lens/oblique_pupil.h)
};

// ---------------------------------------------------------------------------
// The function g
// ---------------------------------------------------------------------------

/// g_P, g_R, g_Q.
template<typename T>
struct AberrationGradient
{
	T P, R, Q;
};

template<typename T>
inline T AberrationFunction(const T* c, const T& P, const T& R, const T& Q)
{
	return Q * (c[Spherical] * Q + c[Coma] * R + c[Curvature] * P) + R * (c[Astigmatism] * R + c[Distortion] * P) + c[PupilAberration] * P * P +
	       Q * Q * (c[Fifth_QQQ] * Q + c[Fifth_RQQ] * R + c[Fifth_PQQ] * P) + Q * R * (c[Fifth_RRQ] * R + c[Fifth_PRQ] * P) +
	       R * R * (c[Fifth_RRR] * R + c[Fifth_PRR] * P) + P * P * (c[Fifth_PPQ] * Q + c[Fifth_PPR] * R + c[Fifth_PPP] * P);
}

template<typename T>
inline AberrationGradient<T> ThirdOrderGradient(const T* c, const T& P, const T& R, const T& Q)
{
	return { c[Curvature] * Q + c[Distortion] * R + T(2) * c[PupilAberration] * P,
	         c[Coma] * Q + T(2) * c[Astigmatism] * R + c[Distortion] * P,
	         T(2) * c[Spherical] * Q + c[Coma] * R + c[Curvature] * P };
}

template<typename T>
inline AberrationGradient<T> FifthOrderGradient(const T* c, const T& P, const T& R, const T& Q)
{
	const T PP = P * P, PR = P * R, PQ = P * Q, RR = R * R, RQ = R * Q, QQ = Q * Q;
	return { c[Fifth_PQQ] * QQ + c[Fifth_PRQ] * RQ + c[Fifth_PRR] * RR + T(2) * (c[Fifth_PPQ] * PQ + c[Fifth_PPR] * PR) + T(3) * c[Fifth_PPP] * PP,
	         c[Fifth_RQQ] * QQ + T(2) * (c[Fifth_RRQ] * RQ + c[Fifth_PRR] * PR) + T(3) * c[Fifth_RRR] * RR + c[Fifth_PRQ] * PQ + c[Fifth_PPR] * PP,
	         T(3) * c[Fifth_QQQ] * QQ + T(2) * (c[Fifth_RQQ] * RQ + c[Fifth_PQQ] * PQ) + c[Fifth_RRQ] * RR + c[Fifth_PRQ] * PR + c[Fifth_PPQ] * PP };
}

/// The second derivatives of g.
template<typename T>
struct AberrationHessian
{
	T PP, PR, PQ, RR, RQ, QQ;
};

template<typename T>
inline AberrationHessian<T> HessianOfAberrations(const T* c, const T& P, const T& R, const T& Q)
{
	return { T(2) * (c[PupilAberration] + c[Fifth_PPQ] * Q + c[Fifth_PPR] * R) + T(6) * c[Fifth_PPP] * P,
	         c[Distortion] + c[Fifth_PRQ] * Q + T(2) * (c[Fifth_PRR] * R + c[Fifth_PPR] * P),
	         c[Curvature] + c[Fifth_PRQ] * R + T(2) * (c[Fifth_PQQ] * Q + c[Fifth_PPQ] * P),
	         T(2) * (c[Astigmatism] + c[Fifth_RRQ] * Q + c[Fifth_PRR] * P) + T(6) * c[Fifth_RRR] * R,
	         c[Coma] + c[Fifth_PRQ] * P + T(2) * (c[Fifth_RQQ] * Q + c[Fifth_RRQ] * R),
	         T(2) * (c[Spherical] + c[Fifth_RQQ] * R + c[Fifth_PQQ] * P) + T(6) * c[Fifth_QQQ] * Q };
}

// ---------------------------------------------------------------------------
// The map
// ---------------------------------------------------------------------------

/// The shift that the gradient of g makes of (S, b).
template<typename T>
inline PupilRay<T> ShiftOfRay(const AberrationGradient<T>& g, const PupilRay<T>& ray, const T& u, const T& v, const T& inverse_radius)
{
	return { -(T(2) * ray.slope_x * g.P + u * g.R), -(T(2) * ray.slope_y * g.P + v * g.R),
	         (ray.slope_x * g.R + T(2) * u * g.Q) * inverse_radius, (ray.slope_y * g.R + T(2) * v * g.Q) * inverse_radius };
}

/// S, b from S0, b0: what is not linear.
/// FifthOrder: false where the ten numbers of the fifth order are zero, for its time.
template<bool FifthOrder = true, typename T = double>
inline PupilRay<T> Aberrate(const Aberrations<T>& a, const PupilRay<T>& ray)
{
	const T inverse = T(1) / a.radius;
	const T u = ray.x * inverse, v = ray.y * inverse;
	const T P = ray.slope_x * ray.slope_x + ray.slope_y * ray.slope_y;
	const T R = ray.slope_x * u + ray.slope_y * v;
	const T Q = u * u + v * v;
	AberrationGradient<T> g = ThirdOrderGradient(a.c, P, R, Q);
	if(FifthOrder)
	{
		const AberrationGradient<T> fifth = FifthOrderGradient(a.c, P, R, Q);
		g = { g.P + fifth.P, g.R + fifth.R, g.Q + fifth.Q };
	}
	const PupilRay<T> shift = ShiftOfRay(g, ray, u, v, inverse);
	return { ray.x + shift.x, ray.y + shift.y, ray.slope_x + shift.slope_x, ray.slope_y + shift.slope_y };
}

/// The linear part, image side to object side, and back.
template<typename T>
inline PupilRay<T> BeforeLinearLens(const T& pupil_magnification, const T& power, const PupilRay<T>& image)
{
	return { image.x / pupil_magnification, image.y / pupil_magnification,
	         pupil_magnification * image.slope_x - power * image.x, pupil_magnification * image.slope_y - power * image.y };
}

template<typename T>
inline PupilRay<T> BehindLinearLens(const T& pupil_magnification, const T& power, const PupilRay<T>& object)
{
	return { object.x * pupil_magnification, object.y * pupil_magnification,
	         object.slope_x / pupil_magnification + power * object.x, object.slope_y / pupil_magnification + power * object.y };
}

/// The whole lens in the direction that renders: the object-side ray that arrives as the image-side one.
template<typename T>
inline PupilRay<T> ObjectSideRay(const RealLens<T>& lens, const PupilRay<T>& image)
{
	const PupilRay<T> aberrated = Aberrate<true>(lens.aberrations, BeforeLinearLens(lens.pupil_magnification, lens.power, image));
	return lens.etendue ? ObliquePupil(lens.pupil_magnification, lens.power, aberrated) : aberrated;
}

/// The image-side ray from the point (x, y) of the exit pupil to the point (X, Y) a depth t > 0 behind its plane.
template<typename T>
inline PupilRay<T> RayToSensor(const T& x, const T& y, const T& X, const T& Y, const T& t)
{
	return { x, y, (x - X) / t, (y - Y) / t };
}

// ---------------------------------------------------------------------------
// Its derivative, its inverse, and where it folds
// ---------------------------------------------------------------------------

/// The derivative of Aberrate in (q, b) = (S/r, b), rows and columns qx, qy, bx, by.
template<typename T>
inline void AberrationJacobian(const Aberrations<T>& a, const PupilRay<T>& ray, T J[4][4])
{
	const T inverse = T(1) / a.radius;
	const T q[2] = { ray.x * inverse, ray.y * inverse }, b[2] = { ray.slope_x, ray.slope_y };
	const T P = b[0] * b[0] + b[1] * b[1], R = b[0] * q[0] + b[1] * q[1], Q = q[0] * q[0] + q[1] * q[1];
	const AberrationGradient<T> third = ThirdOrderGradient(a.c, P, R, Q), fifth = FifthOrderGradient(a.c, P, R, Q);
	const AberrationGradient<T> g = { third.P + fifth.P, third.R + fifth.R, third.Q + fifth.Q };
	const AberrationHessian<T> h = HessianOfAberrations(a.c, P, R, Q);

	for(int j = 0; j < 2; j++)
	{
		// Of g_P, g_R, g_Q by the component j of q and of b.
		const T P_q = h.PR * b[j] + T(2) * h.PQ * q[j], P_b = T(2) * h.PP * b[j] + h.PR * q[j];
		const T R_q = h.RR * b[j] + T(2) * h.RQ * q[j], R_b = T(2) * h.PR * b[j] + h.RR * q[j];
		const T Q_q = h.RQ * b[j] + T(2) * h.QQ * q[j], Q_b = T(2) * h.PQ * b[j] + h.RQ * q[j];
		for(int i = 0; i < 2; i++)
		{
			const T one = T(i == j ? 1 : 0);
			J[i][j] = one - (one * g.R + T(2) * b[i] * P_q + q[i] * R_q) * inverse;
			J[i][2 + j] = -(T(2) * one * g.P + T(2) * b[i] * P_b + q[i] * R_b) * inverse;
			J[2 + i][j] = (T(2) * one * g.Q + b[i] * R_q + T(2) * q[i] * Q_q) * inverse;
			J[2 + i][2 + j] = one + (one * g.R + b[i] * R_b + T(2) * q[i] * Q_b) * inverse;
		}
	}
}

/// The derivative of Aberrate by each of c, in their order: the shift for c = 1.
template<typename T>
inline void AberrateByCoefficients(const Aberrations<T>& a, const PupilRay<T>& ray, PupilRay<T> by[AberrationTerms])
{
	const T inverse = T(1) / a.radius;
	const T u = ray.x * inverse, v = ray.y * inverse;
	// Powers of P, R and Q: 0 below the zeroth, so that a derivative of a constant is 0.
	T powers[3][5];
	const T invariants[3] = { ray.slope_x * ray.slope_x + ray.slope_y * ray.slope_y, ray.slope_x * u + ray.slope_y * v, u * u + v * v };
	for(int i = 0; i < 3; i++)
	{
		powers[i][0] = T(0);
		powers[i][1] = T(1);
		for(int k = 2; k < 5; k++)
			powers[i][k] = powers[i][k - 1] * invariants[i];
	}
	for(int k = 0; k < AberrationTerms; k++)
	{
		const int *n = AberrationPowers[k];
		const T *P = powers[0] + n[0], *R = powers[1] + n[1], *Q = powers[2] + n[2];
		const AberrationGradient<T> g = { T(n[0]) * P[0] * R[1] * Q[1], T(n[1]) * P[1] * R[0] * Q[1], T(n[2]) * P[1] * R[1] * Q[0] };
		by[k] = ShiftOfRay(g, ray, u, v, inverse);
	}
}

/// Solves J x = e in place of e, by elimination with pivots; J is used up. Returns its determinant, and
/// leaves e undefined where that is 0.
template<typename T>
inline T SolveFour(T J[4][4], T e[4])
{
	using std::abs;
	T determinant = T(1);
	for(int k = 0; k < 4; k++)
	{
		int pivot = k;
		for(int i = k + 1; i < 4; i++)
			if(abs(J[i][k]) > abs(J[pivot][k]))
				pivot = i;
		if(pivot != k)
		{
			for(int j = 0; j < 4; j++)
				std::swap(J[k][j], J[pivot][j]);
			std::swap(e[k], e[pivot]);
			determinant = -determinant;
		}
		determinant = determinant * J[k][k];
		if(!(abs(J[k][k]) > T(0)))
			return T(0);
		for(int i = k + 1; i < 4; i++)
		{
			const T s = J[i][k] / J[k][k];
			for(int j = k; j < 4; j++)
				J[i][j] = J[i][j] - s * J[k][j];
			e[i] = e[i] - s * e[k];
		}
	}
	for(int k = 3; k >= 0; k--)
	{
		for(int j = k + 1; j < 4; j++)
			e[k] = e[k] - J[k][j] * e[j];
		e[k] = e[k] / J[k][k];
	}
	return determinant;
}

/// Determinant of AberrationJacobian: 1 on the axis, and but for the order of g squared elsewhere.
template<typename T>
inline T AberrationDeterminant(const Aberrations<T>& a, const PupilRay<T>& ray)
{
	T J[4][4], none[4] = { T(0), T(0), T(0), T(0) };
	AberrationJacobian(a, ray, J);
	return SolveFour(J, none);
}

/// One search of Unaberrate, by Newton's method from `ray` on, which is replaced.
template<typename T>
inline bool UnaberrateFrom(const Aberrations<T>& a, const PupilRay<T>& aberrated, PupilRay<T>& ray)
{
	using std::abs;
	bool last = false;
	for(int i = 0; i < 30; i++)
	{
		const PupilRay<T> there = Aberrate<true>(a, ray);
		T J[4][4], e[4] = { (aberrated.x - there.x) / a.radius, (aberrated.y - there.y) / a.radius,
		                    aberrated.slope_x - there.slope_x, aberrated.slope_y - there.slope_y };
		const T error = abs(e[0]) + abs(e[1]) + abs(e[2]) + abs(e[3]);
		AberrationJacobian(a, ray, J);
		if(!(error < T(1e100)) || !(SolveFour(J, e) > T(0)))
			return false;
		ray.x = ray.x + a.radius * e[0];
		ray.y = ray.y + a.radius * e[1];
		ray.slope_x = ray.slope_x + e[2];
		ray.slope_y = ray.slope_y + e[3];
		if(last)
			return true;
		// The step that follows squares this.
		last = error <= T(1e-9) * (T(1) + abs(ray.x / a.radius) + abs(ray.y / a.radius) + abs(ray.slope_x) + abs(ray.slope_y));
	}
	return false;
}

/// The inverse of Aberrate: S0, b0 of S, b, by Newton's method, to rounding; from the ray itself or, where that does not do, in steps
/// from the axis. False where it does not converge on the branch that holds the axis, on which the determinant is positive; `ray`
/// is of no use then. With Jets the derivatives come out too, by the step that is taken from where the values are.
template<typename T>
inline bool Unaberrate(const Aberrations<T>& a, const PupilRay<T>& aberrated, PupilRay<T>& ray)
{
	ray = aberrated;
	if(UnaberrateFrom(a, aberrated, ray))
		return true;
	const int steps = 16;
	ray = { T(0), T(0), T(0), T(0) };
	for(int i = 1; i <= steps; i++)
	{
		const T share = T(double(i) / steps);
		if(!UnaberrateFrom(a, { share * aberrated.x, share * aberrated.y, share * aberrated.slope_x, share * aberrated.slope_y }, ray))
			return false;
	}
	return true;
}

/// The whole lens the other way: the image-side ray of the object-side one. False where the map folds.
template<typename T>
inline bool ImageSideRay(const RealLens<T>& lens, const PupilRay<T>& object, PupilRay<T>& image)
{
	PupilRay<T> aberrated = object, linear = object;
	if(lens.etendue && !UprightPupil(lens.pupil_magnification, lens.power, object, aberrated))
		return false;
	const bool found = Unaberrate(lens.aberrations, aberrated, linear);
	image = BehindLinearLens(lens.pupil_magnification, lens.power, linear);
	return found;
}

/// Where a lens folds: two image-side rays come from one object-side ray.
struct AberrationFold
{
	bool folds;
	double slope;       ///< |b0| there, the tangent of the angle to the lens's axis
	double height;      ///< |q| there
};

/// Looks for a fold among slopes up to max_slope and pupil points up to max_height times r, on a grid from the
/// axis outwards; by symmetry all of q and b that differ is their lengths and the angle between them.
/// Numbers that are not finite count as a fold.
inline AberrationFold FindFold(const Aberrations<double>& a, double max_slope, double max_height)
{
	const int steps = 16, angles = 8;
	for(int i = 0; i <= steps; i++)
		for(int j = 0; j <= steps; j++)
			for(int k = 0; k <= angles; k++)
			{
				const double slope = max_slope * i / steps, height = max_height * j / steps;
				const double angle = 3.14159265358979323846 * k / angles;
				const PupilRay<double> ray = { a.radius * height * std::cos(angle), a.radius * height * std::sin(angle), slope, 0.0 };
				if(!(AberrationDeterminant(a, ray) > 0.0))
					return { true, slope, height };
			}
	return { false, 0.0, 0.0 };
}

}

#endif
