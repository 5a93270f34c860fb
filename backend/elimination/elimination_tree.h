#pragma once
#include <placegraph/backend/elimination/elimination_plan.h>
#include <placegraph/backend/elimination/front_forest.h>
#include <placegraph/backend/elimination/matrix_pool.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace placegraph {

/// Incremental multifrontal Cholesky factor of a block-sparse symmetric matrix H.
/// The blocks are D x D. The factor is a forest of dense fronts in which the term of two variables
/// affects only the fronts on the path from them to their root (the Bayes tree of Kaess et al.
/// 2012, with the Schur complement of every front, so that the subtrees below a changed part are
/// not affected).
///
/// H is a sum of terms over one or two variables. New terms change the order of elimination only of
/// the fronts on the path to the root, with the variables of the newest terms last.
template <int D>
class EliminationTree {
 public:
  using Block = typename FrontForest<D>::Block;
  using Vector = typename FrontForest<D>::Vector;

  /// Adds a variable that is not active yet; returns its number, starting from 0.
  int add_variable();
  /// Only active variables are eliminated; a term with an inactive variable affects only the other
  /// variable.
  void set_active(int variable, bool active);
  bool active(int variable) const { return forest_.variables[variable].active; }

  /// Adds a term over `a` and `b` (-1: over `a` only), initially zero; returns its number.
  int add_term(int a, int b);
  /// Removes a term and its effects; its number is used for a later term.
  void remove_term(int term);
  void set_information(int term, const Block& H_aa, const Block& H_ab, const Block& H_bb);
  /// Sets g of H delta = -g.
  void set_gradient(int variable, const Vector& g);
  /// Adds this share of the mean of a variable's own diagonal to the diagonal.
  void set_damping(double damping);
  double damping() const { return damping_; }
  /// Makes the next factorize() compute the complete order again.
  void reorder() { reorder_all_ = true; }

  /// Updates the factor to the current H. False if H is not positive definite.
  [[nodiscard]] bool factorize();
  /// Updates L y = -g and returns |y|^2 = g^T H^-1 g, the decrease of the quadratic model c + 2 g^T
  /// delta + delta^T H delta to its minimum.
  double model_decrease();

  /// Solves for the significant part of delta: from the roots down, without fronts where neither
  /// delta^T H_vv delta of a variable nor the remaining decrease of the subtree exceeds
  /// `threshold`. Returns the variables solved for; delta(v) is their step.
  const std::vector<int>& solve(double threshold);
  const Vector& delta(int variable) const { return forest_.variables[variable].delta; }

  /// Blocks of H^-1 over the given active variables, in their order; requires an up-to-date factor.
  Eigen::MatrixXd covariance(const std::vector<int>& variables) const;

  int variables_refactored() const { return variables_refactored_; }  ///< in the last factorize()
  /// Number of entries of the factor's fronts, now and after the last complete ordering.
  std::int64_t entries() const { return entries_; }
  std::int64_t entries_when_ordered() const { return entries_when_ordered_; }

 private:
  using Variable = typename FrontForest<D>::Variable;
  using Term = typename FrontForest<D>::Term;
  using Front = typename FrontForest<D>::Front;

  bool covered(const Term& term) const;
  void touch(int variable);
  void mark_stale(int front, bool matrix);
  VariableSets sets_of(const std::vector<int>& top, const std::vector<int>& orphans) const;
  void restructure();
  std::vector<int> collect_top(std::vector<int>& orphans);
  bool factorize_stale();
  int new_front();

  FrontForest<D> forest_;
  std::vector<int> free_terms_, free_fronts_;
  MatrixPool pool_;
  std::vector<int> touched_;  ///< variables whose path to the root is to be reordered
  std::vector<int> stale_matrices_, stale_rhs_;  ///< fronts, with all their ancestors
  std::vector<int> solved_;
  std::int64_t next_order_ = 0;
  std::int64_t entries_ = 0, entries_when_ordered_ = 0;
  double damping_ = 0;
  bool reorder_all_ = false;
  int variables_refactored_ = 0;
};

}  // namespace placegraph
