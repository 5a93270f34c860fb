#pragma once
#include <Eigen/Core>
#include <utility>
#include <vector>

namespace placegraph {

/// A labelling problem: item i with label l costs unary(i, l), and each pair of neighbours with
/// different labels `pair_cost` >= 0 (Potts).
struct LabelProblem {
  Eigen::MatrixXd unary;  ///< items x labels, finite
  std::vector<std::pair<int, int>> neighbours;
  double pair_cost = 0;
};

double label_cost(const LabelProblem& problem, const std::vector<int>& labels);

/// Lowers the cost of `labels` by alpha-expansion, one minimal cut per label, until no label's
/// expansion lowers it (Boykov, Veksler & Zabih 2001, fig. 3). Returns the cost reached; throws
/// ArgumentError if sizes do not agree or `pair_cost` is negative.
double expand_labels(const LabelProblem& problem, std::vector<int>& labels);

}  // namespace placegraph
