#pragma once
#include <Eigen/Core>

namespace placegraph {

/// P(y = 1 | output s) = 1 / (1 + exp(slope * s + offset)); the slope is negative where larger
/// outputs are surer.
struct PlattScaling {
  double slope = -1, offset = 0;
  double probability(double output) const;
};

/// The sigmoid that makes outputs of a machine probabilities (Platt 1999), by Newton steps with
/// line search (Lin, Lin & Weng 2007); the targets (n1 + 1) / (n1 + 2) and 1 / (n0 + 2) keep it
/// finite where the outputs part the two classes. `outputs`: of views the machine was not trained
/// on; `positive`: of each. Throws ArgumentError unless there is one output per view.
PlattScaling fit_platt_scaling(const Eigen::VectorXd& outputs,
                               const Eigen::Array<bool, Eigen::Dynamic, 1>& positive);

}  // namespace placegraph
