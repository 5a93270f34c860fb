#include <placegraph/backend/factor_graph/term_marginalization.h>
#include <placegraph/backend/factors/linear_prior.h>
#include <placegraph/backend/linear/marginalization.h>

#include <algorithm>
#include <memory>
#include <utility>

namespace placegraph {
namespace {

/// Information that remains after marginalization is rounding below this share of what was there.
constexpr double kRounding = 1e-12;
constexpr int kNone = -1;

std::vector<const Variable*> values_at(const FactorGraph& graph, const FactorGraph::Term& term) {
  std::vector<const Variable*> values;
  for (const int i : term.variables)
    values.push_back(&graph.variables[static_cast<std::size_t>(i)].value);
  return values;
}

/// Rows of the normal equations by variables of a graph.
class Rows {
 public:
  explicit Rows(const FactorGraph& graph) : graph_(graph), first_(graph.variables.size(), kNone) {}

  /// Appends rows for a variable, unless it is held or has rows.
  void append(int variable) {
    const auto i = static_cast<std::size_t>(variable);
    if (graph_.variables[i].held || first_[i] != kNone) return;
    first_[i] = size_;
    order_.push_back(variable);
    size_ += degrees_of_freedom(graph_.variables[i].value);
  }
  /// The first row of a variable; kNone if it has none.
  int of(int variable) const { return first_[static_cast<std::size_t>(variable)]; }
  int size() const { return size_; }
  /// The variables with rows, in the order of their rows.
  const std::vector<int>& order() const { return order_; }

 private:
  const FactorGraph& graph_;
  std::vector<int> first_, order_;
  int size_ = 0;
};

/// Adds a term that is linearized at the values of the graph, with the weight of its kernel.
/// A term that cannot be computed there adds nothing.
void add_linearized(const FactorGraph& graph, const FactorGraph::Term& term, const Rows& rows,
                    QuadraticForm& form) {
  const std::vector<const Variable*> values = values_at(graph, term);
  Eigen::VectorXd r(term.factor->residual_size());
  std::vector<Eigen::MatrixXd> J;
  for (const Variable* value : values) J.emplace_back(r.size(), degrees_of_freedom(*value));
  if (!term.factor->evaluate(values, r, J)) return;
  const double weight = term.kernel.evaluate(r.squaredNorm()).first;
  for (std::size_t a = 0; a < J.size(); ++a) {
    const int row = rows.of(term.variables[a]);
    if (row == kNone) continue;
    form.b.segment(row, J[a].cols()).noalias() += weight * J[a].transpose() * r;
    for (std::size_t b = 0; b < J.size(); ++b) {
      const int column = rows.of(term.variables[b]);
      if (column == kNone) continue;
      form.H.block(row, column, J[a].cols(), J[b].cols()).noalias() +=
          weight * J[a].transpose() * J[b];
    }
  }
}

/// Sets rows to zero whose information was cancelled down to rounding.
void clear_rounding(const Eigen::VectorXd& before, QuadraticForm& form) {
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    if (form.H(i, i) > kRounding * before[i]) continue;
    form.H.row(i).setZero();
    form.H.col(i).setZero();
    form.b[i] = 0;
  }
}

/// The prior on the remaining variables that share one of `terms` with a marginalized one.
/// Its factor is null if the terms determine nothing about them.
FactorGraph::Term marginal_prior(const FactorGraph& graph,
                                 const std::vector<const FactorGraph::Term*>& terms,
                                 const std::vector<char>& leaves) {
  Rows rows(graph);
  for (std::size_t i = 0; i < leaves.size(); ++i)
    if (leaves[i]) rows.append(static_cast<int>(i));
  const int count = rows.size();
  const std::size_t leaving = rows.order().size();
  for (const FactorGraph::Term* term : terms)
    for (const int i : term->variables)
      if (!leaves[static_cast<std::size_t>(i)]) rows.append(i);
  FactorGraph::Term prior;
  if (rows.size() == count) return prior;  // no variable remains
  QuadraticForm form{Eigen::MatrixXd::Zero(rows.size(), rows.size()),
                     Eigen::VectorXd::Zero(rows.size())};
  for (const FactorGraph::Term* term : terms) add_linearized(graph, *term, rows, form);
  const Eigen::VectorXd before = form.H.diagonal().tail(rows.size() - count);
  QuadraticForm marginal = marginalize_first(form, count);
  clear_rounding(before, marginal);
  SquareRootForm root = square_root(marginal);
  if (root.e.size() == 0) return prior;
  prior.variables.assign(rows.order().begin() + static_cast<std::ptrdiff_t>(leaving),
                         rows.order().end());
  std::vector<Variable> at;
  for (const int i : prior.variables)
    at.push_back(graph.variables[static_cast<std::size_t>(i)].value);
  prior.factor =
      std::make_shared<LinearPriorFactor>(std::move(at), std::move(root.J), std::move(root.e));
  return prior;
}

bool touches(const FactorGraph::Term& term, const std::vector<char>& selected) {
  return std::any_of(term.variables.begin(), term.variables.end(),
                     [&](int i) { return selected[static_cast<std::size_t>(i)] != 0; });
}

}  // namespace

FactorGraph marginalized(const FactorGraph& graph, const std::vector<char>& leaves) {
  std::vector<const FactorGraph::Term*> old;
  FactorGraph rest;
  for (const FactorGraph::Term& term : graph.terms) {
    if (touches(term, leaves))
      old.push_back(&term);
    else
      rest.terms.push_back(term);
  }
  FactorGraph::Term prior = marginal_prior(graph, old, leaves);
  if (prior.factor) rest.terms.push_back(std::move(prior));
  std::vector<int> position(graph.variables.size(), kNone);
  for (std::size_t i = 0; i < graph.variables.size(); ++i)
    if (!leaves[i])
      position[i] = rest.add_variable(graph.variables[i].value, graph.variables[i].held);
  for (FactorGraph::Term& term : rest.terms)
    for (int& i : term.variables) i = position[static_cast<std::size_t>(i)];
  return rest;
}

}  // namespace placegraph
