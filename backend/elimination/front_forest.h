#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace placegraph {

/// The data of an EliminationTree: variables with blocks of D rows, terms over one or two of them,
/// and a forest of dense fronts, each of which eliminates some variables.
template <int D>
struct FrontForest {
  using Block = Eigen::Matrix<double, D, D>;
  using Vector = Eigen::Matrix<double, D, 1>;

  struct Variable {
    bool active = false;
    int front = -1;          ///< front that eliminates the variable
    std::int64_t order = 0;  ///< larger for later elimination
    std::vector<int> terms;
    Block diagonal = Block::Zero();
    Vector gradient = Vector::Zero(), delta = Vector::Zero();
    bool diagonal_stale = false, significant = false;
    int local = -1;  ///< temporary: position in the current front
  };
  struct Term {
    int a, b;  ///< variables; b = -1: over a only
    Block H_aa, H_ab, H_bb;
    bool zero = true;
  };
  struct Front {
    std::vector<int> frontal, separator, children;
    int parent = -1;
    std::vector<double> matrix;  ///< factor and Schur complement, see FrontKernels
    std::vector<double> rhs;     ///< [y; contribution to the separator's right-hand side]
    double decrease = 0;         ///< |y|^2 of the subtree
    bool matrix_stale = true, rhs_stale = true, in_top = false;
    int blocks() const { return static_cast<int>(frontal.size() + separator.size()); }
  };

  std::vector<Variable> variables;
  std::vector<Term> terms;
  std::vector<Front> fronts;
  std::vector<int> roots;  ///< fronts without parent

  /// Whether one front is eliminated before another: children come before their parents.
  bool earlier(int front_a, int front_b) const {
    return variables[fronts[front_a].frontal.front()].order <
           variables[fronts[front_b].frontal.front()].order;
  }

  /// The variable's own block of H, summed over its terms if one has changed.
  const Block& diagonal(int variable) {
    Variable& v = variables[variable];
    if (!v.diagonal_stale) return v.diagonal;
    v.diagonal.setZero();
    for (const int t : v.terms)
      v.diagonal += terms[t].a == variable ? terms[t].H_aa : terms[t].H_bb;
    v.diagonal_stale = false;
    return v.diagonal;
  }
};

}  // namespace placegraph
