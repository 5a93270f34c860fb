#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/variable.h>
#include <placegraph/graph/core/outcome.h>
#include <placegraph/graph/core/robust_kernel.h>
#include <placegraph/graph/pose_graph/constraint.h>
#include <placegraph/graph/pose_graph/pose_graph.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Variables of any kinds and the factors between them, for programs that embed the library and
/// estimate more than poses. Factors come ready in backend/factors/ or are the program's own: see
/// Factor and examples/custom_factor.cpp. Pose graphs have a faster way, optimize_pose_graph.
struct FactorGraph {
  struct Node {
    Variable value;
    bool held = false;  ///< stays as it is
  };
  struct Term {
    std::shared_ptr<const Factor> factor;  ///< may be shared between graphs
    std::vector<int> variables;            ///< positions in `variables`
    RobustKernel kernel;
  };
  std::vector<Node> variables;
  std::vector<Term> terms;

  /// Adds a variable and returns its position.
  int add_variable(const Variable& value, bool held = false);
  /// Adds a term, e.g. add(DistanceFactor(2, 0.1), {a, b}).
  template <class F>
  void add(F factor, std::vector<int> between, const RobustKernel& kernel = {}) {
    terms.push_back({std::make_shared<const F>(std::move(factor)), std::move(between), kernel});
  }
  /// The value of a variable; throws ArgumentError if it is not there or of another kind.
  template <class T>
  const T& value(int variable) const {
    return std::get<T>(value_of_kind(variable, Variable(std::in_place_type<T>).index()));
  }

  /// Throws ArgumentError: a value that is not finite; a term without factor, of no rows, whose
  /// variables are not there, repeat or are not of the kinds its factor takes; a kernel of no
  /// positive width.
  void check() const;

 private:
  const Variable& value_of_kind(int variable, std::size_t kind) const;
};

struct FactorGraphReport {
  Outcome outcome;
  FactorGraph graph;                        ///< with the estimate; as it came if there is none
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(|r|^2)
  int iterations = 0;
};

/// Minimizes sum rho(|r|^2) / 2 near the values the variables have, by Levenberg-Marquardt;
/// landmarks are eliminated first. Directions that nothing holds stay where they are.
/// Deterministic, single-threaded. Throws as FactorGraph::check. kTooFewData: no term, or nothing
/// that may move; kNotConverged: stopped by the number of iterations (the estimate so far is
/// there) or because a factor could not be computed.
[[nodiscard]] FactorGraphReport optimize_factor_graph(const FactorGraph& graph,
                                                      const FactorGraphOptions& options);

/// |r|^2 of every term at the present values, without kernels; nothing where it cannot be computed.
std::vector<std::optional<double>> squared_residuals(const FactorGraph& graph);

struct MarginalCovariance {
  Outcome outcome;             ///< kDegenerate: some direction is not determined by the terms
  Eigen::MatrixXd covariance;  ///< tangents of the variables asked for, one after the other
};

/// Joint covariance of some variables' tangents at the present values, all others marginalized:
/// those blocks of (J^T J)^-1, kernels entering by their weights. Held variables have none. Throws
/// as FactorGraph::check and if a variable is not there, repeats or is held.
[[nodiscard]] MarginalCovariance marginal_covariance(const FactorGraph& graph,
                                                     const std::vector<int>& variables);

/// A pose graph as a factor graph: variables in the order of its nodes, terms in that of its
/// constraints; held are the fixed nodes and what optimize_pose_graph would hold. Throws as
/// PoseGraph::check.
FactorGraph to_factor_graph(const PoseGraph& graph,
                            RotationError rotation_error = RotationError::kLog);

}  // namespace placegraph
