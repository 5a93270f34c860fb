#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace placegraph {

/// Labelling problem with Potts costs between neighbours.
///
/// Item i with label l costs unary(i, l), and each pair of neighbours with different labels costs
/// `pair_cost` >= 0.
struct LabelProblem {
  Eigen::MatrixXd unary;  ///< items x labels, finite
  std::vector<std::pair<int, int>> neighbours;
  double pair_cost = 0;
};

double label_cost(const LabelProblem& problem, const std::vector<int>& labels);

/// Reduces the cost of `labels` by alpha-expansion (Boykov, Veksler & Zabih 2001, fig. 3).
///
/// One minimal cut per label, until no label's expansion reduces the cost. Returns the final cost;
/// throws ArgumentError if sizes do not agree or `pair_cost` is negative.
double expand_labels(const LabelProblem& problem, std::vector<int>& labels);

}  // namespace placegraph
