#pragma once
#include <Eigen/Core>

namespace placegraph {

/// Information in a tangent that begins with a translation, when all lengths of the motion are
/// multiplied by `factor`.
template <int N>
Eigen::Matrix<double, N, N> rescaled_information(Eigen::Matrix<double, N, N> information,
                                                 double factor) {
  information.template topRows<3>() /= factor;
  information.template leftCols<3>() /= factor;
  return information;
}

/// The same of a covariance.
template <int N>
Eigen::Matrix<double, N, N> rescaled_covariance(const Eigen::Matrix<double, N, N>& covariance,
                                                double factor) {
  return rescaled_information<N>(covariance, 1 / factor);
}

}  // namespace placegraph
