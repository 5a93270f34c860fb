#pragma once
#include <placegraph/backend/internal/elimination/front_forest.h>
#include <placegraph/backend/internal/elimination/matrix_pool.h>

namespace placegraph {

/// Puts the front's part of H and the Schur complements of its children into its matrix, which
/// `pool` provides. `damping`: share of the mean of a variable's own diagonal that is added to it.
template <int D>
void assemble(FrontForest<D>& forest, typename FrontForest<D>::Front& front, double damping,
              MatrixPool& pool);

/// Brings the front's part of L y = -g up to date, once its matrix is factorized and its children
/// are up to date.
template <int D>
void substitute_forward(FrontForest<D>& forest, typename FrontForest<D>::Front& front);

}  // namespace placegraph
