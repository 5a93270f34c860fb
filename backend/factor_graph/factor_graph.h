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

/// Variables of any kinds and factors between them, to estimate more than poses.
/// Factors are those of backend/factors/ or the program's own: see Factor and
/// examples/custom_factor.cpp. For a pose graph optimize_pose_graph is faster.
struct FactorGraph {
  /// A variable: the start of the optimization or its result.
  struct Node {
    Variable value;     ///< its present value
    bool held = false;  ///< optimization leaves it as it is
  };
  /// A factor, the variables that it is a function of, and a robust kernel.
  struct Term {
    std::shared_ptr<const Factor> factor;  ///< may be shared between graphs
    std::vector<int> variables;            ///< positions in `variables`, in the factor's order
    RobustKernel kernel;                   ///< of |r|^2; none by default
  };
  std::vector<Node> variables;  ///< named by their positions
  std::vector<Term> terms;      ///< in any order

  /// Adds a variable and returns its position.
  int add_variable(const Variable& value, bool held = false);
  /// Adds a term, e.g. add(DistanceFactor(2, 0.1), {a, b}).
  template <class F>
  void add(F factor, std::vector<int> between, const RobustKernel& kernel = {}) {
    terms.push_back({std::make_shared<const F>(std::move(factor)), std::move(between), kernel});
  }
  /// The value of a variable; throws ArgumentError if it is not there or not of kind T.
  template <class T>
  const T& value(int variable) const {
    return std::get<T>(value_of_kind(variable, Variable(std::in_place_type<T>).index()));
  }

  /// Throws ArgumentError naming the first entry that is invalid.
  /// Invalid are a value that is not finite; a term without factor or rows, or whose variables are
  /// not there, repeat or are not of the kinds that its factor takes; a kernel of no positive
  /// width.
  void check() const;

 private:
  const Variable& value_of_kind(int variable, std::size_t kind) const;
};

/// The result of optimizing a factor graph.
struct FactorGraphReport {
  Outcome outcome;                          ///< see optimize_factor_graph
  FactorGraph graph;                        ///< with the estimate; the input if there is none
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(|r|^2)
  int iterations = 0;                       ///< steps of Levenberg-Marquardt
};

/// Minimizes sum rho(|r|^2) / 2 by Levenberg-Marquardt, from the values of the variables.
/// If most variables are points and lines, these are eliminated first. Directions that no term
/// determines stay near the start. Deterministic, single-threaded. Throws ArgumentError as
/// FactorGraph::check and for options out of range. kTooFewData: no term, or all variables are
/// held; kNotConverged: stopped by the number of iterations (the report has the estimate so far) or
/// because a factor could not be computed.
[[nodiscard]] FactorGraphReport optimize_factor_graph(const FactorGraph& graph,
                                                      const FactorGraphOptions& options);

/// |r|^2 of every term at the present values, without kernels.
/// Nothing for a term whose residual cannot be computed. Throws as FactorGraph::check.
std::vector<std::optional<double>> squared_residuals(const FactorGraph& graph);

/// The joint covariance of some variables.
struct MarginalCovariance {
  Outcome outcome;             ///< kDegenerate: some direction is not determined by the terms
  Eigen::MatrixXd covariance;  ///< of the tangents, in the order of the variables asked for
};

/// Joint covariance of some variables' tangents at the present values, others marginalized.
/// It consists of the blocks of (J^T J)^-1; kernels enter by their weights. Throws ArgumentError as
/// FactorGraph::check and if a variable is not there, repeats or is held.
[[nodiscard]] MarginalCovariance marginal_covariance(const FactorGraph& graph,
                                                     const std::vector<int>& variables);

/// A pose graph as a factor graph.
/// Variables are in the order of its nodes, terms in that of its constraints. Held are the fixed
/// nodes and those that optimize_pose_graph would hold. Throws as PoseGraph::check.
FactorGraph to_factor_graph(const PoseGraph& graph,
                            RotationError rotation_error = RotationError::kLog);

}  // namespace placegraph
