#pragma once
#include <placegraph/backend/factor_graph/factor_graph.h>

#include <memory>
#include <utility>
#include <vector>

namespace [[gnu::visibility("default")]] placegraph {

/// Report of one step of a FixedLagSmoother.
struct FixedLagStep {
  Outcome outcome;                          ///< outcome, as of optimize_factor_graph
  double cost_initial = 0, cost_final = 0;  ///< half the sum of rho(|r|^2) in the window
  int iterations = 0;                       ///< number of steps of Levenberg-Marquardt
  std::vector<int> marginalized;            ///< variables that left the window, ascending
};

/// Estimates the latest variables of a factor graph that grows without end.
///
/// Every variable has a time, in any unit: seconds, or the number of its frame. A step minimizes
/// the cost of the window, then marginalizes the variables that are more than `lag` older than the
/// latest one: their terms are linearized at the estimate (kernels by their weights) and replaced
/// by one linear prior on the variables that share a term with them. If all factors are linear, the
/// estimate is that of all terms ever added. A variable that is held leaves as a constant. The same
/// calls give bitwise identical results.
class FixedLagSmoother {
 public:
  /// Starts with an empty window.
  ///
  /// Throws ArgumentError unless `lag` is a number that is not negative, and as
  /// FactorGraphOptions::check.
  explicit FixedLagSmoother(double lag, const FactorGraphOptions& options = {});

  /// Adds a variable and returns its number; numbers count from 0 and are never used again.
  /// Throws ArgumentError if the time or the value is not finite.
  int add_variable(double time, const Variable& value, bool held = false);
  /// Adds a term on variables of the window, given by their numbers.
  /// Throws ArgumentError as FactorGraph::check; the window is unchanged then.
  void add(FactorGraph::Term term);
  /// Adds a factor on variables of the window, e.g. add(DistanceFactor(2, 0.1), {a, b}).
  template <class F>
  void add(F factor, std::vector<int> between, const RobustKernel& kernel = {}) {
    add(FactorGraph::Term{std::make_shared<const F>(std::move(factor)), std::move(between),
                          kernel});
  }
  /// Gives a variable a later time, as for a landmark that is observed again.
  /// Throws ArgumentError for a variable outside the window and a time that is not finite.
  void touch(int variable, double time);

  /// Optimizes the window and marginalizes what is too old.
  /// `log` is that of optimize_factor_graph. If an exception ends it, the window is unchanged.
  FixedLagStep update(const LogSink& log = {});

  /// Numbers of the variables in the window, ascending.
  const std::vector<int>& variables() const { return numbers_; }
  /// The value of a variable; throws ArgumentError if it is not in the window.
  const Variable& value(int variable) const;
  /// Joint covariance of variables of the window, as marginal_covariance.
  MarginalCovariance covariance(const std::vector<int>& variables) const;
  /// The variables in the order of variables(), and the terms with the linear prior.
  const FactorGraph& window() const { return window_; }

 private:
  int position(int variable) const;
  std::vector<int> positions(const std::vector<int>& variables) const;

  double lag_;
  FactorGraphOptions options_;
  int next_ = 0;
  FactorGraph window_;
  std::vector<int> numbers_;   // by position in the window
  std::vector<double> times_;  // by position in the window
};

}  // namespace placegraph
