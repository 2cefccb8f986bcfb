// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Sigmas over photographs, against fits that really leave each photograph out.

#include "solve/by_photographs.h"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <random>

namespace
{

using namespace tiltcal;

/// y = a x + b z + (its photograph's own c), so that a least-squares fit has a closed form.
struct Sample { size_t photo, group; double x, z, y; };

struct Line
{
	double x, z, y;
	template<typename T> bool operator()(const T* shared, const T* own, T* r) const
	{
		r[0] = shared[0] * x + shared[1] * z + own[0] - y;
		return true;
	}
};

/// `common`: what all samples of a photograph have in common, in their slope.
std::vector<Sample> Draw(size_t photos, size_t groups, double common, unsigned seed)
{
	std::mt19937 random(seed);
	std::normal_distribution<double> normal;
	std::vector<Sample> all;
	for (size_t p = 0; p < photos; ++p)
	{
		const double slope = common * normal(random), own = normal(random);
		for (int i = 0; i < 40; ++i)
		{
			const double x = normal(random), z = normal(random);
			all.push_back({ p, p % groups, x, z, (2 + slope) * x - z + own + 0.1 * normal(random) });
		}
	}
	return all;
}

/// (a, b) by QR, without one photograph; size_t(-1): with all.
Eigen::Vector2d Fit(const std::vector<Sample>& all, size_t photos, size_t without)
{
	Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Eigen::Index(all.size()), Eigen::Index(photos) + 2);
	Eigen::VectorXd y = Eigen::VectorXd::Zero(A.rows());
	for (size_t i = 0; i < all.size(); ++i)
		if (all[i].photo != without)
		{
			A.row(Eigen::Index(i))[0] = all[i].x;
			A.row(Eigen::Index(i))[1] = all[i].z;
			A(Eigen::Index(i), Eigen::Index(all[i].photo) + 2) = 1;
			y[Eigen::Index(i)] = all[i].y;
		}
	return A.completeOrthogonalDecomposition().solve(y).head<2>();
}

/// A problem that stands at its minimum.
struct Fitted
{
	ceres::Problem problem;
	std::vector<double> own;
	std::vector<PhotographBlocks> blocks;
	double shared[2];

	Fitted(const std::vector<Sample>& all, size_t photos) : own(photos), blocks(photos)
	{
		const Eigen::Vector2d start = Fit(all, photos, size_t(-1));
		std::copy_n(start.data(), 2, shared);
		for (const Sample& s : all)
		{
			blocks[s.photo].group = s.group;
			blocks[s.photo].pose = &own[s.photo];
			blocks[s.photo].residuals.push_back(problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Line, 1, 2, 1>(new Line{ s.x, s.z, s.y }), nullptr, shared, &own[s.photo]));
		}
		ceres::Solver::Summary summary;
		ceres::Solve(ceres::Solver::Options(), &problem, &summary);
	}
};

std::optional<Eigen::Matrix2d> Jackknifed(const std::vector<Sample>& all, size_t photos)
{
	Fitted fitted(all, photos);
	const std::optional<CovarianceByPhotographs> c = JackknifeOverPhotographs(fitted.problem, fitted.blocks);
	if (!c)
		return std::nullopt;
	return Eigen::Matrix2d(c->Of({ fitted.shared }));
}

TEST(ByPhotographs, IsTheJackknifeOfFitsThatLeaveEachOut)
{
	const size_t photos = 9, groups = 2;
	const std::vector<Sample> all = Draw(photos, groups, 0.05, 1);
	const Eigen::Vector2d with = Fit(all, photos, size_t(-1));
	Eigen::Matrix2d expected = Eigen::Matrix2d::Zero();
	for (size_t p = 0; p < photos; ++p)
	{
		const double n = p % groups == 0 ? 5 : 4;
		const Eigen::Vector2d change = Fit(all, photos, p) - with;
		expected += (n - 1) / n * change * change.transpose();
	}
	const std::optional<Eigen::Matrix2d> found = Jackknifed(all, photos);
	ASSERT_TRUE(found);
	// Ceres stops when a step changes the cost by 1e-6 of it; for a linear problem that is the second step, at rounding error.
	EXPECT_LT((*found - expected).norm(), 1e-6 * expected.norm());
}

