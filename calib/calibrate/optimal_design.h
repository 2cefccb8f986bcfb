// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Sigmas of a calibration with photographs that were not taken yet: information adds up (solve/joint_fit.h).

#ifndef TILTCAL_OPTIMAL_DESIGN_H
#define TILTCAL_OPTIMAL_DESIGN_H

#include <tiltcal/calibration.h>
#include "solve/joint_fit.h"

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace tiltcal
{

/// A number and the row that takes the inverse of the information to its variance.
struct Goal
{
	ExpectedSigma sigma;
	Eigen::VectorXd row;
	double board = 0;      ///< what the board's size adds to its sigma, whatever is photographed
};

/// Of a calibration, whose information on its numbers grows by that of each photograph.
class Design
{
public:
	explicit Design(const Calibration& calibration) : c(calibration) {}
	/// Photographs to compare, and what each shows in its states.
	void Prepare(std::vector<NextPhotograph> all, std::vector<std::vector<Photo>> of_states);
	/// Sigmas with the photographs k beside what is measured; false: nothing is determined.
	bool SigmasWith(const std::vector<size_t>& taken, std::vector<ExpectedSigma>& out) const;
	/// Sum over the goals of what a sigma is of what is wanted of it, squared.
	std::optional<double> Badness(const std::vector<size_t>& taken) const;
	const NextPhotograph& Look(size_t k) const { return looks[k]; }
	size_t Count() const { return looks.size(); }

private:
	/// With shared poses the board stands still and the lens's centre moves.
	Pose InState(Pose pose, size_t s) const;
	double EdgesOfAPhotograph() const;
	std::optional<std::vector<double>> Variances(const std::vector<size_t>& taken) const;
	/// A sigma is the larger of what edges and what whole photographs say; both fall as the information grows.
	double Expected(size_t g, double variance) const;
	void Add(const std::string& name, const std::string& unit, double now, double wanted, Eigen::VectorXd row, double board = 0);
	void SetGoals(const JointInformation& all);
	/// The tilt, and how far its direction moves it aside.
	void AddTilt(size_t k, const JointInformation& all);

	const Calibration& c;
	std::vector<NextPhotograph> looks;
	Eigen::MatrixXd information;
	std::vector<Eigen::MatrixXd> gains;
	std::vector<Goal> goals;
	std::vector<double> fit_now;
};

}

#endif
