#pragma once
#include <placegraph/backend/internal/elimination/elimination_plan.h>
#include <placegraph/backend/internal/elimination/front_forest.h>
#include <placegraph/backend/internal/elimination/matrix_pool.h>

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace placegraph {

/// Multifrontal Cholesky factor of a block-sparse symmetric matrix H that grows and changes, with
/// blocks of D x D: a forest of dense fronts in which the term of two variables concerns only the
/// fronts on the way from them to their root (the Bayes tree of Kaess et al. 2012, kept with the
/// Schur complement of every front, so that what hangs below a changed part is not touched).
///
/// H is a sum of terms over one or two variables. New terms change the order of elimination of the
/// fronts on the way to the root only, the variables of the newest terms last.
template <int D>
class EliminationTree {
 public:
  using Block = typename FrontForest<D>::Block;
  using Vector = typename FrontForest<D>::Vector;

  /// A variable that is not active yet; returns its number, which counts from 0.
  int add_variable();
  /// Only active variables are eliminated; of a term with a variable that is not, the other's part
  /// counts alone.
  void set_active(int variable, bool active);
  bool active(int variable) const { return forest_.variables[variable].active; }

  /// A term over `a` and `b` (-1: over `a` alone), zero at first; returns its number.
  int add_term(int a, int b);
  /// As if it had never been there; its number serves a later term.
  void remove_term(int term);
  void set_information(int term, const Block& H_aa, const Block& H_ab, const Block& H_bb);
  /// g of H delta = -g.
  void set_gradient(int variable, const Vector& g);
  /// Added to the diagonal: this share of the mean of the variable's own diagonal.
  void set_damping(double damping);
  double damping() const { return damping_; }
  /// Everything is ordered anew by the next factorize().
  void reorder() { reorder_all_ = true; }

  /// Brings the factor up to date with all that was set. False if H is not positive definite.
  [[nodiscard]] bool factorize();
  /// Brings L y = -g up to date and returns |y|^2 = g^T H^-1 g: what the quadratic model
  /// c + 2 g^T delta + delta^T H delta falls by at its minimum.
  double model_decrease();

  /// Solves for the part of delta that matters: goes down from the roots, leaves a front out where
  /// delta^T H_vv delta of none of its variables exceeds `threshold` and the decrease that its
  /// subtree still holds does not either. Returns the variables solved for; delta(v) is theirs.
  const std::vector<int>& solve(double threshold);
  const Vector& delta(int variable) const { return forest_.variables[variable].delta; }

  /// Blocks of H^-1 over the given active variables, in their order; needs an up-to-date factor.
  Eigen::MatrixXd covariance(const std::vector<int>& variables) const;

  int variables_refactored() const { return variables_refactored_; }  ///< by the last factorize()
  /// Entries of the factor's fronts, and those there were when all was ordered last.
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
  std::vector<int> touched_;  ///< variables whose way to the root is to be reordered
  std::vector<int> stale_matrices_, stale_rhs_;  ///< fronts, with all their ancestors
  std::vector<int> solved_;
  std::int64_t next_order_ = 0;
  std::int64_t entries_ = 0, entries_when_ordered_ = 0;
  double damping_ = 0;
  bool reorder_all_ = false;
  int variables_refactored_ = 0;
};

}  // namespace placegraph
