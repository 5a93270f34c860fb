#pragma once
#include <placegraph/backend/factor_graph/factor_graph_options.h>
#include <placegraph/backend/factors/factor.h>
#include <placegraph/backend/factors/variable.h>
#include <placegraph/graph/core/log.h>
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

/// Variables of several kinds and factors between them, for estimates of more than poses.
/// Factors are those of backend/factors/ or defined by the application: see Factor and
/// examples/custom_factor.cpp. For a pose graph optimize_pose_graph is faster.
struct FactorGraph {
  /// A variable with its initial value or, after optimization, its estimate.
  struct Node {
    Variable value;     ///< current value
    bool held = false;  ///< whether optimization keeps the value fixed
  };
  /// A factor, the variables it depends on, and a robust kernel.
  struct Term {
    std::shared_ptr<const Factor> factor;  ///< factor; graphs may share it
    std::vector<int> variables;            ///< positions in `variables`, in the factor's order
    RobustKernel kernel;                   ///< robust kernel of |r|^2; none by default
  };
  std::vector<Node> variables;  ///< variables, identified by their positions
  std::vector<Term> terms;      ///< terms, in any order

  /// Adds a variable and returns its position.
  int add_variable(const Variable& value, bool held = false);
  /// Adds a term, e.g. add(DistanceFactor(2, 0.1), {a, b}).
  template <class F>
  void add(F factor, std::vector<int> between, const RobustKernel& kernel = {}) {
    terms.push_back({std::make_shared<const F>(std::move(factor)), std::move(between), kernel});
  }
  /// The value of a variable; throws ArgumentError if it does not exist or is not of kind T.
  template <class T>
  const T& value(int variable) const {
    return std::get<T>(value_of_kind(variable, Variable(std::in_place_type<T>).index()));
  }

  /// Throws ArgumentError naming the first entry that is invalid.
  /// Invalid are: a value that is not finite; a term without a factor or without rows; a term whose
  /// variables do not exist, repeat or are not of the kinds that its factor takes; a kernel whose
  /// width is not positive.
  void check() const;

 private:
  const Variable& value_of_kind(int variable, std::size_t kind) const;
};

/// The result of optimizing a factor graph.
struct FactorGraphReport {
  Outcome outcome;                          ///< outcome, see optimize_factor_graph
  FactorGraph graph;                        ///< graph with the estimate; the input if there is none
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(|r|^2)
  int iterations = 0;                       ///< number of steps of Levenberg-Marquardt
};

/// Minimizes sum rho(|r|^2) / 2 by Levenberg-Marquardt from the current values.
/// If most variables are points and lines, these are eliminated first. Directions that no term
/// determines stay near their initial values. Deterministic, single-threaded. Throws ArgumentError
/// as FactorGraph::check and for options out of range. kTooFewData: there is no term, or all
/// variables are held. kNotConverged: the maximum number of iterations was reached (the report has
/// the last estimate), or a factor could not be computed. `log` receives a line for every step. An
/// exception of a factor or of `log` ends the optimization and is thrown here.
[[nodiscard]] FactorGraphReport optimize_factor_graph(const FactorGraph& graph,
                                                      const FactorGraphOptions& options,
                                                      const LogSink& log = {});

/// Squared residual |r|^2 of every term at the current values, without kernels.
/// Empty for a term whose residual cannot be computed. Throws as FactorGraph::check.
std::vector<std::optional<double>> squared_residuals(const FactorGraph& graph);

/// The joint covariance of selected variables.
struct MarginalCovariance {
  Outcome outcome;             ///< kDegenerate: the terms leave a direction undetermined
  Eigen::MatrixXd covariance;  ///< joint, of the tangents, in the order of the requested variables
};

/// Joint covariance of the tangents of selected variables; the others are marginalized.
/// It consists of blocks of (J^T J)^-1 at the current values; kernels enter by their weights.
/// Throws ArgumentError as FactorGraph::check and if a variable does not exist, repeats or is held.
[[nodiscard]] MarginalCovariance marginal_covariance(const FactorGraph& graph,
                                                     const std::vector<int>& variables);

/// Converts a pose graph to a factor graph.
/// The variables are in the order of the nodes, the terms in the order of the constraints. The
/// fixed nodes and those that optimize_pose_graph would hold are held. Throws as PoseGraph::check.
FactorGraph to_factor_graph(const PoseGraph& graph,
                            RotationError rotation_error = RotationError::kLog);

}  // namespace placegraph