/// 200 draws of 10 photographs: the mean of the jackknife's variance against the variance of the estimates themselves.
TEST(ByPhotographs, HoldsWhatPhotographsHaveInCommon)
{
	const size_t photos = 10;
	const int draws = 200;
	double variance = 0, sum = 0, squares = 0;
	for (int k = 0; k < draws; ++k)
	{
		const std::vector<Sample> all = Draw(photos, 1, 0.05, unsigned(100 + k));
		const double a = Fit(all, photos, size_t(-1))[0];
		sum += a;
		squares += a * a;
		variance += (*Jackknifed(all, photos))(0, 0) / draws;
	}
	const double true_variance = squares / draws - sum * sum / (draws * draws);
	// The variance of 200 draws is known to sqrt(2/200) = 0.1 of itself; the jackknife of 10 is up to 10/9 too large. Independent edges
	// would give (0.1^2/400) / (0.05^2/10) = 0.1 of it.
	EXPECT_NEAR(variance / true_variance, 1.05, 3 * 0.1 + 0.06);
}

// Of every photograph its first samples: linear residuals, so that one step is the part's own fit, and its variance that of the textbook.
TEST(ByPhotographs, APartsAnswerIsItsOwnFit)
{
	const size_t photos = 6, kept = 15;
	const std::vector<Sample> all = Draw(photos, 2, 0.05, 4);
	Fitted fitted(all, photos);
	std::vector<PhotographBlocks> part = fitted.blocks;
	for (PhotographBlocks& p : part)
		p.residuals.resize(kept);
	std::vector<Sample> samples;
	for (size_t p = 0, at = 0; p < photos; ++p, at += 40)
		samples.insert(samples.end(), all.begin() + long(at), all.begin() + long(at + kept));
	const std::optional<PartsAnswer> answer = AnswerOfPart(fitted.problem, fitted.blocks, part, { fitted.shared });
	ASSERT_TRUE(answer);
	const Eigen::Vector2d alone = Fit(samples, photos, size_t(-1));
	// Rounding: as in the jackknife above.
	for (int i = 0; i < 2; ++i)
		EXPECT_NEAR(fitted.shared[i] + answer->step[i], alone[i], 1e-9);

	Eigen::MatrixXd A = Eigen::MatrixXd::Zero(Eigen::Index(samples.size()), Eigen::Index(photos) + 2);
	Eigen::VectorXd y(A.rows());
	for (size_t i = 0; i < samples.size(); ++i)
	{
		A.row(Eigen::Index(i)).head<2>() << samples[i].x, samples[i].z;
		A(Eigen::Index(i), Eigen::Index(samples[i].photo) + 2) = 1;
		y[Eigen::Index(i)] = samples[i].y;
	}
	const Eigen::VectorXd x = A.completeOrthogonalDecomposition().solve(y);
	const Eigen::MatrixXd covariance = (A * x - y).squaredNorm() / double(A.rows() - A.cols()) * (A.transpose() * A).inverse();
	for (int i = 0; i < 2; ++i)
		EXPECT_NEAR(answer->variance[i], covariance(i, i), 1e-9 * covariance(i, i));
	EXPECT_EQ(AnswerOfPart(fitted.problem, fitted.blocks, part, {})->step.size(), 0);

	// Without x it tells no slope.
	std::vector<Sample> level = all;
	for (Sample& s : level)
		s.x = 0;
	Fitted blind(level, photos);
	EXPECT_FALSE(AnswerOfPart(blind.problem, blind.blocks, blind.blocks, { blind.shared }));
}

TEST(ByPhotographs, OnePhotographThatSaysAllCannotBeJudged)
{
	// Only the first has any x.
	std::vector<Sample> all = Draw(4, 1, 0, 3);
	for (Sample& s : all)
		if (s.photo > 0)
			s.x = 0;
	EXPECT_FALSE(Jackknifed(all, 4));
}

}
