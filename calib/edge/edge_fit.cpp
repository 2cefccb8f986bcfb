// SPDX-License-Identifier: AGPL-3.0-or-later

#include "edge/edge_fit.h"

#include "base/robust.h"
#include "edge/soft_radius.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace tiltcal
{

namespace
{

enum { LOW, HIGH, OFFSET, SLOPE, RADIUS, PARAMETERS };
using Vector = Eigen::Matrix<double, PARAMETERS, 1>;
using Matrix = Eigen::Matrix<double, PARAMETERS, PARAMETERS>;

const double LEAST_SOFT = -2;   // of a soft radius (soft_radius.h): steeper than any sharpening makes an edge
const double HUBER = 2.5;   // in standard deviations: JPEG blocks and specks, not the shape

/// What the parameters are fitted to.
struct Observed
{
	const std::vector<EdgeSample>& samples;
	const EdgeProfile& profile;
	const EdgeShading& shading;
};

double Predict(const Vector& p, const EdgeSample& sample, const EdgeProfile& profile, const EdgeShading& shading, Vector* gradient)
{
	const EdgeResponse e = SoftResponse(p[RADIUS], [&](double radius) { return profile.At(sample, p[OFFSET], p[SLOPE], radius); });
	const double shade = 1 + shading.x * sample.x + shading.s * sample.s;
	const double step = p[HIGH] - p[LOW];
	const double flat = p[LOW] + step * e.value;
	if (gradient)
	{
		Vector& g = *gradient;
		g[LOW] = shade * (1 - e.value);
		g[HIGH] = shade * e.value;
		g[OFFSET] = -shade * step * e.d_position;
		g[SLOPE] = g[OFFSET] * sample.s;
		g[RADIUS] = shade * step * e.d_radius;
	}
	return shade * flat;
}

struct Normal
{
	Matrix JtJ = Matrix::Zero();
	Vector Jtr = Vector::Zero();
	double cost = 0;        // Huber cost in units of scale^2
	double squares = 0;     // weighted squared residuals
	double weight = 0;
};

/// Normal equations of the robust problem at p.
Normal Assemble(const Vector& p, const Observed& of, double scale)
{
	Normal n;
	Vector g;
	for (const EdgeSample& sample : of.samples)
	{
		const double r = sample.value - Predict(p, sample, of.profile, of.shading, &g);
		const double u = std::abs(r) / scale;
		const double w = u <= HUBER ? 1 : HUBER / u;
		n.cost += u <= HUBER ? u * u : 2 * HUBER * u - HUBER * HUBER;
		n.squares += w * r * r;
		n.weight += w;
		n.JtJ.selfadjointView<Eigen::Lower>().rankUpdate(g, w);
		n.Jtr += w * r * g;
	}
	n.JtJ = Matrix(n.JtJ.selfadjointView<Eigen::Lower>());
	return n;
}

/// RobustSigma, and at least what the shape of the blur leaves out: a lens's is no even disc. What is not counted in full (HUBER) lies beyond 5 % of the step.
double ResidualScale(const Vector& p, const Observed& of)
{
	std::vector<double> r;
	r.reserve(of.samples.size());
	for (const EdgeSample& sample : of.samples)
		r.push_back(sample.value - Predict(p, sample, of.profile, of.shading, nullptr));
	return std::max(RobustSigma(std::move(r)), 0.02 * std::abs(p[HIGH] - p[LOW]) + 1e-12);
}

/// One Levenberg-Marquardt descent at a fixed robust scale. False: singular, or still on its way after so many iterations.
bool Descend(Vector& p, const Observed& of, double scale, int iterations)
{
	double lambda = 1e-3;
	Normal n = Assemble(p, of, scale);
	bool stands = false;
	for (int i = 0; i < iterations; ++i)
	{
		Matrix A = n.JtJ;
		A.diagonal() += lambda * A.diagonal() + Vector::Constant(1e-12);
		const Vector step = A.ldlt().solve(n.Jtr);
		if (!step.allFinite())
			return false;
		Vector q = p + step;
		q[RADIUS] = std::max(q[RADIUS], LEAST_SOFT);
		// Steps are nearly always good, so the derivatives are computed with the cost.
		const Normal next = Assemble(q, of, scale);
		if (next.cost <= n.cost)
		{
			stands = std::abs(q[RADIUS] - p[RADIUS]) < 1e-3 && std::abs(step[OFFSET]) < 1e-3;
			const bool settled = stands && n.cost - next.cost < 1e-4 * n.cost;
			p = q;
			n = next;
			if (settled)
				return true;
			lambda = std::max(lambda * 0.2, 1e-9);
		}
		else if ((lambda *= 5) > 1e8)
			return true;
	}
	return stands;   // without noise the cost falls on to nothing
}

/// Plateaus from the outer quarters on both sides.
Vector Start(const std::vector<EdgeSample>& samples, double start_radius)
{
	std::vector<double> dark, bright;
	double reach = 0;
	for (const EdgeSample& sample : samples)
		reach = std::max(reach, std::abs(sample.x));
	for (const EdgeSample& sample : samples)
	{
		if (sample.x < -0.5 * reach)
			dark.push_back(sample.value);
		else if (sample.x > 0.5 * reach)
			bright.push_back(sample.value);
	}
	Vector p = Vector::Zero();
	p[RADIUS] = SoftOfSquare(std::max(start_radius * start_radius, 0.01));
	if (dark.size() < 8 || bright.size() < 8)
		return p;
	p[LOW] = Median(std::move(dark));
	p[HIGH] = Median(std::move(bright));
	return p;
}

}

LoneEdge::LoneEdge(double nx, double ny) : box_a(std::abs(nx)), box_b(std::abs(ny)) {}

EdgeResponse LoneEdge::At(const EdgeSample& sample, double offset, double slope, double radius) const
{
	return PixelEdgeResponse(sample.x - offset - slope * sample.s, radius, box_a, box_b);
}

EdgeFit FitEdge(const std::vector<EdgeSample>& samples, const EdgeProfile& profile, const EdgeShading& shading, double start_radius)
{
	EdgeFit fit;
	if (samples.size() < 40)
		return fit;
	Vector p = Start(samples, start_radius);
	if (!(p[HIGH] - p[LOW] > 0.01 * std::abs(p[HIGH])))
		return fit;

	const Observed of{ samples, profile, shading };
	// The robust scale of the start says little: descend on a coarse one first.
	double scale = 0.25 * (p[HIGH] - p[LOW]);
	for (int round = 0; round < 3; ++round)
	{
		// The first rounds are starts of the next one's.
		if (!Descend(p, of, scale, 30) && round == 2)
			return fit;
		scale = ResidualScale(p, of);
	}
	const Normal n = Assemble(p, of, scale);
	const double variance = n.squares / std::max(n.weight - PARAMETERS, 1.0);
	const Matrix covariance = n.JtJ.ldlt().solve(Matrix::Identity()) * variance;
	if (!covariance.allFinite() || !(p[HIGH] > p[LOW]))
		return fit;

	fit.low = p[LOW];
	fit.high = p[HIGH];
	fit.shading = shading;
	fit.offset = p[OFFSET];
	fit.slope = p[SLOPE];
	fit.radius = SignedRoot(SquareOfSoft(p[RADIUS]));
	const auto sigma = [&](int k) { return std::sqrt(std::max(covariance(k, k), 0.0)); };
	fit.offset_sigma = sigma(OFFSET);
	fit.slope_sigma = sigma(SLOPE);
	fit.radius_sigma = sigma(RADIUS);
	fit.rms = std::sqrt(n.squares / n.weight);
	fit.valid = true;
	return fit;
}

EdgeChange FirstOrderChange(const std::vector<EdgeSample>& samples, const EdgeProfile& profile, const EdgeProfile& other, const EdgeFit& fit)
{
	Vector p, g;
	p << fit.low, fit.high, fit.offset, fit.slope, SoftOfSquare(SignedSquare(fit.radius));
	Matrix JtJ = Matrix::Zero();
	Vector Jtr = Vector::Zero();
	for (const EdgeSample& sample : samples)
	{
		const double value = Predict(p, sample, profile, fit.shading, &g);
		JtJ += g * g.transpose();
		Jtr += (Predict(p, sample, other, fit.shading, nullptr) - value) * g;
	}
	const Vector shift = JtJ.ldlt().solve(Jtr);
	return { shift[OFFSET], shift[SLOPE], shift[RADIUS] };
}

}
