#pragma once
#include <vector>

namespace placegraph {

/// Sets of variables 0, 1, ..., each the scope of one term of a quadratic form.
/// An edge connects two variables, the Schur complement of eliminated variables connects many.
struct VariableSets {
  std::vector<int> members;
  std::vector<int> begin = {0};  ///< set s is members[begin[s]], ..., members[begin[s + 1] - 1]
  void close() { begin.push_back(static_cast<int>(members.size())); }  ///< ends a set
  int size() const { return static_cast<int>(begin.size()) - 1; }
};

/// A dense front of a Cholesky factorization: jointly eliminated variables and their neighbours.
struct FrontPlan {
  std::vector<int> frontal;    ///< in the order of elimination
  std::vector<int> separator;  ///< in the order of elimination, all later than the frontal ones
  int parent = -1;             ///< front that eliminates separator.front(); -1: no separator
};

struct EliminationPlan {
  std::vector<FrontPlan> fronts;  ///< children before parents
};

/// Plans the elimination of all `variables`: the order by approximate minimum degree (Amestoy,
/// Davis & Duff 1996) on the sets, those with `late` after all others, by SuiteSparse's CAMD. Then
/// fronts are formed; a child is merged into its parent while the result stores at most a share
/// `zero_share` of zeros.
EliminationPlan plan_elimination(int variables, const VariableSets& sets,
                                 const std::vector<char>& late, double zero_share);

}  // namespace placegraph
