#include <placegraph/backend/factor_graph/fixed_lag_smoother.h>
#include <placegraph/backend/factor_graph/term_marginalization.h>
#include <placegraph/graph/core/error.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace placegraph {
namespace {

/// Removes the entries of variables that leave.
template <class T>
void keep(const std::vector<char>& leaves, std::vector<T>& values) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!leaves[i]) values[kept++] = values[i];
  values.resize(kept);
}

}  // namespace

FixedLagSmoother::FixedLagSmoother(double lag, const FactorGraphOptions& options)
    : lag_(lag), options_(options) {
  require(std::isfinite(lag) && lag >= 0, "lag: it must be a number that is not negative");
  options.check();
}

int FixedLagSmoother::add_variable(double time, const Variable& value, bool held) {
  require(std::isfinite(time), "time: it is not finite");
  require(is_finite(value), "value: it is not finite");
  window_.add_variable(value, held);
  numbers_.push_back(next_);
  times_.push_back(time);
  return next_++;
}

void FixedLagSmoother::add(FactorGraph::Term term) {
  term.variables = positions(term.variables);
  // The check of a graph with this term and its variables alone.
  FactorGraph alone;
  FactorGraph::Term checked = term;
  std::vector<int> sorted = term.variables;
  std::sort(sorted.begin(), sorted.end());
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
  for (const int i : sorted)
    alone.add_variable(window_.variables[static_cast<std::size_t>(i)].value);
  for (int& i : checked.variables)
    i = static_cast<int>(std::lower_bound(sorted.begin(), sorted.end(), i) - sorted.begin());
  alone.terms.push_back(std::move(checked));
  alone.check();
  window_.terms.push_back(std::move(term));
}

void FixedLagSmoother::touch(int variable, double time) {
  require(std::isfinite(time), "time: it is not finite");
  double& present = times_[static_cast<std::size_t>(position(variable))];
  present = std::max(present, time);
}

FixedLagStep FixedLagSmoother::update(const LogSink& log) {
  FixedLagStep step;
  FactorGraphReport report = optimize_factor_graph(window_, options_, log);
  step.outcome = report.outcome;
  step.cost_initial = report.cost_initial;
  step.cost_final = report.cost_final;
  step.iterations = report.iterations;
  const double oldest = times_.empty() ? 0 : *std::max_element(times_.begin(), times_.end()) - lag_;
  std::vector<char> leaves(times_.size());
  for (std::size_t i = 0; i < times_.size(); ++i) {
    leaves[i] = times_[i] < oldest;
    if (leaves[i]) step.marginalized.push_back(numbers_[i]);
  }
  FactorGraph window =
      step.marginalized.empty() ? std::move(report.graph) : marginalized(report.graph, leaves);
  window_ = std::move(window);
  keep(leaves, numbers_);
  keep(leaves, times_);
  return step;
}

const Variable& FixedLagSmoother::value(int variable) const {
  return window_.variables[static_cast<std::size_t>(position(variable))].value;
}

MarginalCovariance FixedLagSmoother::covariance(const std::vector<int>& variables) const {
  return marginal_covariance(window_, positions(variables));
}

int FixedLagSmoother::position(int variable) const {
  const auto found = std::lower_bound(numbers_.begin(), numbers_.end(), variable);
  require(found != numbers_.end() && *found == variable,
          "variable " + std::to_string(variable) + " is not in the window");
  return static_cast<int>(found - numbers_.begin());
}

std::vector<int> FixedLagSmoother::positions(const std::vector<int>& variables) const {
  std::vector<int> result;
  for (const int variable : variables) result.push_back(position(variable));
  return result;
}

}  // namespace placegraph
