// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The covariance of a lens fit, asked for by name.

#ifndef TILTCAL_LENS_COVARIANCE_H
#define TILTCAL_LENS_COVARIANCE_H

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tiltcal
{

/// Of the numbers that people read: w (mm), d (mm), floor^2 (px^2), the two of field curvature (1/mm; model/footprint.h), and
/// q (1/mm) of every state; last the logarithms of the further stops' ratios. Rescaled by the fit's residuals.
class LensCovariance
{
public:
	enum class Number
	{
		IMAGE_DISTANCE,
		APERTURE_DIAMETER,
		FLOOR_SQUARED,
		CURVATURE,                   ///< the mean of tangential and sagittal
		HALF_CURVATURE_DIFFERENCE,
		COUNT
	};
	enum class Axis { X, Y, Z };

	/// Place of a number in the matrix.
	struct At
	{
		int index;

		explicit At(int place) : index(place) {}
		At(Number number) : index(static_cast<int>(number)) {}
		/// q of a state.
		At(size_t state, Axis axis) : index(static_cast<int>(Number::COUNT) + 3 * static_cast<int>(state) + static_cast<int>(axis)) {}
	};

	LensCovariance() = default;
	/// Square, in the order of At.
	explicit LensCovariance(Eigen::MatrixXd matrix) : c(std::move(matrix)) {}

	/// Of a stop that is not the reference, 0.
	static At OfStop(size_t states, size_t stop) { return At(Size(states) + static_cast<int>(stop) - 1); }

	static int Size(size_t states, size_t further_stops = 0) { return At(states, Axis::X).index + static_cast<int>(further_stops); }

	double operator()(At a, At b) const { return c(a.index, b.index); }
	double Variance(At a) const { return c(a.index, a.index); }
	double Sigma(At a) const { return std::sqrt(Variance(a)); }
	/// Standard deviation of a + sign b.
	double SigmaOfSum(At a, At b, double sign = 1) const { return std::sqrt(std::max(Variance(a) + sign * 2 * (*this)(a, b) + Variance(b), 0.0)); }

	/// Of (q_x, q_y, q_z, w) of a state.
	Eigen::Matrix4d OfPlaneAndImageDistance(size_t state) const
	{
		const int q = At(state, Axis::X).index, w = At(Number::IMAGE_DISTANCE).index;
		Eigen::Matrix4d block;
		block << c.block<3, 3>(q, q), c.block<3, 1>(q, w), c.block<1, 3>(w, q), c(w, w);
		return block;
	}

private:
	Eigen::MatrixXd c;
};

}

#endif
