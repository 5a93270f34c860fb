#pragma once
#include <vector>

namespace placegraph {

/// Sets of variables 0, 1, ..., each the scope of one term of a quadratic form: an edge joins two,
/// what was left of variables that are eliminated already joins many.
struct VariableSets {
  std::vector<int> members;
  std::vector<int> begin = {0};  ///< set s is members[begin[s]], ..., members[begin[s + 1] - 1]
  void close() { begin.push_back(static_cast<int>(members.size())); }  ///< ends a set
  int size() const { return static_cast<int>(begin.size()) - 1; }
};

/// One dense front of a Cholesky factorization: variables eliminated together and those they meet.
struct FrontPlan {
  std::vector<int> frontal;    ///< in the order of elimination
  std::vector<int> separator;  ///< in the order of elimination, all later than the frontal ones
  int parent = -1;             ///< front that eliminates separator.front(); -1: no separator
};

struct EliminationPlan {
  std::vector<FrontPlan> fronts;  ///< children before parents
};

/// Plans the elimination of all `variables`: the order by approximate minimum degree (Amestoy,
/// Davis & Duff 1996) on the sets, those with `late` only after all others, by SuiteSparse's CAMD;
/// then fronts, with a child taken into its parent while that stores no more zeros than
/// `zero_share` of its entries.
EliminationPlan plan_elimination(int variables, const VariableSets& sets,
                                 const std::vector<char>& late, double zero_share);

}  // namespace placegraph
