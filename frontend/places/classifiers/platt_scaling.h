#pragma once
#include <Eigen/Core>

namespace placegraph {

/// P(y = 1 | output s) = 1 / (1 + exp(slope * s + offset)).
///
/// The slope is negative if larger outputs are more certain.
struct PlattScaling {
  double slope = -1, offset = 0;
  double probability(double output) const;
};

/// Fits the sigmoid that converts outputs of a machine to probabilities (Platt 1999).
///
/// Newton steps with line search (Lin, Lin & Weng 2007); the targets (n1 + 1) / (n1 + 2) and 1 /
/// (n0 + 2) keep the sigmoid finite if the outputs separate the two classes. `outputs`: for views
/// that were not in the machine's training; `positive`: the class of each. Throws ArgumentError
/// unless there is one output per view.
PlattScaling fit_platt_scaling(const Eigen::VectorXd& outputs,
                               const Eigen::Array<bool, Eigen::Dynamic, 1>& positive);

}  // namespace placegraph
