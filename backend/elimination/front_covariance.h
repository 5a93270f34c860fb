#pragma once
#include <placegraph/backend/elimination/front_forest.h>

namespace placegraph {

/// Blocks of H^-1 over the given active variables, in their order, from factorized fronts.
template <int D>
Eigen::MatrixXd covariance(const FrontForest<D>& forest, const std::vector<int>& variables);

}  // namespace placegraph
