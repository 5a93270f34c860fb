#pragma once
#include <Eigen/Core>

namespace placegraph {

/// Evidence of parameters q that shift the observations of a window, with its poses and points
/// eliminated and without its prior, to second order:
///
///   cost(q) = cost(0) + 2 gradient^T q + q^T information q
///
/// Windows that share no observation are independent of each other.
struct NuisanceEvidence {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd information;
  void visit_state(auto& archive) { archive(gradient, information); }
};

/// The evidence about what is common, if the evidence is of parameters that differ from it by
/// errors of these standard deviations.
NuisanceEvidence with_own_errors(const NuisanceEvidence& evidence,
                                 const Eigen::VectorXd& own_sigmas);

/// Squared difference of the evidence's estimate and q in its covariance. Directions of which it
/// has no information, compared with that of `prior_sigmas`, are left out; adds the number of the
/// others to `freedom`.
double squared_difference(const NuisanceEvidence& evidence, const Eigen::VectorXd& q,
                          const Eigen::VectorXd& prior_sigmas, double& freedom);

}  // namespace placegraph
