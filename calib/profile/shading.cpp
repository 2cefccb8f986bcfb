// SPDX-License-Identifier: AGPL-3.0-or-later

#include "profile/shading.h"

#include <tiltcal/error.h>
#include "base/robust.h"

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

const double GRID = 150;     // pixels across of the shrunk picture
const double TUKEY = 4.685;  // 95 % efficiency for normal errors

int Count(int order) { return (order + 1) * (order + 2) / 2; }

void Basis(int order, double x, double y, double* terms)
{
	for (int degree = 0; degree <= order; ++degree)
		for (int j = 0; j <= degree; ++j)
			*terms++ = std::pow(x, degree - j) * std::pow(y, j);
}

double Normalised(double position, int count) { return count > 1 ? 2 * position / (count - 1) - 1 : 0; }

/// Above it is what may be clipped. Light brighter than white is not: it is of floating point.
double WhiteOf(const cv::Mat& linear)
{
	double most = 0;
	cv::minMaxLoc(linear, nullptr, &most);
	return most > 1 ? HUGE_VAL : 0.99;
}

struct Ratios
{
	Eigen::MatrixXd terms;
	Eigen::VectorXd ratio;
};

/// A/B of the shrunk pictures with the polynomial's terms at their places.
Ratios Collect(const cv::Mat& a, const cv::Mat& b, int order)
{
	const double scale = std::min(1.0, GRID / std::max(a.cols, a.rows));
	cv::Mat small_a, small_b, clipped;
	const cv::Size size(std::max(1, cvRound(a.cols * scale)), std::max(1, cvRound(a.rows * scale)));
	cv::resize(a, small_a, size, 0, 0, cv::INTER_AREA);
	cv::resize(b, small_b, size, 0, 0, cv::INTER_AREA);
	double most = 0;
	cv::minMaxLoc(small_b, nullptr, &most);
	const double white_a = WhiteOf(a), white_b = WhiteOf(b);
	std::vector<double> ratios;
	std::vector<double> terms;
	const size_t n = static_cast<size_t>(Count(order));
	for (int y = 0; y < size.height; ++y)
		for (int x = 0; x < size.width; ++x)
		{
			const double va = small_a.at<float>(y, x), vb = small_b.at<float>(y, x);
			if (vb <= 0 || vb < 0.02 * most || va <= 0 || va > white_a || vb > white_b)
				continue;
			ratios.push_back(va / vb);
			terms.resize(terms.size() + n);
			// Centres of the shrunk pixels, in the full picture's coordinates.
			Basis(order, Normalised((x + 0.5) * a.cols / size.width - 0.5, a.cols), Normalised((y + 0.5) * a.rows / size.height - 0.5, a.rows),
				terms.data() + terms.size() - n);
		}
	if (ratios.size() < 10 * n)
		throw Refused("--match: too few pixels are neither black nor clipped in both pictures to compare their brightness; use --match none");
	Ratios r;
	r.ratio = Eigen::Map<Eigen::VectorXd>(ratios.data(), long(ratios.size()));
	r.terms = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(terms.data(), long(ratios.size()), long(n));
	return r;
}

}

double Shading::At(double column, double row, cv::Size size) const
{
	double terms[64];
	Basis(order, Normalised(column, size.width), Normalised(row, size.height), terms);
	double sum = 0;
	for (size_t k = 0; k < coefficients.size(); ++k)
		sum += coefficients[k] * terms[k];
	return sum;
}

Shading FitShading(const cv::Mat& a, const cv::Mat& b, int order)
{
	const Ratios r = Collect(a, b, order);
	Eigen::VectorXd c = Eigen::VectorXd::Zero(r.terms.cols());
	c[0] = Median({ r.ratio.data(), r.ratio.data() + r.ratio.size() });
	for (int round = 0; round < 30; ++round)
	{
		const Eigen::VectorXd residual = r.ratio - r.terms * c;
		const double scale = TUKEY * std::max(RobustSigma({ residual.data(), residual.data() + residual.size() }), 1e-6 * std::abs(c[0]));
		Eigen::VectorXd weight(residual.size());
		for (long k = 0; k < residual.size(); ++k)
		{
			const double u = residual[k] / scale;
			weight[k] = std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
		}
		const Eigen::MatrixXd weighted = r.terms.transpose() * weight.asDiagonal();
		const Eigen::VectorXd next = (weighted * r.terms).ldlt().solve(weighted * r.ratio);
		const double moved = (next - c).cwiseAbs().maxCoeff();
		c = next;
		if (moved < 1e-9)
			break;
	}
	Shading s;
	s.order = order;
	s.coefficients.assign(c.data(), c.data() + c.size());
	return s;
}

cv::Mat ApplyShading(const cv::Mat& b, const Shading& shading)
{
	cv::Mat result(b.size(), CV_32FC1);
	for (int y = 0; y < b.rows; ++y)
		for (int x = 0; x < b.cols; ++x)
			result.at<float>(y, x) = static_cast<float>(b.at<float>(y, x) * shading.At(x, y, b.size()));
	return result;
}

}
