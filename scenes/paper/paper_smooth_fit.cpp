// SPDX-License-Identifier: AGPL-3.0-or-later

#include "paper_smooth_fit.h"

#include "base/robust.h"

#include <Eigen/Dense>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace paper
{

namespace
{

const int TERMS = 10;
/// Levels per pixel: what counts as an edge. Noise has some 1.
const float EDGE = 4;
const double HUBER = 1.5;
using Terms = std::array<double, TERMS>;

/// 1, x, y, xx, xy, yy, xxx, xxy, xyy, yyy of the pixel, x and y from -1 to 1.
Terms TermsAt(int column, int row, cv::Size size)
{
	const double x = 2.0 * column / (size.width - 1) - 1, y = 2.0 * row / (size.height - 1) - 1;
	return { 1, x, y, x * x, x * y, y * y, x * x * x, x * x * y, x * y * y, y * y * y };
}

double Value(const Eigen::VectorXd& coefficients, int first, const Terms& terms)
{
	double sum = 0;
	for (int k = 0; k < TERMS; ++k)
		sum += coefficients[first + k] * terms[static_cast<size_t>(k)];
	return sum;
}

/// The derivatives along x and y, levels per pixel.
void Derivatives(const cv::Mat& picture, cv::Mat& along_x, cv::Mat& along_y)
{
	cv::Sobel(picture, along_x, CV_32F, 1, 0, 3, 1.0 / 8);
	cv::Sobel(picture, along_y, CV_32F, 0, 1, 3, 1.0 / 8);
}

/// One linear least squares step: residual = sum over fields f and terms t of step[f, t] field_f(pixel) t(pixel), at the pixels of
/// `where`. Weights are Huber's.
Eigen::VectorXd Step(const cv::Mat& residual, const std::vector<cv::Mat>& fields, const cv::Mat& where)
{
	const int n = TERMS * static_cast<int>(fields.size());
	std::vector<double> all;
	for (int y = 0; y < residual.rows; ++y)
		for (int x = 0; x < residual.cols; ++x)
			if (where.at<unsigned char>(y, x))
				all.push_back(residual.at<float>(y, x));
	if (all.empty())
		return Eigen::VectorXd::Zero(n);
	const double bound = HUBER * std::max(tiltcal::RobustSigma(all), 1e-3);
	Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
	Eigen::VectorXd right = Eigen::VectorXd::Zero(n), row(n);
	for (int y = 0; y < residual.rows; ++y)
		for (int x = 0; x < residual.cols; ++x)
		{
			if (!where.at<unsigned char>(y, x))
				continue;
			const Terms terms = TermsAt(x, y, residual.size());
			for (size_t f = 0; f < fields.size(); ++f)
				for (int k = 0; k < TERMS; ++k)
					row[static_cast<int>(f) * TERMS + k] = fields[f].at<float>(y, x) * terms[static_cast<size_t>(k)];
			const double r = residual.at<float>(y, x), weight = std::abs(r) > bound ? bound / std::abs(r) : 1;
			normal.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
			right += weight * r * row;
		}
	return normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
}

cv::Mat Blurred(const cv::Mat& picture)
{
	cv::Mat blurred;
	cv::GaussianBlur(picture, blurred, cv::Size(0, 0), 1, 1, cv::BORDER_REPLICATE);
	return blurred;
}

/// Where both pictures, smoothed already, have edges.
cv::Mat Edges(const cv::Mat& a, const cv::Mat& b)
{
	cv::Mat along_x, along_y, length_a, length_b;
	Derivatives(a, along_x, along_y);
	cv::magnitude(along_x, along_y, length_a);
	Derivatives(b, along_x, along_y);
	cv::magnitude(along_x, along_y, length_b);
	return cv::min(length_a, length_b) > EDGE;
}

/// The lengths and the mean of the field over the pixels of `where`.
void Summarise(Displacement& d, const cv::Mat& where)
{
	double squares = 0, count = 0;
	for (int y = 0; y < where.rows; ++y)
		for (int x = 0; x < where.cols; ++x)
			if (where.at<unsigned char>(y, x))
			{
				const Terms terms = TermsAt(x, y, where.size());
				const double dx = Value(d.field, 0, terms), dy = Value(d.field, TERMS, terms);
				squares += dx * dx + dy * dy;
				d.mean_x_px += dx;
				d.mean_y_px += dy;
				++count;
			}
	count = std::max(count, 1.0);
	d.rms_px = std::sqrt(squares / count);
	d.mean_x_px /= count;
	d.mean_y_px /= count;
}

}

std::array<double, 2> DisplacementAt(const Displacement& d, int column, int row, cv::Size size)
{
	const Terms terms = TermsAt(column, row, size);
	return { Value(d.field, 0, terms), Value(d.field, TERMS, terms) };
}

cv::Mat Move(const cv::Mat& picture, const Displacement& displacement)
{
	cv::Mat map_x(picture.size(), CV_32FC1), map_y(picture.size(), CV_32FC1), moved;
	for (int y = 0; y < picture.rows; ++y)
		for (int x = 0; x < picture.cols; ++x)
		{
			const Terms terms = TermsAt(x, y, picture.size());
			map_x.at<float>(y, x) = static_cast<float>(x - Value(displacement.field, 0, terms));
			map_y.at<float>(y, x) = static_cast<float>(y - Value(displacement.field, TERMS, terms));
		}
	cv::remap(picture, moved, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
	return moved;
}

Displacement FitDisplacement(const cv::Mat& a, const cv::Mat& b)
{
	const cv::Mat smooth_a = Blurred(a), smooth_b = Blurred(b), where = Edges(smooth_a, smooth_b);
	Displacement d;
	d.field = Eigen::VectorXd::Zero(2 * TERMS);
	cv::Mat along_x, along_y;
	while (d.rounds < 20)
	{
		++d.rounds;
		const cv::Mat moved = Move(smooth_b, d);
		Derivatives(moved, along_x, along_y);
		// a(x) = b(x - D - step) = moved - gradient . step
		const Eigen::VectorXd step = Step(moved - smooth_a, { along_x, along_y }, where);
		d.field += step;
		// No term exceeds 1 in the picture.
		if (step.head(TERMS).cwiseAbs().sum() < 0.002 && step.tail(TERMS).cwiseAbs().sum() < 0.002)
			break;
	}
	Summarise(d, where);
	return d;
}

Eigen::VectorXd FitSharpness(const cv::Mat& a, const cv::Mat& b)
{
	const cv::Mat smooth = Blurred(b), change = smooth - b, where = Edges(Blurred(a), smooth);
	Eigen::VectorXd c = Eigen::VectorXd::Zero(TERMS);
	for (int round = 0; round < 20; ++round)   // the weights follow the residuals
	{
		const Eigen::VectorXd step = Step(a - ChangeSharpness(b, c), { change }, where);
		c += step;
		if (step.cwiseAbs().sum() < 0.002)
			break;
	}
	return c;
}

cv::Mat ChangeSharpness(const cv::Mat& picture, const Eigen::VectorXd& c)
{
	cv::Mat result = Blurred(picture);
	// Where the polynomial runs out of edges it may run away: nothing beyond the Gaussian itself, or as much taken off.
	for (int y = 0; y < picture.rows; ++y)
		for (int x = 0; x < picture.cols; ++x)
		{
			const float old = picture.at<float>(y, x);
			result.at<float>(y, x) = static_cast<float>(old + std::clamp(Value(c, 0, TermsAt(x, y, picture.size())), -1.0, 1.0) * (result.at<float>(y, x) - old));
		}
	return result;
}

}
