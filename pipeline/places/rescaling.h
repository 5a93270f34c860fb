#pragma once
#include <placegraph/graph/loop.h>

namespace placegraph {

/// Information in a tangent that begins with a translation, after all lengths of the motion have
/// been multiplied by `factor`.
template <int N>
Eigen::Matrix<double, N, N> rescaled_information(Eigen::Matrix<double, N, N> information,
                                                 double factor) {
  information.template topRows<3>() /= factor;
  information.template leftCols<3>() /= factor;
  return information;
}

/// The same for a covariance.
template <int N>
Eigen::Matrix<double, N, N> rescaled_covariance(const Eigen::Matrix<double, N, N>& covariance,
                                                double factor) {
  return rescaled_information<N>(covariance, 1 / factor);
}

/// The loop after the lengths at its match, its query or both have been multiplied by `factor`.
inline Loop rescaled_loop(Loop loop, bool at_match, bool at_query, double factor) {
  if (at_match) {
    loop.T_match_query = loop.T_match_query.scaled(factor);
    loop.scale_match_query *= factor;
  }
  if (at_query) {
    loop.information = rescaled_information<7>(loop.information, factor);
    loop.scale_match_query /= factor;
  }
  return loop;
}

}  // namespace placegraph
