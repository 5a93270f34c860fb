#include <placegraph/frontend/planes/label_expansion.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace placegraph {
namespace {

/// Best labelling in which each item keeps its label or changes to `alpha`.
std::vector<int> expanded(const LabelProblem& problem, const std::vector<int>& labels, int alpha) {
  const int n = static_cast<int>(labels.size());
  cv::detail::GCGraph<double> graph(static_cast<unsigned>(n),
                                    static_cast<unsigned>(2 * problem.neighbours.size()));
  for (int i = 0; i < n; ++i) graph.addVtx();
  // With x = 1 for a change to alpha: cost += change[i] x_i, and capacity (1 - x_i) x_j per pair.
  std::vector<double> change(labels.size());
  for (int i = 0; i < n; ++i)
    change[static_cast<std::size_t>(i)] =
        problem.unary(i, alpha) - problem.unary(i, labels[static_cast<std::size_t>(i)]);
  bool edges = false;
  for (const auto& [i, j] : problem.neighbours) {
    const int a = labels[static_cast<std::size_t>(i)], b = labels[static_cast<std::size_t>(j)];
    const double neither = a != b ? problem.pair_cost : 0;
    const double second = a != alpha ? problem.pair_cost : 0;  // only j changes to alpha
    const double first = b != alpha ? problem.pair_cost : 0;
    change[static_cast<std::size_t>(i)] += first - neither;
    change[static_cast<std::size_t>(j)] -= first;
    const double capacity = first + second - neither;
    if (!(capacity > 0)) continue;
    graph.addEdges(i, j, capacity, 0);
    edges = true;
  }
  for (int i = 0; i < n; ++i) {
    const double cost = change[static_cast<std::size_t>(i)];
    graph.addTermWeights(i, std::max(cost, 0.0), std::max(-cost, 0.0));
  }
  if (edges) graph.maxFlow();  // does not accept a graph without edges
  std::vector<int> result = labels;
  for (int i = 0; i < n; ++i) {
    const bool takes = edges ? !graph.inSourceSegment(i) : change[static_cast<std::size_t>(i)] < 0;
    if (takes) result[static_cast<std::size_t>(i)] = alpha;
  }
  return result;
}

}  // namespace

double label_cost(const LabelProblem& problem, const std::vector<int>& labels) {
  double cost = 0;
  for (std::size_t i = 0; i < labels.size(); ++i)
    cost += problem.unary(static_cast<Eigen::Index>(i), labels[i]);
  for (const auto& [i, j] : problem.neighbours)
    if (labels[static_cast<std::size_t>(i)] != labels[static_cast<std::size_t>(j)])
      cost += problem.pair_cost;
  return cost;
}

double expand_labels(const LabelProblem& problem, std::vector<int>& labels) {
  require(problem.unary.rows() == static_cast<Eigen::Index>(labels.size()),
          "expand_labels: needs as many labels as rows of costs");
  require(problem.pair_cost >= 0, "expand_labels: pair_cost must not be negative");
  require(problem.unary.allFinite(), "expand_labels: costs must be finite");
  double cost = label_cost(problem, labels);
  for (bool lower = true; lower;) {
    lower = false;
    for (int alpha = 0; alpha < problem.unary.cols(); ++alpha) {
      std::vector<int> next = expanded(problem, labels, alpha);
      const double next_cost = label_cost(problem, next);
      if (!(next_cost < cost - 1e-9 * (1 + std::abs(cost)))) continue;
      cost = next_cost;
      labels = std::move(next);
      lower = true;
    }
  }
  return cost;
}

}  // namespace placegraph
